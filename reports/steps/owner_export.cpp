#include "reports/steps/owner_export.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <map>

#include "properties/judging/step_truth.h"
#include "properties/worker/plugin/query_case.h"
#include "reports/terminal/words.h"

namespace assay::reports {
namespace {

template <class Matrix>
std::string rows_text(const Matrix& matrix) {
  std::string out;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    out += fmt::format("    {{{}, {}, {}}},\n", matrix(i, 0), matrix(i, 1), matrix(i, 2));
  return out;
}

// The rows of the three lists in which a step stands.
struct StepRows {
  std::string steps, pairs, left_out;
  std::size_t pair_count = 0, left_out_count = 0;
};

std::string pair_row(const detector::PairContact& contact, int part) {
  return fmt::format("    {{{}, {}, {}, {}, {}}},\n", contact.pair.a, contact.pair.b,
                     contact.time.lo, contact.time.hi, part);
}

void add_step(const corpus::CaseStep& step, const properties::StepTruth& truth, bool is_query,
              StepRows& rows) {
  const auto time = truth.first ? truth.first->time : detector::TimeEnclosure{};
  // The two triangles of a query only hold the features that are asked for.
  const std::size_t pairs = is_query ? 0 : truth.pairs.size();
  rows.steps += fmt::format("    {{{}, {}, {}, {}, {}, {}, \"{}\", \"{}\", {}, {}, {}, {}}},\n",
                            step.from, step.to, step.commit, truth.first.has_value(), time.lo,
                            time.hi, fraction_of(time.lo), fraction_of(time.hi), rows.pair_count,
                            pairs, rows.left_out_count, truth.left_out.size());
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
  for (const auto& contact : truth.left_out) rows.left_out += pair_row(contact, -1);
  rows.pair_count += pairs;
  rows.left_out_count += truth.left_out.size();
}

constexpr const char* head = R"(#include <algorithm>
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
  int first_pair, pair_count, first_left_out, left_out_count;
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
// Contacts that the contract leaves out: the detector may report them or not.
static const Pair left_out[] = {{
{}    {{-1, -1, 0, 0, -1}},  // the end
}};

// What is claimed of the detector, and asked of it here; the bits are those of
// detector/plugin/assay_detector.h.
enum Claim : unsigned {{
{}
}};
static const unsigned claims = {};
static const double time_tolerance = {};
)";

constexpr const char* judging = R"cpp(
  // A detector's answer to a step.
  struct Found {
    bool filled_in = false;
    bool collision = false;
    double lo = 0, hi = 1;         // the interval of its first time; [0, 1] states none
    std::vector<Pair> pairs;       // that meet, each with the interval of its first time
    std::vector<Pair> candidates;  // of a broad phase; their times do not matter
    bool is_answered = true;       // false: undecided, or a broad phase alone
    std::string error;             // why it has no answer
  };

  static const Pair* find(const Pair* list, std::size_t count, const Pair& pair) {
    for (std::size_t i = 0; i < count; ++i)
      if (list[i].a == pair.a && list[i].b == pair.b) return list + i;
    return nullptr;
  }

  static bool begins_after(double lo, double exact) { return lo > exact + time_tolerance; }
  static bool ends_before(double hi, double exact) { return hi < exact - time_tolerance; }

  static const char* word(bool collision) { return collision ? "collision" : "free"; }

  // Prints what the answer to step s breaks of what is claimed. Returns whether it breaks anything.
  static bool is_wrong(int s, const Found& found) {
    const Step& step = steps[s];
    bool wrong = false;
    const auto ask = [&](Claim claim, const char* name, bool holds) {
      if (holds || !(claims & claim)) return;
      std::printf("step %d breaks %s\n", s + 1, name);
      wrong = true;
    };
    ask(total, "total", found.error.empty());
    if (!found.error.empty()) {
      std::printf("  no answer: %s\n", found.error.c_str());
      return wrong;
    }
    const Pair* const met = pairs + step.first_pair;
    const auto met_count = static_cast<std::size_t>(step.pair_count);
    const Pair* const other = left_out + step.first_left_out;
    const auto other_count = static_cast<std::size_t>(step.left_out_count);
    const auto reported = [&](const Pair& pair) {
      return find(found.pairs.data(), found.pairs.size(), pair);
    };
    if (found.is_answered) {
      const bool both = step.collision && found.collision;
      const bool is_late = both && begins_after(found.lo, step.lo);
      ask(free_sound, "free-sound", found.collision || !step.collision);
      ask(not_late, "not-late", !is_late);
      ask(first_time, "first-time", !is_late && !(both && ends_before(found.hi, step.hi)));
      std::vector<bool> parts(met_count, false);
      bool has_all = true, has_first = true;
      for (std::size_t i = 0; i < met_count; ++i) {
        const Pair* const ours = reported(met[i]);
        has_all = has_all && ours && !begins_after(ours->lo, met[i].lo);
        if (ours && met[i].part >= 0) parts[static_cast<std::size_t>(met[i].part)] = true;
      }
      for (std::size_t i = 0; i < met_count; ++i)
        has_first = has_first && (met[i].part < 0 || parts[static_cast<std::size_t>(met[i].part)]);
      ask(first_pairs, "first-pairs", has_first);
      ask(all_pairs, "all-pairs", has_all);
    }
    bool is_real = !found.collision || step.collision || other_count > 0;
    for (const Pair& ours : found.pairs) {
      const Pair* exact = find(other, other_count, ours);
      if (!exact) exact = find(met, met_count, ours);
      is_real = is_real && exact && !ends_before(ours.hi, exact->hi);
    }
    ask(no_spurious, "no-spurious", is_real);
    bool has_candidates = true;
    for (std::size_t i = 0; i < met_count; ++i)
      has_candidates =
          has_candidates && find(found.candidates.data(), found.candidates.size(), met[i]);
    ask(candidates, "candidates", has_candidates);
    if (!wrong) return false;
    std::printf("  answered %s", found.is_answered ? word(found.collision) : "nothing");
    if (found.collision) std::printf(" at [%.17g, %.17g]", found.lo, found.hi);
    std::printf(", exact %s", word(step.collision));
    if (step.collision) std::printf(" at %.17g (%s)", step.lo, step.lo_as_fraction);
    std::printf("\n");
    for (std::size_t i = 0; i < met_count; ++i) {
      const Pair* const ours = reported(met[i]);
      std::printf("  triangles %d and %d meet at %.17g, ", met[i].a, met[i].b, met[i].lo);
      if (ours)
        std::printf("reported at [%.17g, %.17g]\n", ours->lo, ours->hi);
      else
        std::printf("not reported\n");
    }
    for (const Pair& ours : found.pairs)
      if (!find(met, met_count, ours) && !find(other, other_count, ours))
        std::printf("  triangles %d and %d are reported, and do not meet\n", ours.a, ours.b);
    return true;
  }

  static bool same(const std::vector<Pair>& x, const std::vector<Pair>& y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(), [](const Pair& p, const Pair& q) {
      return p.a == q.a && p.b == q.b && p.lo == q.lo && p.hi == q.hi;
    });
  }

  // Whether two answers to step s differ although `deterministic` is claimed.
  static bool differs(int s, const Found& x, const Found& y) {
    const bool is_same = x.collision == y.collision && x.lo == y.lo && x.hi == y.hi &&
                         x.is_answered == y.is_answered && x.error == y.error &&
                         same(x.pairs, y.pairs) && same(x.candidates, y.candidates);
    if (is_same || !(claims & deterministic)) return false;
    std::printf("step %d breaks deterministic: asked twice, it answers differently\n", s + 1);
    return true;
  }

#ifndef CASE_ARRAYS_ONLY

  // To be filled in: your detector's answer to a step from x_t0 to x_t1.
  static Found ask_your_detector(const double (*x_t0)[3], const double (*x_t1)[3]) {
    (void)x_t0, (void)x_t1;
    Found found;
    return found;  // with found.filled_in = true
  }

  int main() {
    bool wrong = false;
    for (int s = 0; s < step_count; ++s) {
      const double(*const x_t0)[3] = frames[steps[s].from];
      const double(*const x_t1)[3] = frames[steps[s].to];
      const Found found = ask_your_detector(x_t0, x_t1);
      if (!found.filled_in) {
        std::printf("fill in ask_your_detector()\n");
        return 2;
      }
      wrong = is_wrong(s, found) || wrong;
      wrong = differs(s, found, ask_your_detector(x_t0, x_t1)) || wrong;
    }
    return wrong ? 1 : 0;
  }

#endif
)cpp";

constexpr const char* reading =
    R"(// The same case through a plug-in: ./case_plugin ./libmine.so
// Needs detector/plugin/assay_detector.h: c++ -I SOURCES-OF-ASSAY FOLDER/case_plugin.cpp -ldl
#define CASE_ARRAYS_ONLY
#include "case.cpp"

#include <dlfcn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "detector/plugin/assay_detector.h"

static bool is_time(double lo, double hi) { return 0 <= lo && lo <= hi && hi <= 1; }

// Returns what breaks the rules of the interface; empty if nothing does.
static std::string read_pairs(std::uint64_t count, const std::int32_t* raw, const double* times,
                              std::vector<Pair>& list) {
  if (count > 0 && !raw) return "pairs are counted but not given";
  for (std::uint64_t i = 0; i < count; ++i) {
    const int a = std::min(raw[2 * i], raw[2 * i + 1]), b = std::max(raw[2 * i], raw[2 * i + 1]);
    const double lo = times ? times[2 * i] : 0, hi = times ? times[2 * i + 1] : 1;
    if (a < 0 || a == b || b >= triangle_count) return "a pair names no two triangles";
    if (!is_time(lo, hi)) return "the time of a pair is no interval in [0, 1]";
    list.push_back({a, b, lo, hi, -1});
  }
  std::sort(list.begin(), list.end(), [](const Pair& x, const Pair& y) {
    return x.a != y.a ? x.a < y.a : x.b != y.b ? x.b < y.b : x.lo < y.lo;
  });
  const auto same_pair = [](const Pair& x, const Pair& y) { return x.a == y.a && x.b == y.b; };
  list.erase(std::unique(list.begin(), list.end(), same_pair), list.end());
  return "";
}

static std::string text_of(const assay_detector_api* api, const char* function) {
  const char* text = api->abi_version >= 2 && api->error_text ? api->error_text() : nullptr;
  return text ? text : std::string(function) + " failed";
}

// What stands in the way of an answer; empty if nothing does, or it is undecided.
static std::string read_result(const assay_result& raw, Found& found) {
  switch (raw.answer) {
    case ASSAY_FREE:
      return raw.pair_count == 0 ? "" : "answers free and gives pairs";
    case ASSAY_UNDECIDED:
      found.is_answered = false;
      return read_pairs(raw.pair_count, raw.pairs, raw.pair_times, found.pairs);
    case ASSAY_COLLISION:
      found.collision = true;
      found.lo = raw.first_lo;
      found.hi = raw.first_hi;
      if (!is_time(found.lo, found.hi)) return "its first time is no interval in [0, 1]";
      return read_pairs(raw.pair_count, raw.pairs, raw.pair_times, found.pairs);
    case ASSAY_ERROR:
      return raw.message ? raw.message : "an error without a message";
    default:
      return "its answer is none";
  }
}

// Notes a return code; true if the call did its work.
static bool succeeded(const assay_detector_api* api, const char* function, std::int32_t code,
                      Found& found) {
  if (code == ASSAY_OK) return true;
  found.is_answered = false;
  if (code != ASSAY_OUT_OF_MEMORY) found.error = text_of(api, function);
  return false;
}
)";

constexpr const char* mesh_run = R"(
static const char* lacking(const assay_detector_api* api) {
  const bool has_candidates = api->abi_version >= 2 && api->candidates;
  return api->create && (api->evaluate || has_candidates) ? "" : "it takes no steps";
}

static void ask_candidates(const assay_detector_api* api, assay_handle* handle, const Step& step,
                           Found& found) {
  assay_candidates raw = {};
  const std::int32_t code =
      api->candidates(handle, &frames[step.from][0][0], &frames[step.to][0][0], &raw);
  if (!succeeded(api, "candidates", code, found)) return;
  found.error = read_pairs(raw.pair_count, raw.pairs, nullptr, found.candidates);
}

static void ask_step(const assay_detector_api* api, assay_handle* handle, const Step& step,
                     Found& found) {
  assay_result raw = {};
  const std::int32_t code =
      api->evaluate(handle, &frames[step.from][0][0], &frames[step.to][0][0]);
  if (!succeeded(api, "evaluate", code, found)) return;
  if (!succeeded(api, "result", api->result(handle, &raw), found)) return;
  const bool reports_none =
      api->abi_version >= 2 && api->describe()->reports == ASSAY_REPORTS_NO_PAIRS;
  found.error = reports_none && raw.pair_count > 0 ? "gives pairs, and says that it reports none"
                                                   : read_result(raw, found);
  if (step.commit && found.is_answered && found.error.empty())
    succeeded(api, "commit", api->commit(handle), found);
}

static std::vector<Found> run(const assay_detector_api* api) {
  std::vector<Found> list(step_count);
  assay_handle* handle = nullptr;
  const char* message = nullptr;
  const std::int32_t code =
      api->create(&triangles[0][0], triangle_count, &frames[0][0][0], vertex_count, &handle,
                  &message);
  for (int s = 0; s < step_count; ++s) {
    Found& found = list[static_cast<std::size_t>(s)];
    if (code != ASSAY_OK || !handle) {
      found.is_answered = false;
      if (code != ASSAY_OUT_OF_MEMORY) found.error = message ? message : text_of(api, "create");
      continue;
    }
    found.is_answered = api->evaluate != nullptr;
    Found broad;
    if (api->abi_version >= 2 && api->candidates) ask_candidates(api, handle, steps[s], broad);
    if (api->evaluate) ask_step(api, handle, steps[s], found);
    found.candidates = broad.candidates;
    if (found.error.empty()) found.error = broad.error;
  }
  if (handle) api->destroy(handle);
  return list;
}
)";

constexpr const char* query_run = R"(
static const char* lacking(const assay_detector_api* api) {
  return api->abi_version >= 2 && api->query ? "" : "it has no query";
}

static std::vector<Found> run(const assay_detector_api* api) {
  Found found;
  assay_query_result raw = {};
  const std::int32_t code = api->query(is_vertex_face ? ASSAY_QUERY_VERTEX_FACE : ASSAY_QUERY_EDGE_EDGE,
                                       &frames[steps[0].from][0][0], &frames[steps[0].to][0][0], &raw);
  assay_result alike = {};
  alike.answer = raw.answer;
  alike.first_lo = raw.first_lo;
  alike.first_hi = raw.first_hi;
  if (succeeded(api, "query", code, found)) found.error = read_result(alike, found);
  return {found};
}
)";

constexpr const char* plugin_main = R"cpp(
  // The answers as a text; two texts are the same where the answers are.
  static std::string text_of(const std::vector<Found>& list) {
    std::string text;
    const auto add = [&](double lo, double hi) {
      char numbers[100];
      std::snprintf(numbers, sizeof numbers, " [%a, %a]", lo, hi);
      text += numbers;
    };
    for (const Found& found : list) {
      text += found.is_answered ? word(found.collision) : "nothing";
      add(found.lo, found.hi);
      for (const auto* pairs : {&found.pairs, &found.candidates}) {
        text += ";";
        for (const Pair& pair : *pairs) {
          text += " " + std::to_string(pair.a) + "-" + std::to_string(pair.b);
          add(pair.lo, pair.hi);
        }
      }
      text += "; " + found.error + "\n";
    }
    return text;
  }

  // Asks the library in a process of its own, which writes the answers to a pipe.
  static std::string asked_elsewhere(const char* library) {
    int ends[2];
    if (pipe(ends) != 0) return "no pipe";
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
      close(ends[0]);
      execl("/proc/self/exe", "case_plugin", library, std::to_string(ends[1]).c_str(), nullptr);
      _exit(2);
    }
    close(ends[1]);
    std::string text;
    char part[4096];
    for (ssize_t got; (got = read(ends[0], part, sizeof part)) > 0;)
      text.append(part, static_cast<std::size_t>(got));
    close(ends[0]);
    if (child > 0) waitpid(child, nullptr, 0);
    return text;
  }

  static bool is_done = false;

  // The library has ended the program: an answer that never came.
  static void ended(int) {
    std::printf("it crashed or exited%s\n", claims & total ? ", which breaks total" : "");
    std::fflush(stdout);
    std::_Exit(claims & total ? 1 : 0);
  }

  int main(int argc, char** argv) {
    void* library = argc > 1 ? dlopen(argv[1], RTLD_NOW) : nullptr;
    void* entry = library ? dlsym(library, "assay_detector") : nullptr;
    if (!entry) {
      std::printf("usage: case_plugin LIB.so: %s\n", argc > 1 ? dlerror() : "no library");
      return 2;
    }
    const assay_detector_api* api = reinterpret_cast<const assay_detector_api* (*)()>(entry)();
    if (*lacking(api)) {
      std::printf("%s: %s\n", argv[1], lacking(api));
      return 2;
    }
    for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGILL, SIGBUS}) std::signal(signal, ended);
    std::atexit([] {
      if (!is_done) ended(0);
    });
    if (api->abi_version >= 2 && api->use_threads) api->use_threads(1);
    const std::vector<Found> found = run(api);
    if (argc > 2) {
      is_done = true;
      const std::string text = text_of(found);
      return write(std::atoi(argv[2]), text.data(), text.size()) < 0 ? 2 : 0;
    }
    const std::vector<Found> again = run(api);
    is_done = true;
    bool wrong = false;
    if ((claims & deterministic) && asked_elsewhere(argv[1]) != text_of(found)) {
      std::printf("breaks deterministic: in another process it answers differently\n");
      wrong = true;
    }
    for (int s = 0; s < step_count; ++s) {
      const auto place = static_cast<std::size_t>(s);
      wrong = is_wrong(s, found[place]) || wrong;
      wrong = differs(s, found[place], again[place]) || wrong;
    }
    return wrong ? 1 : 0;
  }
)cpp";

// "free_sound | total", in the words of the exported file.
std::string claims_text(const properties::DetectorUnderTest& detector) {
  std::vector<std::string> names;
  for (const auto claim : list_of(properties::judged_claims(detector.claims, detector.contract)))
    names.push_back(replaced(name_of(claim), {{'-', "_"}}));
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

}  // namespace

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

std::string plain_case_text(const corpus::Case& c, const properties::DetectorUnderTest& detector,
                            const std::vector<oracle::StepJudgement>& judgements) {
  const auto query = properties::query_of(c);
  StepRows rows;
  const auto script = corpus::steps_of(c);
  for (std::size_t s = 0; s < script.size(); ++s)
    add_step(script[s], truth_of(c, judgements[s], detector.contract), query.has_value(), rows);
  std::string frames;
  for (const auto& frame : c.frames) frames += fmt::format("  {{\n{}  }},\n", rows_text(frame));
  const auto phrases = phrases_of(detector.contract);
  std::string out =
      fmt::format("// Case {}, with the exact answer to each step.\n// Contract: {}.\n", c.id,
                  phrases.empty() ? "leaves nothing out" : joined(phrases, ", "));
  out += head;
  out += query ? fmt::format(fmt::runtime(query_text), query->first_group == 1)
               : fmt::format(fmt::runtime(mesh_text), rows_text(c.triangles), c.triangles.rows(),
                             c.frames[0].rows());
  out += fmt::format(fmt::runtime(lists_text), c.frames[0].rows(), frames, rows.steps,
                     script.size(), rows.pairs, rows.left_out, all_claims_text(),
                     claims_text(detector), detector.contract.time_tolerance);
  return out + judging;
}

std::string plugin_case_text(bool is_query) {
  return std::string(reading) + (is_query ? query_run : mesh_run) + plugin_main;
}

}  // namespace assay::reports
