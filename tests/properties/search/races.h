// A race of the search against random cases, the trials of the strata: until the first defect of a
// detector. Both run in this process, so that processor time is that of the cases alone.
#pragma once

#include <fmt/format.h>

#include <ctime>
#include <optional>
#include <set>

#include "properties/campaign/trials/planned_case.h"
#include "properties/faults/fault.h"
#include "properties/generators/families.h"
#include "properties/judging/fault_run.h"
#include "properties/judging/subject.h"
#include "properties/search/search.h"
#include "properties/worker/plugin/plugin_host.h"

namespace assay::properties::test {

// A detector that runs a case in this process.
struct Runner {
  DetectorUnderTest detector;
  std::function<CaseRun(const corpus::Case&)> run;
  std::function<bool(const corpus::Case&)> shows_it_as_it_is{};  // of a curated case
};

inline SearchedCase judged_by(const Runner& runner, const corpus::Case& c) {
  SearchedCase judged;
  judged.runs.push_back(runner.run(c));
  judged.truth = judge_case(c, runner.detector.contract);
  judged.trials.push_back(judge_trial(c, judged.truth, judged.runs[0],
                                      runner.detector.configurations[0], runner.detector));
  return judged;
}

inline Runner runner_of(const Fault& fault) {
  Runner runner;
  runner.detector = built_in_detector();
  runner.detector.configurations = {{std::string(fault.name), fault.options}};
  runner.run = [&fault](const corpus::Case& c) {
    CaseRun run;
    run.steps = run_case(c, fault);
    return run;
  };
  // A fault must not be found by a case that was made for it, or that shows it by chance.
  std::set<std::string> shown_by;
  const auto files = corpus::case_files(ASSAY_SOURCE_DIR "/corpus/curated");
  for (const auto& file : files.value()) {
    const auto c = corpus::read_case(file);
    if (c && judged_by(runner, c.value()).trials[0].failure) shown_by.insert(c.value().id);
  }
  runner.shows_it_as_it_is = [shown_by](const corpus::Case& c) { return shown_by.contains(c.id); };
  return runner;
}

// The library stays loaded. Nothing if it was not built.
inline std::optional<Runner> runner_of_peer(const std::string& name) {
  const auto host = PluginHost::open(std::string(ASSAY_PEER_DIR) + "/" + name + ".so");
  if (!host) return std::nullopt;
  const auto& plugin = host.value().description();
  Runner runner;
  runner.detector = {
      plugin.name, false, claims_on_steps(plugin), plugin.contract, {{plugin.name, {}}}};
  runner.run = [host = host.value()](const corpus::Case& c) { return host.run(c); };
  return runner;
}

struct FirstDefect {
  bool found = false;
  std::uint64_t cases = 0;
  double seconds = 0;            // of processor time
  std::uint64_t candidates = 0;  // of the oracle, in all cases: a measure of work that is no clock

  void count(const SearchedCase& judged) {
    ++cases;
    for (const auto& step : judged.truth) candidates += step.feature_candidates;
  }
};

// How long a racer may run.
struct RaceLimits {
  std::uint64_t cases = 0;
  double seconds = 1e9;
};

class ProcessorClock {
 public:
  double seconds() const { return now() - begin_; }

 private:
  static double now() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
  double begin_ = now();
};

inline FirstDefect race_at_random(const Runner& runner, int seed, const RaceLimits& limits) {
  FirstDefect first;
  const ProcessorClock clock;
  // But for everyday numbers: trials find the racing peer there at once, and nothing is left to
  // search.
  std::vector<Family> known(families().begin(), families().end());
  std::erase_if(known, [](const Family& family) { return family.name.ends_with("-everyday"); });
  while (first.cases < limits.cases && clock.seconds() < limits.seconds) {
    const auto& family = known[first.cases % known.size()];
    const auto c =
        case_within(runner.detector.contract, family,
                    fmt::format("race:{}:{}:{}", seed, family.name, first.cases / known.size()));
    const auto judged = c.seen ? judged_by(runner, *c.seen) : SearchedCase{};
    first.count(judged);
    if (!c.seen || !judged.trials[0].failure) continue;
    first.found = true;
    break;
  }
  first.seconds = clock.seconds();
  return first;
}

inline SearchSpace racing_space(const Runner& runner) {
  const auto& contract = runner.detector.contract;
  return {contract,
          case_sources({true, false, ASSAY_SOURCE_DIR "/corpus/curated", runner.shows_it_as_it_is}),
          [&contract](corpus::Case c) { return brought_into_contract(std::move(c), contract); },
          runner.detector.built_in};
}

inline FirstDefect race_by_search(const Runner& runner, int seed, const RaceLimits& limits) {
  FirstDefect first;
  const SearchSpace space = racing_space(runner);
  const ProcessorClock clock;
  const JudgeCases judge = [&](std::span<const corpus::Case> cases) {
    std::vector<SearchedCase> judged;
    for (const auto& c : cases) {
      judged.push_back(first.found ? SearchedCase{} : judged_by(runner, c));
      if (first.found) continue;
      first.count(judged.back());
      if (!judged.back().trials[0].failure) continue;
      first.found = true;
      first.seconds = clock.seconds();
    }
    return judged;
  };
  const auto stop = [&] {
    return first.found || first.cases >= limits.cases || clock.seconds() >= limits.seconds;
  };
  for (int lane = 1; !stop(); ++lane)
    search({fmt::format("race:{}:{}", seed, lane), 500}, space, judge, stop);
  if (!first.found) first.seconds = clock.seconds();
  return first;
}

// The distinct signatures of defects that are met in so many seconds of processor time.
struct Signatures {
  std::set<std::string> met;
  void take(const SearchedCase& judged) {
    if (const auto& failure = judged.trials[0].failure) met.insert(failure->signature());
  }
};

inline std::set<std::string> signatures_at_random(const Runner& runner, double seconds) {
  Signatures signatures;
  const ProcessorClock clock;
  const auto known = families();
  for (std::uint64_t i = 0; clock.seconds() < seconds; ++i) {
    const auto& family = known[i % known.size()];
    const auto c = case_within(runner.detector.contract, family,
                               fmt::format("causes:{}:{}", family.name, i / known.size()));
    if (c.seen) signatures.take(judged_by(runner, *c.seen));
  }
  return signatures.met;
}

inline std::set<std::string> signatures_by_search(const Runner& runner, double seconds) {
  Signatures signatures;
  const SearchSpace space = racing_space(runner);
  const ProcessorClock clock;
  const JudgeCases judge = [&](std::span<const corpus::Case> cases) {
    std::vector<SearchedCase> judged;
    for (const auto& c : cases) {
      judged.push_back(judged_by(runner, c));
      signatures.take(judged.back());
    }
    return judged;
  };
  const auto stop = [&] { return clock.seconds() >= seconds; };
  for (int lane = 1; !stop(); ++lane)
    search({fmt::format("causes:{}", lane), 500}, space, judge, stop);
  return signatures.met;
}

}  // namespace assay::properties::test
