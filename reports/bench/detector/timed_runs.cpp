#include "reports/bench/detector/timed_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace assay::reports {

double TimedRuns::run_once(properties::WorkerProcess& worker, const corpus::Case& c,
                           const properties::Configuration& configuration) {
  constexpr double ms_a_second = 1e3;
  if (!ended.empty()) return 0;
  if (is_once) {
    create_ms.push_back(create_ms.front());
    ms_a_step.push_back(ms_a_step.front());
    return ms_a_step.front();
  }
  auto run = std::move(worker.run(c, {&configuration, 1}).front());
  if (run.end != properties::RunEnd::completed || !run.times) {
    ended = fmt::format("{}: {}", name_of(run.end), run.explanation);
    if (!first) first = std::move(run);
    return 0;
  }
  const auto& steps = run.times->steps;
  const double all = std::accumulate(steps.begin(), steps.end(), 0.);
  const double ms = ms_a_second * all / static_cast<double>(steps.size());
  const bool is_first = !first;
  if (is_first) {
    is_once = std::any_of(steps.begin(), steps.end(),
                          [this](double seconds) { return seconds > longest_repeated; });
  } else {
    has_differing_runs |= !same_answers(run, *first);
  }
  if (!is_first || is_once) {
    create_ms.push_back(ms_a_second * run.times->create);
    ms_a_step.push_back(ms);
  }
  if (is_first) first = std::move(run);
  return ms;
}

}  // namespace assay::reports
