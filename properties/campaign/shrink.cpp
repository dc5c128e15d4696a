#include "properties/campaign/shrink.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "properties/campaign/case_tally.h"

namespace assay::properties {

Judge judge_of_detector(const DetectorUnderTest& detector, const Configuration& configuration,
                        WorkerProcess& worker) {
  return [&](const corpus::Case& c) -> std::optional<Finding> {
    const auto seen = contracted(c, detector.contract);
    if (!seen) return std::nullopt;
    const auto run = worker.run(c, {&configuration, 1});
    const auto verdict = judge_trial(*seen, judge_case(*seen), run[0], configuration, detector);
    if (!verdict.failure) return std::nullopt;
    return finding_of(*verdict.failure);
  };
}

Reduction shrink_case(const corpus::Case& failing, const DetectorUnderTest& detector,
                      const Configuration& configuration, WorkerProcess& worker,
                      const ReduceLimits& limits, const OnBetter& on_better) {
  MakeViewExplicit make_explicit;
  if (detector.built_in) {
    make_explicit = [&](const corpus::Case& c) {
      return with_explicit_view(c, configuration.options);
    };
  }
  return reduce(failing, judge_of_detector(detector, configuration, worker), limits, on_better,
                make_explicit);
}

void shrink_failures(const CampaignRequest& request, Store& store, const ReduceLimits& limits,
                     RunDeadline deadline,
                     const std::function<void(const std::string&)>& progress) {
  const auto failures = store.failures();
  std::set<std::string> done;
  for (const auto& failure : failures) {
    if (!failure.smallest.empty()) done.insert(failure.signature);
  }
  WorkerProcess worker(request.worker, request.plugin, {request.plan.case_seconds, 0});
  for (auto failure : failures) {
    const std::chrono::duration<double> left = deadline - std::chrono::steady_clock::now();
    if (left.count() <= 0) return;
    if (failure.flaky || !done.insert(failure.signature).second) continue;
    const auto configuration =
        std::find_if(request.detector.configurations.begin(), request.detector.configurations.end(),
                     [&](const Configuration& c) { return c.name == failure.configuration; });
    const auto failing = corpus::parse_case(failure.mesh, failure.id);
    if (configuration == request.detector.configurations.end() || !failing) continue;
    if (progress) progress(failure.signature);
    const ReduceLimits bounded{std::min(limits.seconds, left.count()), limits.calls};
    const OnBetter keep = [&](const corpus::Case& better) {
      failure.smallest = corpus::case_text(better);
      store.set_smallest(failure);
    };
    const std::string prefix = "law ";
    const Law* law = failure.signature.starts_with(prefix)
                         ? law_named(failure.signature.substr(prefix.size()))
                         : nullptr;
    if (law) {
      reduce(failing.value(), judge_of_law(*law, *configuration), bounded, keep);
    } else {
      shrink_case(failing.value(), request.detector, *configuration, worker, bounded, keep);
    }
    if (failure.smallest.empty()) {
      // Nothing smaller was found: the mesh itself.
      failure.smallest = failure.mesh;
      store.set_smallest(failure);
    }
  }
}

}  // namespace assay::properties
