#include "properties/campaign/phases/shrink.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "properties/campaign/database/store_problem.h"
#include "properties/campaign/trials/case_tally.h"
#include "properties/campaign/trials/clean_starts.h"

namespace assay::properties {

Judge judge_of_detector(const DetectorUnderTest& detector, const Configuration& configuration,
                        WorkerProcess& worker) {
  return [&](const corpus::Case& c) -> std::optional<Finding> {
    const auto seen = contracted(c, detector.contract);
    if (!seen) return std::nullopt;
    // If the case does not start clean although its caller vouches for that, the failure is no
    // fault of the detector.
    const bool vouched = configuration.options.start == detector::Start::clean;
    if (detector.built_in && vouched && !starts_clean(c)) return std::nullopt;
    const auto run = worker.run(*seen, {&configuration, 1});
    if (run[0].end == RunEnd::not_run) throw StoreProblem(run[0].explanation);
    const auto verdict =
        judge_trial(*seen, judge_case(*seen, detector.contract), run[0], configuration, detector);
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

namespace {

// A large mesh takes the oracle half a second a step, and may not become small at all, where a
// detector is wrong on large meshes alone.
constexpr double most_seconds_of_a_large_mesh = 20;

// The key of the note which says that the shrinking of this failure had all the time that it may
// have.
std::string done_note(const StoredFailure& failure) {
  return fmt::format("shrunk {} {}", failure.id, failure.configuration);
}

// The configuration without the name of the law that broke in it.
std::string configuration_name(const StoredFailure& failure) {
  return failure.configuration.substr(0, failure.configuration.find(law_in_configuration));
}

// The configurations as they were given to this case: if it vouches for a clean start, so do they.
std::vector<Configuration> configurations_of(const corpus::Case& failing,
                                             const DetectorUnderTest& detector) {
  const auto start = failing.options.find("start");
  const bool vouched =
      detector.built_in && start != failing.options.end() && start->second == "clean";
  return vouched ? with_clean_start(detector.configurations) : detector.configurations;
}

// Replaces the text `about` by that of the case itself, because the text names triangles and
// times, which the shrunk case has others of.
void tell_of_itself(corpus::Case& c, const Judge& judge) {
  if (const auto finding = judge(c)) c.about = about_text(finding->signature, finding->explanation);
}

// Puts failures that were shrunk in part before the others of their signature.
void order_for_shrinking(std::vector<StoredFailure>& failures) {
  std::stable_partition(failures.begin(), failures.end(),
                        [](const StoredFailure& f) { return !f.smallest.empty(); });
}

}  // namespace

void shrink_failures(const CampaignRequest& request, Store& store, const ReduceLimits& limits,
                     RunDeadline deadline,
                     const std::function<void(const std::string&)>& progress) {
  auto failures = store.failures();
  order_for_shrinking(failures);
  std::set<std::string> met;
  WorkerProcess worker(request.worker, request.plugin, request.worker_limits());
  for (auto& failure : failures) {
    const std::chrono::duration<double> left = deadline - std::chrono::steady_clock::now();
    if (left.count() <= 0) return;
    if (failure.flaky || !met.insert(failure.signature).second || store.note(done_note(failure)))
      continue;
    const auto& begin = failure.smallest.empty() ? failure.mesh : failure.smallest;
    const auto failing = corpus::parse_case(begin, failure.id);
    if (!failing) continue;
    const auto configurations = configurations_of(failing.value(), request.detector);
    const auto configuration =
        std::find_if(configurations.begin(), configurations.end(),
                     [&](const Configuration& c) { return c.name == configuration_name(failure); });
    if (configuration == configurations.end()) continue;
    if (progress) progress(failure.signature);
    const double most =
        failure.id.starts_with(repeated_in_id) ? most_seconds_of_a_large_mesh : limits.seconds;
    const ReduceLimits bounded{std::min({most, limits.seconds, left.count()}), limits.calls};
    const Law* law = failure.signature.starts_with(law_in_signature)
                         ? law_named(failure.signature.substr(law_in_signature.size()))
                         : nullptr;
    const OnBetter keep = [&](const corpus::Case& better) {
      // As the detector saw it: with coordinates that a contract of float32 has rounded.
      corpus::Case shown = contracted(better, request.detector.contract).value_or(better);
      if (!law) tell_of_itself(shown, judge_of_detector(request.detector, *configuration, worker));
      failure.smallest = corpus::case_text(shown);
      store.set_smallest(failure);
    };
    const Reduction reduction =
        law ? reduce(failing.value(), judge_of_law(*law, *configuration), bounded, keep)
            : shrink_case(failing.value(), request.detector, *configuration, worker, bounded, keep);
    if (failure.smallest.empty()) {
      // Nothing smaller was found, so the mesh itself is the smallest.
      failure.smallest = failure.mesh;
      store.set_smallest(failure);
    }
    const bool had_its_time = bounded.seconds >= std::min(most, limits.seconds);
    const bool shows_no_more = reduction.finding.signature.empty();
    if (reduction.fixed_point || had_its_time || shows_no_more)
      store.set_note(done_note(failure), "done");
  }
}

}  // namespace assay::properties
