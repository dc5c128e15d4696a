#include "reports/steps/case_export.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "corpus/atomic_file.h"
#include "properties/judging/case_options.h"
#include "properties/judging/step_truth.h"
#include "properties/worker/case_player.h"
#include "properties/worker/plugin/query_case.h"
#include "reports/steps/exported_programs.h"
#include "reports/terminal/words.h"

namespace assay::reports {
namespace {

// One line for each row of three numbers.
template <class Matrix>
std::string rows_text(const char* format, const Matrix& matrix, int add = 0) {
  std::string out;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    out += fmt::format(fmt::runtime(format), matrix(i, 0) + add, matrix(i, 1) + add,
                       matrix(i, 2) + add);
  return out;
}

constexpr const char* row_of_array = "    {{{}, {}, {}}},\n";

// The exact value of a double in [0, 1] as a fraction, such as "3/8", in lowest terms.
std::string fraction_of(double share) {
  if (share == 0) return "0";
  int exponent = 0;
  constexpr int mantissa_bits = 53;
  auto numerator =
      static_cast<std::uint64_t>(std::ldexp(std::frexp(share, &exponent), mantissa_bits));
  int halvings = mantissa_bits - exponent;
  for (; numerator % 2 == 0 && halvings > 0; numerator /= 2) --halvings;
  constexpr int most_written_out = 63;
  if (halvings == 0) return fmt::format("{}", numerator);
  return halvings <= most_written_out
             ? fmt::format("{}/{}", numerator, std::uint64_t{1} << halvings)
             : fmt::format("{}/2^{}", numerator, halvings);
}

// The rows of the three lists in which a step stands.
struct StepRows {
  std::string steps, pairs, allowed;
  std::size_t pair_count = 0, allowed_count = 0;
};

std::string pair_row(const detector::PairContact& contact, int part) {
  return fmt::format("    {{{}, {}, {}, {}, {}}},\n", contact.pair.a, contact.pair.b,
                     contact.time.lo, contact.time.hi, part);
}

// `allowed` may be reported or not: what the contract leaves out or, if it has a slack, all that
// comes within that.
void add_step(const corpus::CaseStep& step, const properties::StepTruth& truth,
              const std::vector<detector::PairContact>& allowed, bool is_query, StepRows& rows) {
  const auto time = truth.first ? truth.first->time : detector::TimeEnclosure{};
  // The two triangles of a query only hold the features that are asked for.
  const std::size_t pairs = is_query ? 0 : truth.pairs.size();
  rows.steps += fmt::format("    {{{}, {}, {}, {}, {}, {}, \"{}\", \"{}\", {}, {}, {}, {}}},\n",
                            step.from, step.to, step.commit, truth.first.has_value(), time.lo,
                            time.hi, fraction_of(time.lo), fraction_of(time.hi), rows.pair_count,
                            pairs, rows.allowed_count, allowed.size());
  std::map<detector::TrianglePair, int> part_of;
  int part = 0;
  for (const auto& contacts : properties::contact_parts(truth.pairs, time)) {
    for (const auto& contact : contacts) part_of[contact.pair] = part;
    ++part;
  }
  for (std::size_t i = 0; i < pairs; ++i) {
    const auto found = part_of.find(truth.pairs[i].pair);
    rows.pairs += pair_row(truth.pairs[i], found == part_of.end() ? -1 : found->second);
  }
  for (const auto& contact : allowed) rows.allowed += pair_row(contact, -1);
  rows.pair_count += pairs;
  rows.allowed_count += allowed.size();
}

constexpr const char* head = R"(#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

)";

constexpr const char* mesh_text =
    R"(// The mesh: vertex indices of each triangle, counter-clockwise seen from outside.
static const int triangles[][3] = {{
{}}};
static const int triangle_count = {}, vertex_count = {};

// Where the vertices are; within a step they move along straight lines.
)";

constexpr const char* query_text =
    R"(// The step of four points: a vertex and the three corners of a face, or the two ends of one edge
// and the two of another. The question is whether these two features meet.
static const bool is_vertex_face = {};
static const int triangle_count = 2;

// Where the points are; within the step they move along straight lines.
)";

constexpr const char* lists_text = R"(static const double frames[][{}][3] = {{
{}}};

// From frame `from` to frame `to`; with `commit` the detector's state goes on. The first contact
// time t* is `lo` where lo and hi are one number, else strictly between the two, which are adjacent
// doubles. What meets stands in `pairs` from `first_pair` on.
struct Step {{
  int from, to;
  bool commit, collision;
  double lo, hi;
  const char *lo_as_fraction, *hi_as_fraction;
  int first_pair, pair_count, first_allowed, allowed_count;
}};
static const Step steps[] = {{
{}}};
static const int step_count = {};

// Two triangles and the interval of their first time. The pairs that meet at t* are the edges of a
// graph of triangles. `part` is the number of its connected part, and -1 of a pair that meets
// later.
struct Pair {{
  int a, b;
  double lo, hi;
  int part;
}};
static const Pair pairs[] = {{
{}    {{-1, -1, 0, 0, -1}},  // the end
}};
// What the detector may report or not, but not earlier: contacts that the contract leaves out, or
// all that comes within its margin.
static const Pair allowed[] = {{
{}    {{-1, -1, 0, 0, -1}},  // the end
}};

// What is claimed of the detector, and asked of it here; the bits are those of
// detector/plugin/assay_detector.h.
enum Claim : unsigned {{
{}
}};
static const unsigned claims = {};
static const double time_tolerance = {};
static const double promised = {};  // of a limiter: its progress
static const double unit = {};  // in the last place of 1, in the detector's numbers
static const bool takes_displacements = {};  // in place of ends
)";

// "free_sound | total", in the words of the exported file.
std::string claims_text(const properties::DetectorUnderTest& detector, bool is_query) {
  using properties::Claim;
  std::vector<std::string> names;
  const auto claims = detector.claims_in(detector.configurations.front());
  auto judged = properties::judged_claims(claims, detector.contract);
  // The features of a query are no neighbours, so a slack does not make this void.
  if (is_query) judged.set(Claim::no_spurious, claims.has(Claim::no_spurious));
  for (const auto claim : list_of(judged)) names.push_back(replaced(name_of(claim), {{'-', "_"}}));
  return names.empty() ? "0" : joined(names, " | ");
}

// "  free_sound = 1,", and so on: a line for each claim that there is.
std::string all_claims_text() {
  std::vector<std::string> lines;
  for (const auto claim : properties::all_claims())
    lines.push_back(fmt::format("  {} = {}", replaced(name_of(claim), {{'-', "_"}}),
                                properties::Claims{claim}.bits()));
  return joined(lines, ",\n");
}

// The arrays of the case and what its answers are asked for, with a function to fill in.
std::string case_text(const corpus::Case& c, const properties::DetectorUnderTest& detector,
                      const std::vector<oracle::StepJudgement>& judgements) {
  const auto query = properties::query_of(c);
  StepRows rows;
  const auto script = corpus::steps_of(c);
  for (std::size_t s = 0; s < script.size(); ++s) {
    const auto truth = truth_of(c, judgements[s], detector.contract);
    add_step(script[s], truth, judgements[s].within_slack.value_or(truth.left_out),
             query.has_value(), rows);
  }
  std::string frames;
  for (const auto& frame : c.frames)
    frames += fmt::format("  {{\n{}  }},\n", rows_text(row_of_array, frame));
  const auto phrases = phrases_of(detector.contract);
  std::string out =
      fmt::format("// Case {}, with the exact answer to each step.\n// Contract: {}.\n", c.id,
                  phrases.empty() ? "leaves nothing out" : joined(phrases, ", "));
  if (detector.contract.separation > 0) out += "// To meet is here to come within that distance.\n";
  if (c.counted) out += "// Of the pairs that count: `counted` of case.json says which do.\n";
  out += head;
  out += query ? fmt::format(fmt::runtime(query_text), query->first_group == 1)
               : fmt::format(fmt::runtime(mesh_text), rows_text(row_of_array, c.triangles),
                             c.triangles.rows(), c.frames[0].rows());
  out += fmt::format(fmt::runtime(lists_text), c.frames[0].rows(), frames, rows.steps,
                     script.size(), rows.pairs, rows.allowed, all_claims_text(),
                     claims_text(detector, query.has_value()), detector.contract.time_tolerance,
                     detector.contract.progress,
                     detector.contract.coordinates == properties::Coordinates::float32
                         ? std::numeric_limits<float>::epsilon()
                         : std::numeric_limits<double>::epsilon(),
                     detector.contract.motion == properties::MotionGiven::displacement);
  return out + judging_program;
}

std::string point_text(const detector::Point& p) {
  return fmt::format("{{{:a}, {:a}, {:a}}}", p[0], p[1], p[2]);
}

// A list of rows, each in braces, as `row` writes it.
template <class List, class Row>
std::string braced(const List& list, const Row& row) {
  std::vector<std::string> rows;
  for (const auto& item : list) rows.push_back(row(item));
  return "{" + joined(rows, ", ") + "}";
}

std::string two_text(std::int32_t a, std::int32_t b) { return fmt::format("{}, {}", a, b); }

// The relation as the built-in detector takes it.
std::string relation_text(const detector::CountedPairs& pairs) {
  const auto number = [](std::int32_t n) { return fmt::format("{}", n); };
  const auto array = [](const auto& two) { return "{{" + two_text(two[0], two[1]) + "}}"; };
  return fmt::format(
      "static const builtin::CountedPairs counted = {{\n"
      "  *assay::from_name<builtin::CountedLevel>(\"{}\"),\n  {},\n  {},\n  {}, {:a},\n  {},\n  "
      "{},\n"
      "  {},\n  {}}};\n",
      name_of(pairs.level), braced(pairs.body, number), braced(pairs.apart, array), pairs.rings,
      pairs.rest_distance,
      braced(pairs.rest, [](const auto& x) { return "{" + point_text(x) + "}"; }),
      braced(pairs.triangle_pairs,
             [](const auto& pair) { return "{" + two_text(pair.a, pair.b) + "}"; }),
      braced(pairs.vertex_faces,
             [](const auto& pair) { return "{" + two_text(pair.vertex, pair.face) + "}"; }),
      braced(pairs.edge_pairs,
             [&](const auto& pair) { return "{" + array(pair.a) + ", " + array(pair.b) + "}"; }));
}

// The same as a plug-in is told it; a pointer that is null if the case has no relation.
std::string told_relation_text(const corpus::Case& c) {
  const auto* pairs = corpus::counted_of(c);
  if (!pairs || pairs->count_all()) return "static const assay_counted_pairs* counted = nullptr;\n";
  std::string lists;
  // An array, the number of its rows as a member, and its name; an empty list is a null pointer.
  const auto member = [&](const char* type, const char* name, const auto& list, bool has_count,
                          const auto& row) {
    const auto count = has_count ? fmt::format("{}, ", list.size()) : "";
    if (list.empty()) return count + "nullptr";
    lists += fmt::format("static const {} counted_{}[] = {};\n", type, name, braced(list, row));
    return fmt::format("{}counted_{}", count, name);
  };
  const std::vector<std::string> members = {
      fmt::format("{}", static_cast<int>(pairs->level)),
      member("std::int32_t", "body", pairs->body, false,
             [](std::int32_t n) { return fmt::format("{}", n); }),
      member("std::int32_t", "apart", pairs->apart, true,
             [](const auto& two) { return two_text(two[0], two[1]); }),
      fmt::format("{}, {:a}", pairs->rings, pairs->rest_distance),
      member("double", "rest", pairs->rest, false,
             [](const auto& x) { return fmt::format("{:a}, {:a}, {:a}", x[0], x[1], x[2]); }),
      member("std::int32_t", "triangle_pairs", pairs->triangle_pairs, true,
             [](const auto& pair) { return two_text(pair.a, pair.b); }),
      member("std::int32_t", "vertex_faces", pairs->vertex_faces, true,
             [](const auto& pair) { return two_text(pair.vertex, pair.face); }),
      member("std::int32_t", "edge_pairs", pairs->edge_pairs, true, [](const auto& pair) {
        return two_text(pair.a[0], pair.a[1]) + ", " + two_text(pair.b[0], pair.b[1]);
      })};
  return lists + fmt::format(
                     "static const assay_counted_pairs counted_pairs = {{{}}};\n"
                     "static const assay_counted_pairs* counted = &counted_pairs;\n",
                     joined(members, ", "));
}

// The options of the built-in detector, the view that each step is given, and the test.
std::string test_text(const corpus::Case& c, const detector::Options& options) {
  std::string views;
  for (std::size_t s = 0; s < corpus::steps_of(c).size(); ++s) {
    std::string given;
    for (const auto& [q0, q1] : properties::given_view(corpus::view_of_step(c, s), options.culling))
      given = fmt::format("{{{{{}, {}}}, {{{}, {}}}}}", point_text(q0.t0), point_text(q0.t1),
                          point_text(q1.t0), point_text(q1.t1));
    views += fmt::format("  {{{}}},\n", given);
  }
  const auto chosen = [](const char* type, const char* name) {
    return fmt::format("  *assay::from_name<builtin::{}>(\"{}\"),\n", type, name);
  };
  const auto* pairs = corpus::counted_of(c);
  return fmt::format(
      "{}{}static const builtin::Options options = {{\n{}{}{}{}{}}};\n"
      "static const Views views[] = {{\n{}}};\n"
      "static const bool is_refused = {}, has_unique_times = {};\n{}",
      test_head, pairs ? relation_text(*pairs) : "", chosen("Culling", name_of(options.culling)),
      chosen("Start", name_of(options.start)), chosen("Pairs", name_of(options.pairs)),
      chosen("Arithmetic", name_of(options.arithmetic)),
      fmt::format("  1, {}, {:a}", pairs ? "&counted" : "nullptr", options.separation), views,
      c.expected.answer == detector::Answer::error,
      properties::claims_of(options).has(properties::Claim::times_unique), test_program);
}

}  // namespace

Expected<void> export_case(const std::filesystem::path& folder, const corpus::Case& c,
                           const properties::DetectorUnderTest& detector,
                           const std::vector<oracle::StepJudgement>& truth) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    return Problem{fmt::format("{}: cannot be made: {}", folder.string(), error.message())};
  std::map<std::string, std::string> files = {{"case.json", corpus::case_text(c)},
                                              {"case.cpp", case_text(c, detector, truth)}};
  const auto faces = rows_text("f {} {} {}\n", c.triangles, 1);
  for (std::size_t f = 0; f < c.frames.size(); ++f)
    files[fmt::format("frame_{:04}.obj", f)] = rows_text("v {} {} {}\n", c.frames[f]) + faces;
  if (detector.built_in) {
    files["case_test.cpp"] = test_text(c, detector.configurations.front().options);
  } else {
    files["case_plugin.cpp"] =
        std::string(reading_program) +
        (properties::says_query(c) ? query_program : told_relation_text(c) + mesh_program) +
        plugin_program;
  }
  for (const auto& [name, text] : files) {
    BOOST_OUTCOME_TRY(corpus::write_file_atomically(folder / name, text));
  }
  return outcome::success();
}

}  // namespace assay::reports
