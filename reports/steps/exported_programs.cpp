#include "reports/steps/exported_programs.h"

namespace assay::reports {

const char* const judging_program = R"text(
// A detector's answer to a step.
struct Found {
  bool filled_in = false;
  bool collision = false;
  double lo = 0, hi = 1;         // the interval of its first time; [0, 1] states none
  std::vector<Pair> pairs;       // that meet, each with the interval of its first time
  std::vector<Pair> candidates;  // of a broad phase; their times do not matter
  double share = -1;             // of a limiter: of the step; -1: not stated
  std::vector<double> stop;      // of a limiter: where the caller stops; else empty
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

static bool ends_at(const std::vector<double>& stop, int frame) {
  const double* const x = &frames[frame][0][0];
  const auto is_near = [](double at, double end) {
    return at == end || (takes_displacements && at == static_cast<float>(end));
  };
  return std::equal(stop.begin(), stop.end(), x, is_near);
}

// Whether numbers leave room for a share of a step: it moves some coordinate by 2^10 units in its
// last place.
static bool has_room(const Step& step, double share) {
  const double *x_t0 = &frames[step.from][0][0], *x_t1 = &frames[step.to][0][0];
  for (std::size_t i = 0; i < sizeof frames[0] / sizeof(double); ++i)
    if (std::fabs(share * (x_t1[i] - x_t0[i])) >= 0x1p10 * unit * std::fabs(x_t0[i])) return true;
  return false;
}

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
  const Pair* const other = allowed + step.first_allowed;
  const auto other_count = static_cast<std::size_t>(step.allowed_count);
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
  if (!found.stop.empty() && !(step.collision && step.hi == 0)) {
    const double ahead = step.collision ? step.lo : 1;
    const bool is_whole = ends_at(found.stop, step.to);
    // That the way to other positions is free, `assay replay` alone can tell.
    ask(commit_free, "commit-free", !(is_whole && step.collision));
    ask(whole_when_safe, "whole-when-safe", step.collision || is_whole);
    if (found.share >= 0) {
      const bool is_before =
          step.lo == step.hi ? found.share < step.lo : found.share <= step.lo;
      ask(path_free, "path-free", !step.collision || is_before);
      ask(progress, "progress",
          found.share >= promised * ahead * (1 - 1e-15) || !has_room(step, promised * ahead));
    }
  }
  if (!wrong) return false;
  if (!found.stop.empty()) std::printf("  allowed a share of %.17g\n", found.share);
  std::printf("  answered %s", found.is_answered ? word(found.collision) : "nothing");
  if (found.collision) std::printf(" at [%.17g, %.17g]", found.lo, found.hi);
  std::printf(", exact %s", word(step.collision));
  if (step.collision) std::printf(" at %.17g (%s)", step.lo, step.lo_as_fraction);
  std::printf("\n");
  for (std::size_t i = 0; i < met_count; ++i) {
    const Pair* const ours = reported(met[i]);
    std::printf("  triangles %d and %d at %.17g, ", met[i].a, met[i].b, met[i].lo);
    if (ours)
      std::printf("reported at [%.17g, %.17g]\n", ours->lo, ours->hi);
    else
      std::printf("not reported\n");
  }
  for (const Pair& ours : found.pairs)
    if (!find(met, met_count, ours) && !find(other, other_count, ours))
      std::printf("  triangles %d and %d are reported, and should not be\n", ours.a, ours.b);
  return true;
}

// An answer as a text; two texts are the same where the answers are.
static std::string text_of(const Found& found) {
  std::string text = found.is_answered ? word(found.collision) : "nothing";
  const auto add = [&](double lo, double hi) {
    char numbers[100];
    std::snprintf(numbers, sizeof numbers, " [%a, %a]", lo, hi);
    text += numbers;
  };
  add(found.lo, found.hi);
  for (const auto* pairs : {&found.pairs, &found.candidates}) {
    text += ";";
    for (const Pair& pair : *pairs) {
      text += " " + std::to_string(pair.a) + "-" + std::to_string(pair.b);
      add(pair.lo, pair.hi);
    }
  }
  add(found.share, found.share);
  for (const double x : found.stop) add(x, x);
  return text + "; " + found.error + "\n";
}

// Whether two answers to step s differ although `deterministic` is claimed.
static bool differs(int s, const Found& x, const Found& y) {
  if (!(claims & deterministic) || text_of(x) == text_of(y)) return false;
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
)text";

const char* const reading_program =
    R"text(// The same case through a plug-in: ./case_plugin ./libmine.so
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

// Where a step goes, as the detector is told it: by its end or by its displacement.
static const double* told(const Step& step) {
  const double *x_t0 = &frames[step.from][0][0], *x_t1 = &frames[step.to][0][0];
  if (!takes_displacements) return x_t1;
  static std::vector<double> way;
  way.clear();
  for (std::size_t i = 0; i < sizeof frames[0] / sizeof(double); ++i)
    way.push_back(static_cast<float>(x_t1[i] - x_t0[i]));
  return way.data();
}

// Returns what breaks the rules of the interface; empty if nothing does.
static std::string read_pairs(std::uint64_t count, const std::int32_t* raw,
                              const double* times, std::vector<Pair>& list) {
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

static std::string why(const assay_detector_api* api, const char* function) {
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
static bool succeeded(const assay_detector_api* api, const char* function,
                      std::int32_t code, Found& found) {
  if (code == ASSAY_OK) return true;
  found.is_answered = false;
  if (code != ASSAY_OUT_OF_MEMORY) found.error = why(api, function);
  return false;
}
)text";

const char* const mesh_program = R"text(
static const char* lacking(const assay_detector_api* api) {
  const bool has_candidates = api->abi_version >= 2 && api->candidates;
  const bool has_limit = api->abi_version >= 3 && api->limit;
  return api->create && (api->evaluate || has_candidates || has_limit) ? "" : "it takes no steps";
}

static void ask_limit(const assay_detector_api* api, assay_handle* handle, const Step& step,
                      Found& found) {
  assay_limit raw = {};
  raw.share = -1;
  const double *x_t0 = &frames[step.from][0][0], *x_t1 = &frames[step.to][0][0];
  if (!succeeded(api, "limit", api->limit(handle, x_t0, told(step), &raw), found)) return;
  found.share = raw.share;
  if (raw.share != -1 && !(raw.share >= 0 && raw.share <= 1)) found.error = "its share is none";
  // Where it says no positions, only whether they are the end is asked here.
  const double* const stop = raw.positions ? raw.positions : raw.share == 1 ? x_t1 : x_t0;
  found.stop.assign(stop, stop + 3 * vertex_count);
}

static void ask_candidates(const assay_detector_api* api, assay_handle* handle, const Step& step,
                           Found& found) {
  assay_candidates raw = {};
  const std::int32_t code =
      api->candidates(handle, &frames[step.from][0][0], told(step), &raw);
  if (!succeeded(api, "candidates", code, found)) return;
  found.error = read_pairs(raw.pair_count, raw.pairs, nullptr, found.candidates);
}

static void ask_step(const assay_detector_api* api, assay_handle* handle, const Step& step,
                     Found& found) {
  assay_result raw = {};
  const std::int32_t code = api->evaluate(handle, &frames[step.from][0][0], told(step));
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
  std::int32_t code = api->create(&triangles[0][0], triangle_count, &frames[0][0][0],
                                  vertex_count, &handle, &message);
  const char* failing = "create";
  if (code == ASSAY_OK && handle && counted) {
    message = nullptr;
    failing = "count";
    const bool takes_it = api->abi_version >= 3 && api->count;
    code = takes_it ? api->count(handle, counted) : std::int32_t(ASSAY_REFUSED);
  }
  for (int s = 0; s < step_count; ++s) {
    Found& found = list[static_cast<std::size_t>(s)];
    if (code != ASSAY_OK || !handle) {
      found.is_answered = false;
      if (code != ASSAY_OUT_OF_MEMORY) found.error = message ? message : why(api, failing);
      continue;
    }
    found.is_answered = api->evaluate != nullptr;
    Found broad;
    if (api->abi_version >= 2 && api->candidates) ask_candidates(api, handle, steps[s], broad);
    if (api->abi_version >= 3 && api->limit) ask_limit(api, handle, steps[s], broad);
    if (api->evaluate) ask_step(api, handle, steps[s], found);
    found.candidates = broad.candidates;
    found.share = broad.share;
    found.stop = broad.stop;
    if (found.error.empty()) found.error = broad.error;
  }
  if (handle) api->destroy(handle);
  return list;
}
)text";

const char* const query_program = R"text(
static const char* lacking(const assay_detector_api* api) {
  return api->abi_version >= 2 && api->query ? "" : "it has no query";
}

static std::vector<Found> run(const assay_detector_api* api) {
  Found found;
  assay_query_result raw = {};
  const std::int32_t code =
      api->query(is_vertex_face ? ASSAY_QUERY_VERTEX_FACE : ASSAY_QUERY_EDGE_EDGE,
                 &frames[steps[0].from][0][0], told(steps[0]), &raw);
  assay_result alike = {};
  alike.answer = raw.answer;
  alike.first_lo = raw.first_lo;
  alike.first_hi = raw.first_hi;
  if (succeeded(api, "query", code, found)) found.error = read_result(alike, found);
  return {found};
}
)text";

const char* const plugin_program = R"text(
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
  std::string text;
  for (const Found& one : found) text += text_of(one);
  if (argc > 2) {
    is_done = true;
    return write(std::atoi(argv[2]), text.data(), text.size()) < 0 ? 2 : 0;
  }
  const std::vector<Found> again = run(api);
  is_done = true;
  bool wrong = false;
  if ((claims & deterministic) && asked_elsewhere(argv[1]) != text) {
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
)text";

const char* const test_head =
    R"text(// The same case through the built-in detector: a GoogleTest, to be compiled with
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
  return Eigen::Map<const builtin::Positions>(&frames[number][0][0], vertex_count, 3);
}
)text";

const char* const test_program = R"text(
TEST(AssayCase, Holds) {
  const builtin::Triangles mesh =
      Eigen::Map<const builtin::Triangles>(&triangles[0][0], triangle_count, 3);
  auto made = builtin::Detector::create(mesh, frame(0), options);
  ASSERT_EQ(made.has_value(), !is_refused);
  if (is_refused) return;
  auto again = builtin::Detector::create(mesh, frame(0), options);
  for (int s = 0; s < step_count; ++s) {
    const auto ask = [s](builtin::Detector& detector) {
      const auto x_t0 = frame(steps[s].from), x_t1 = frame(steps[s].to);
      return found_by(steps[s].commit ? detector.step(x_t0, x_t1, views[s])
                                      : detector.evaluate(x_t0, x_t1, views[s]));
    };
    const Found found = ask(made.value());
    EXPECT_TRUE(found.is_answered);
    EXPECT_FALSE(is_wrong(s, found));
    EXPECT_FALSE(differs(s, found, ask(again.value())));
    if (has_unique_times && steps[s].collision) {
      EXPECT_EQ(found.lo, steps[s].lo);
      EXPECT_EQ(found.hi, steps[s].hi);
    }
  }
}
)text";

}  // namespace assay::reports
