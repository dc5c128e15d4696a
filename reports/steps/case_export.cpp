#include "reports/steps/case_export.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "corpus/files.h"
#include "properties/judging/agreement.h"
#include "properties/judging/case_options.h"
#include "properties/worker/case_run.h"
#include "properties/worker/plugin/query_case.h"
#include "reports/steps/exported_case.h"
#include "reports/steps/exported_plugin.h"
#include "reports/terminal/words.h"

namespace assay::reports {

// The two headers as texts; CMakeLists.txt makes them of the files.
extern const char *const exported_case_header, *const exported_plugin_header;

namespace {

// Returns one line for each row of three numbers.
template <class Matrix>
std::string rows_text(const char* format, const Matrix& matrix, int add = 0) {
  std::string out;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    out += fmt::format(fmt::runtime(format), matrix(i, 0) + add, matrix(i, 1) + add,
                       matrix(i, 2) + add);
  return out;
}

constexpr const char* row_of_array = "    {{{}, {}, {}}},\n";

// Returns the exact value of a double in [0, 1] as a fraction, such as "3/8", in lowest terms.
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

std::string pair_rows(const std::vector<detector::PairContact>& contacts,
                      const std::map<detector::TrianglePair, int>& part_of) {
  std::string rows;
  for (const auto& contact : contacts) {
    const auto part = part_of.find(contact.pair);
    rows +=
        fmt::format("\n     {{{}, {}, {}, {}, {}}},", contact.pair.a, contact.pair.b,
                    contact.time.lo, contact.time.hi, part == part_of.end() ? -1 : part->second);
  }
  return "{" + rows + "}";
}

// Returns the row of a step. Its `allowed` pairs need not be reported: those that the contract
// leaves out or, if it has a slack, all pairs within the slack.
std::string step_row(const corpus::CaseStep& step, const properties::StepTruth& truth,
                     const std::vector<detector::PairContact>& allowance, bool is_query) {
  const auto time = truth.first ? truth.first->time : detector::TimeEnclosure{};
  std::map<detector::TrianglePair, int> part_of;
  int part = 0;
  for (const auto& contacts : properties::contact_parts(truth.pairs, time)) {
    for (const auto& contact : contacts) part_of[contact.pair] = part;
    ++part;
  }
  return fmt::format("   {{{}, {}, {}, {}, {}, {}, \"{}\", \"{}\",\n    {},\n    {}}},\n",
                     step.from, step.to, step.commit, truth.first.has_value(), time.lo, time.hi,
                     fraction_of(time.lo), fraction_of(time.hi),
                     // The two triangles of a query only hold the features that are asked for.
                     is_query ? "{}" : pair_rows(truth.pairs, part_of), pair_rows(allowance, {}));
}

constexpr const char* arrays_text = R"(#include "exported_case.h"

using namespace exported_case;

{}
static const int triangles[][3] = {{
{}}};

// Where the vertices are; within a step they move along straight lines.
static const double frames[][{}][3] = {{
{}}};

// The steps with their exact answers, what is asked of each, and the numbers of the contract.
static const Case the_case = {{
  {}, &triangles[0][0], {}, {}, &frames[0][0][0],
  {{
{}  }},
  {{{}}},
  {}, {}, {}, {}}};
)";

constexpr const char* mesh_about =
    "// The mesh: vertex indices of each triangle, counter-clockwise seen from outside.";
constexpr const char* query_about =
    "// The step of four points: a vertex and the three corners of a face, or the end points of "
    "two\n"
    "// edges. The question is whether the two features meet; the triangles only contain them.";

constexpr const char* filled_in_program = R"(
#ifndef CASE_ARRAYS_ONLY

// To be filled in: your detector's answer to a step from x_t0 to x_t1, three numbers a vertex.
static Found ask_your_detector(const double* x_t0, const double* x_t1) {
  (void)x_t0, (void)x_t1;
  Found found;
  return found;  // with found.filled_in = true
}

int main() {
  bool wrong = false;
  for (std::size_t s = 0; s < the_case.steps.size(); ++s) {
    const double* const x_t0 = the_case.frame(the_case.steps[s].from);
    const double* const x_t1 = the_case.frame(the_case.steps[s].to);
    const Found found = ask_your_detector(x_t0, x_t1);
    if (!found.filled_in) {
      std::printf("fill in ask_your_detector()\n");
      return 2;
    }
    wrong = is_wrong(the_case, s, found, ask_your_detector(x_t0, x_t1)) || wrong;
  }
  return wrong ? 1 : 0;
}

#endif
)";

// Whoever adds a claim adds it to exported_case.h, and there the compiler asks how it is judged.
static_assert(static_cast<int>(exported_case::Claim::times_unique) ==
              static_cast<int>(properties::Claim::times_unique));

// Returns the claims that an answer is checked for: the broken claim, or all judged claims if none
// is broken.
std::string asked_text(const properties::DetectorUnderTest& detector, bool is_query,
                       std::optional<properties::Claim> claim) {
  const auto claims = detector.claims_in(detector.configurations.front());
  auto claim_list = properties::judged_claims(claims, detector.contract, is_query);
  if (claim) claim_list = {*claim};
  std::vector<std::string> names;
  for (const auto& word : words_of(claim_list))
    names.push_back(fmt::format("{{Claim::{}, \"{}\"}}", replace(word, {{'-', "_"}}), word));
  return join(names, ", ");
}

// Returns the arrays of the case and the claims that its answers are checked for, with a function
// to fill in.
std::string case_text(const corpus::Case& c, const properties::DetectorUnderTest& detector,
                      const std::vector<oracle::StepJudgement>& judgements,
                      std::optional<properties::Claim> claim) {
  const auto query = properties::query_of(c);
  const auto& contract = detector.contract;
  const auto script = corpus::steps_of(c);
  std::string steps, frames;
  for (std::size_t s = 0; s < script.size(); ++s) {
    const auto truth = truth_of(c, judgements[s], contract);
    steps += step_row(script[s], truth, judgements[s].within_slack.value_or(truth.left_out),
                      query.has_value());
  }
  for (const auto& frame : c.frames)
    frames += fmt::format("  {{\n{}  }},\n", rows_text(row_of_array, frame));
  const auto phrases = phrases_of(contract);
  std::string out =
      fmt::format("// Case {}, with the exact answer to each step.\n// Contract: {}.\n", c.id,
                  phrases.empty() ? "leaves nothing out" : join(phrases, ", "));
  if (contract.separation > 0) out += "// `Meet` means here: come within that distance.\n";
  if (c.counted) out += "// Only some pairs count: `counted` of case.json says which.\n";
  const auto claims_text = asked_text(detector, query.has_value(), claim);
  const bool is_float = contract.coordinates == properties::Coordinates::float32;
  return out +
         fmt::format(fmt::runtime(arrays_text), query ? query_about : mesh_about,
                     rows_text(row_of_array, c.triangles), c.frames[0].rows(), frames,
                     !query                    ? 0
                     : query->first_group == 1 ? 1
                                               : 2,
                     c.triangles.rows(), c.frames[0].rows(), steps, claims_text,
                     contract.time_tolerance, contract.progress,
                     is_float ? std::numeric_limits<float>::epsilon()
                              : std::numeric_limits<double>::epsilon(),
                     contract.motion == properties::MotionGiven::displacement) +
         filled_in_program;
}

std::string point_text(const detector::Point& p) {
  return fmt::format("{{{:a}, {:a}, {:a}}}", p[0], p[1], p[2]);
}

// Returns a list of rows, each in braces, as `row` writes it.
template <class List, class Row>
std::string braced(const List& list, const Row& row) {
  std::vector<std::string> rows;
  for (const auto& item : list) rows.push_back(row(item));
  return "{" + join(rows, ", ") + "}";
}

std::string two_text(std::int32_t a, std::int32_t b) { return fmt::format("{}, {}", a, b); }

// Returns the relation as the built-in detector takes it.
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

// Returns the relation as a plug-in is told it: a pointer that is null if the case has no relation.
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
                     join(members, ", "));
}

constexpr const char* plugin_head =
    R"(// The same case through a plug-in: ./case_plugin ./libmine.so
// Needs detector/plugin/assay_detector.h: c++ -I SOURCES-OF-ASSAY FOLDER/case_plugin.cpp -ldl
#define CASE_ARRAYS_ONLY
#include "case.cpp"

#include "exported_plugin.h"

)";

constexpr const char* plugin_main = R"(
int main(int argc, char** argv) { return ask_library(the_case, counted, argc, argv); }
)";

constexpr const char* test_head =
    R"(// The same case through the built-in detector: a GoogleTest, to be compiled with
// -I SOURCES-OF-ASSAY and linked with its detector.
#define CASE_ARRAYS_ONLY
#include "case.cpp"

#include <gtest/gtest.h>

#include "detector/detector.h"
#include "detector/step_result.h"

namespace builtin = assay::detector;
using Views = std::vector<builtin::ViewPrimitive>;

static Found found_by(const builtin::StepResult& result) {
  Found found;
  found.collision = result.answer == builtin::Answer::collision;
  found.is_answered = found.collision || result.answer == builtin::Answer::free;
  if (found.collision) found.lo = result.first.lo, found.hi = result.first.hi;
  for (const auto& one : result.pairs)
    found.pairs.push_back({one.pair.a, one.pair.b, one.time.lo, one.time.hi, -1});
  if (result.answer == builtin::Answer::error) found.error = result.problem->message;
  return found;
}

static builtin::Positions frame(int number) {
  return Eigen::Map<const builtin::Positions>(the_case.frame(number), the_case.vertex_count, 3);
}
)";

constexpr const char* test_program = R"(
TEST(AssayCase, Holds) {
  const builtin::Triangles mesh =
      Eigen::Map<const builtin::Triangles>(the_case.triangles, the_case.triangle_count, 3);
  auto made = builtin::Detector::create(mesh, frame(0), options);
  ASSERT_EQ(made.has_value(), !is_refused);
  if (is_refused) return;
  auto again = builtin::Detector::create(mesh, frame(0), options);
  for (std::size_t s = 0; s < the_case.steps.size(); ++s) {
    const auto ask = [s](builtin::Detector& detector) {
      const Step& step = the_case.steps[s];
      const auto x_t0 = frame(step.from), x_t1 = frame(step.to);
      return found_by(step.commit ? detector.step(x_t0, x_t1, views[s])
                                  : detector.evaluate(x_t0, x_t1, views[s]));
    };
    const Found found = ask(made.value());
    EXPECT_TRUE(found.is_answered);
    EXPECT_FALSE(is_wrong(the_case, s, found, ask(again.value())));
    EXPECT_TRUE(!has_unique_times ||
                holds(Claim::times_unique, the_case, the_case.steps[s], found));
  }
}
)";

// Returns the options of the built-in detector, the view that each step is given, and the test.
std::string test_text(const corpus::Case& c, const properties::DetectorUnderTest& detector) {
  const auto& configuration = detector.configurations.front();
  const auto& options = configuration.options;
  std::string views;
  for (std::size_t s = 0; s < corpus::steps_of(c).size(); ++s) {
    std::string arguments;
    for (const auto& [q0, q1] : properties::given_view(corpus::view_of_step(c, s), options.culling))
      arguments = fmt::format("{{{{{}, {}}}, {{{}, {}}}}}", point_text(q0.t0), point_text(q0.t1),
                              point_text(q1.t0), point_text(q1.t1));
    views += fmt::format("  {{{}}},\n", arguments);
  }
  const auto argument = [](const char* type, const char* name) {
    return fmt::format("  *assay::from_name<builtin::{}>(\"{}\"),\n", type, name);
  };
  const auto* pairs = corpus::counted_of(c);
  return fmt::format(
      "{}{}static const builtin::Options options = {{\n{}{}{}{}{}}};\n"
      "static const Views views[] = {{\n{}}};\n"
      "static const bool is_refused = {}, has_unique_times = {};\n{}",
      test_head, pairs ? relation_text(*pairs) : "", argument("Culling", name_of(options.culling)),
      argument("Start", name_of(options.start)), argument("Pairs", name_of(options.pairs)),
      argument("Arithmetic", name_of(options.arithmetic)),
      fmt::format("  1, {}, {:a}", pairs ? "&counted" : "nullptr", options.separation), views,
      c.expected.answer == detector::Answer::error,
      detector.claims_in(configuration).has(properties::Claim::times_unique), test_program);
}

}  // namespace

Expected<void> export_case(const std::filesystem::path& folder, const corpus::Case& c,
                           const properties::DetectorUnderTest& detector,
                           const std::vector<oracle::StepJudgement>& truth,
                           std::optional<properties::Claim> claim) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    return Problem{fmt::format("{}: cannot be made: {}", folder.string(), error.message())};
  std::map<std::string, std::string> files = {{"case.json", corpus::case_text(c)},
                                              {"case.cpp", case_text(c, detector, truth, claim)},
                                              {"exported_case.h", exported_case_header}};
  const auto faces = rows_text("f {} {} {}\n", c.triangles, 1);
  for (std::size_t f = 0; f < c.frames.size(); ++f)
    files[fmt::format("frame_{:04}.obj", f)] = rows_text("v {} {} {}\n", c.frames[f]) + faces;
  if (detector.built_in) {
    files["case_test.cpp"] = test_text(c, detector);
  } else {
    files["case_plugin.cpp"] = plugin_head + told_relation_text(c) + plugin_main;
    files["exported_plugin.h"] = exported_plugin_header;
  }
  for (const auto& [name, text] : files) {
    BOOST_OUTCOME_TRY(corpus::write_file_atomically(folder / name, text));
  }
  return outcome::success();
}

}  // namespace assay::reports
