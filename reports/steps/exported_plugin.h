// A program that asks a plug-in about an exported case: ./case_plugin ./libmine.so
#pragma once

#include <dlfcn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <tuple>

#include "detector/plugin/assay_detector.h"
#include "reports/steps/exported_case.h"

namespace exported_case {

inline bool is_time(double lo, double hi) { return 0 <= lo && lo <= hi && hi <= 1; }

// Appends the pairs to `list`. Returns how the pairs break a rule of the interface; empty if they
// break no rule.
inline std::string read_pairs(const Case& c, std::uint64_t count, const std::int32_t* raw,
                              const double* times, std::vector<Pair>& list) {
  if (count > 0 && !raw) return "pairs are counted but not given";
  for (std::uint64_t i = 0; i < count; ++i) {
    const int a = std::min(raw[2 * i], raw[2 * i + 1]), b = std::max(raw[2 * i], raw[2 * i + 1]);
    const double lo = times ? times[2 * i] : 0, hi = times ? times[2 * i + 1] : 1;
    if (a < 0 || a == b || b >= c.triangle_count) return "a pair does not name two triangles";
    if (!is_time(lo, hi)) return "the time of a pair is no interval in [0, 1]";
    list.push_back({a, b, lo, hi, -1});
  }
  std::sort(list.begin(), list.end(), [](const Pair& x, const Pair& y) {
    return std::tie(x.a, x.b, x.lo) < std::tie(y.a, y.b, y.lo);
  });
  // If a pair is given twice, the earliest time counts.
  list.erase(std::unique(list.begin(), list.end(),
                         [](const Pair& x, const Pair& y) { return x.a == y.a && x.b == y.b; }),
             list.end());
  return "";
}

// Reads an answer into `found`. Returns the error if there is no answer; empty for free, collision
// and undecided.
inline std::string read_result(const Case& c, const assay_result& raw, Found& found) {
  if (raw.answer == ASSAY_ERROR) return raw.message ? raw.message : "an error without a message";
  if (raw.answer == ASSAY_FREE) return raw.pair_count == 0 ? "" : "answers free and gives pairs";
  if (raw.answer != ASSAY_COLLISION && raw.answer != ASSAY_UNDECIDED) return "an unknown answer";
  found.is_answered = found.collision = raw.answer == ASSAY_COLLISION;
  if (found.collision) {
    found.lo = raw.first_lo;
    found.hi = raw.first_hi;
    if (!is_time(found.lo, found.hi)) return "its first time is no interval in [0, 1]";
  }
  return read_pairs(c, raw.pair_count, raw.pairs, raw.pair_times, found.pairs);
}

// Asks a plug-in about one case. `api` is the table of the plug-in's functions.
class Plugin {
 public:
  Plugin(const Case& c, const assay_detector_api* api, const assay_counted_pairs* counted)
      : case_(c), api_(api), counted_(counted) {}

  // Returns which function the plug-in lacks for this case; empty if it lacks none.
  const char* lacking() const {
    if (case_.query) return api_->abi_version >= 2 && api_->query ? "" : "it has no function query";
    return api_->create && (api_->evaluate || has_candidates() || has_limit())
               ? ""
               : "it takes no steps";
  }

  std::vector<Found> run() const {
    std::vector<Found> list(case_.steps.size());
    if (case_.query) {
      ask_query(case_.steps[0], list[0]);
      return list;
    }
    assay_handle* handle = nullptr;
    const char* message = nullptr;
    const char* failing = "create";
    std::int32_t code = api_->create(case_.triangles, case_.triangle_count, case_.frames,
                                     case_.vertex_count, &handle, &message);
    if (code == ASSAY_OK && handle && counted_) {
      message = nullptr;
      failing = "count";
      const bool takes_it = api_->abi_version >= 3 && api_->count;
      code = takes_it ? api_->count(handle, counted_) : std::int32_t(ASSAY_REFUSED);
    }
    for (std::size_t s = 0; s < list.size(); ++s) {
      Found& found = list[s];
      if (code == ASSAY_OK && handle) {
        ask(handle, case_.steps[s], found);
        continue;
      }
      found.is_answered = false;
      if (code != ASSAY_OUT_OF_MEMORY) found.error = message ? message : why(failing);
    }
    if (handle) api_->destroy(handle);
    return list;
  }

 private:
  bool has_candidates() const { return api_->abi_version >= 2 && api_->candidates; }
  bool has_limit() const { return api_->abi_version >= 3 && api_->limit; }
  std::string why(const char* function) const {
    const char* text = api_->abi_version >= 2 && api_->error_text ? api_->error_text() : nullptr;
    return text ? text : std::string(function) + " failed";
  }
  // Returns whether the return code says that the call succeeded. If not, notes the error in
  // `found`.
  bool succeeded(const char* function, std::int32_t code, Found& found) const {
    if (code == ASSAY_OK) return true;
    found.is_answered = false;
    if (code != ASSAY_OUT_OF_MEMORY) found.error = why(function);
    return false;
  }

  // Returns the motion of a step in the form that the detector takes: end positions or
  // displacements.
  std::vector<double> told(const Step& step) const {
    const double *x_t0 = case_.frame(step.from), *x_t1 = case_.frame(step.to);
    std::vector<double> way(x_t1, x_t1 + case_.coordinates());
    for (std::size_t i = 0; case_.takes_displacements && i < way.size(); ++i)
      way[i] = static_cast<float>(x_t1[i] - x_t0[i]);
    return way;
  }

  void ask_query(const Step& step, Found& found) const {
    assay_query_result raw = {};
    const auto way = told(step);
    const std::int32_t code =
        api_->query(case_.query == 1 ? ASSAY_QUERY_VERTEX_FACE : ASSAY_QUERY_EDGE_EDGE,
                    case_.frame(step.from), way.data(), &raw);
    assay_result alike = {};
    alike.answer = raw.answer;
    alike.first_lo = raw.first_lo;
    alike.first_hi = raw.first_hi;
    if (succeeded("query", code, found)) found.error = read_result(case_, alike, found);
  }

  // Calls candidates(), limit() and evaluate(), in the order in which Assay calls them. Keeps one
  // error: the error of evaluate(), or else the error of limit(), or else the error of
  // candidates().
  void ask(assay_handle* handle, const Step& step, Found& found) const {
    const double* const x_t0 = case_.frame(step.from);
    const auto way = told(step);
    std::string error;
    if (has_candidates()) {
      assay_candidates raw = {};
      if (succeeded("candidates", api_->candidates(handle, x_t0, way.data(), &raw), found))
        found.error = read_pairs(case_, raw.pair_count, raw.pairs, nullptr, found.candidates);
      error = found.error;
    }
    if (has_limit()) {
      assay_limit raw = {};
      raw.share = -1;
      if (succeeded("limit", api_->limit(handle, x_t0, way.data(), &raw), found)) {
        found.share = raw.share;
        if (raw.share != -1 && !(raw.share >= 0 && raw.share <= 1))
          found.error = "limit gives a share that is not from 0 to 1";
        // If no positions are given, a share of 1 stands for the end, and any other for the start.
        const double* const stop = raw.positions    ? raw.positions
                                   : raw.share == 1 ? case_.frame(step.to)
                                                    : x_t0;
        found.stop.assign(stop, stop + case_.coordinates());
      }
      error = found.error;
    }
    found.error.clear();
    found.is_answered = api_->evaluate != nullptr;
    if (api_->evaluate) ask_step(handle, step, way, found);
    if (found.error.empty()) found.error = error;
  }

  void ask_step(assay_handle* handle, const Step& step, const std::vector<double>& way,
                Found& found) const {
    assay_result raw = {};
    const std::int32_t code = api_->evaluate(handle, case_.frame(step.from), way.data());
    if (!succeeded("evaluate", code, found)) return;
    if (!succeeded("result", api_->result(handle, &raw), found)) return;
    const bool reports_none =
        api_->abi_version >= 2 && api_->describe()->reports == ASSAY_REPORTS_NO_PAIRS;
    found.error = reports_none && raw.pair_count > 0 ? "gives pairs, but says that it reports none"
                                                     : read_result(case_, raw, found);
    if (step.commit && found.is_answered && found.error.empty())
      succeeded("commit", api_->commit(handle), found);
  }

  const Case& case_;
  const assay_detector_api* api_;
  const assay_counted_pairs* counted_;
};

inline bool is_asked(const Case& c, Claim claim) {
  return std::any_of(c.asked.begin(), c.asked.end(),
                     [&](const Asked& one) { return one.claim == claim; });
}

inline std::string text_of(const std::vector<Found>& list) {
  std::string text;
  for (const Found& found : list) text += text_of(found);
  return text;
}

// Asks the library in a process of its own, which writes the text of its answers to a pipe. Returns
// whether that process came to its end, and the library neither crashed nor exited.
inline bool ask_elsewhere(const char* library, std::string& text) {
  int ends[2];
  if (pipe(ends) != 0) return false;
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    execl("/proc/self/exe", "case_plugin", library, std::to_string(ends[1]).c_str(), nullptr);
    _exit(2);
  }
  close(ends[1]);
  char part[4096];
  for (ssize_t got; (got = read(ends[0], part, sizeof part)) > 0;)
    text.append(part, static_cast<std::size_t>(got));
  close(ends[0]);
  int status = 0;
  return child > 0 && waitpid(child, &status, 0) == child && status == 0 && !text.empty();
}

// Runs the program. Its first argument is the library. The process that ask_elsewhere() starts has
// a second argument: the file descriptor to which it writes the answers. Returns 0 if no claim that
// is asked is broken, 1 if a claim is broken, and 2 if the library cannot be asked.
inline int ask_library(const Case& c, const assay_counted_pairs* counted, int argc, char** argv) {
  void* library = argc > 1 ? dlopen(argv[1], RTLD_NOW) : nullptr;
  void* entry = library ? dlsym(library, "assay_detector") : nullptr;
  if (!entry) {
    std::printf("usage: case_plugin LIB.so: %s\n", argc > 1 ? dlerror() : "no library");
    return 2;
  }
  const assay_detector_api* api = reinterpret_cast<const assay_detector_api* (*)()>(entry)();
  const Plugin plugin(c, api, counted);
  if (*plugin.lacking()) {
    std::printf("%s: %s\n", argv[1], plugin.lacking());
    return 2;
  }
  std::string elsewhere;
  if (argc == 2 && !ask_elsewhere(argv[1], elsewhere)) {
    const bool is_wrong = is_asked(c, Claim::total);
    std::printf("the library crashed or exited%s\n", is_wrong ? ", which breaks total" : "");
    return is_wrong ? 1 : 0;
  }
  if (api->abi_version >= 2 && api->use_threads) api->use_threads(1);
  const std::vector<Found> found = plugin.run();
  const std::string text = text_of(found);
  if (argc > 2) return write(std::atoi(argv[2]), text.data(), text.size()) < 0 ? 2 : 0;
  const std::vector<Found> again = plugin.run();
  bool wrong = is_asked(c, Claim::deterministic) && elsewhere != text;
  if (wrong) std::printf("breaks deterministic: another process gets another answer\n");
  for (std::size_t s = 0; s < c.steps.size(); ++s)
    wrong = is_wrong(c, s, found[s], again[s]) || wrong;
  return wrong ? 1 : 0;
}

}  // namespace exported_case
