#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "detector/detector.h"
#include "properties/campaign/ledger/database.h"
#include "properties/campaign/phases/phases.h"
#include "properties/campaign/trials/trials.h"
#include "properties/worker/child_process.h"

namespace assay::properties {

namespace {

// Returns whether the mesh is worth several threads of the oracle, and its failure more time.
bool is_large(const Case& c) {
  constexpr Eigen::Index from = 1000;
  return c.triangles.rows() > from;
}

// Returns the case with the view that the detector chose; it runs here and may crash.
std::optional<Case> chosen_view(const Case& c, const Options& options) {
  // A component within which nothing counts needs no view, so all pairs count here.
  auto creation = detector::Detector::create(c.triangles, c.frames[0], options);
  if (!creation) return std::nullopt;
  Case out = c;
  out.view.emplace();
  bool is_line = options.culling == Culling::view_line;
  // A primitive depends on the positions of one frame alone, so a step that stays in that frame
  // shows it.
  for (const auto& frame : c.frames) {
    const auto result = creation.value().evaluate(frame, frame);
    if (result.primitives.empty()) return std::nullopt;
    is_line |= out.view->q0.empty() && !result.primitives[0].is_point();  // the choice of view-auto
    out.view->q0.push_back(result.primitives[0].q0.t0);
    if (is_line) out.view->q1.push_back(result.primitives[0].q1.t0);
  }
  return out;
}

// Returns the case with the primitive of its first component stated, as the detector chooses it.
// Nothing if the culling has no views, if the case states a primitive already, or if the mesh is
// refused.
std::optional<Case> with_explicit_view(const Case& c, const Options& options) {
  if (c.view || !uses_views(options.culling)) return std::nullopt;
  const auto run = in_a_copy([&](const Say& say) {
    if (const auto view = chosen_view(c, options)) say(case_text(*view));
  });
  auto parsed_case = corpus::parse_case(run.output, c.id);
  if (!parsed_case) return std::nullopt;  // no view was chosen, or the copy crashed
  return std::move(parsed_case.value());
}

}  // namespace

Judge judge_of_detector(const DetectorUnderTest& detector, const Configuration& configuration,
                        WorkerProcess& worker, int jobs) {
  return [&, jobs](const Case& c) -> std::optional<Finding> {
    const auto input = contract_case(c, detector.contract);
    if (!input) return std::nullopt;
    // If the case does not start clean although its caller vouches for that, the failure is no
    // fault of the detector.
    const bool vouched = configuration.options.start == detector::Start::clean;
    if (detector.built_in && vouched && !starts_clean(c)) return std::nullopt;
    const auto results =
        examine({detector, {&configuration, 1}, &worker, nullptr, is_large(c) ? jobs : 1}, *input);
    throw_if_not_run(results);
    const auto& failure = results.verdicts[0].failure;
    return failure ? std::optional(finding_of(*failure)) : std::nullopt;
  };
}

Reduction shrink_case(const Case& failing, const DetectorUnderTest& detector,
                      const Configuration& configuration, WorkerProcess& worker,
                      const ReduceLimits& limits, const OnBetter& on_better, int jobs) {
  MakeViewExplicit make_explicit;
  if (detector.built_in) {
    make_explicit = [&](const Case& c) { return with_explicit_view(c, configuration.options); };
  }
  return reduce(failing, judge_of_detector(detector, configuration, worker, jobs), limits,
                on_better, make_explicit);
}

namespace {

// A large mesh takes the oracle half a second a step, and may not become small at all, if a
// detector is wrong on large meshes alone.
constexpr double most_seconds_of_a_large_mesh = 20;

// Returns the key of the note that this failure has been shrunk for all of its time.
std::string done_note(const FailureRecord& failure) {
  return fmt::format("shrunk {} {}", failure.id(), failure.shown_configuration());
}

// Returns the configurations as they were given to this case: if it vouches for a clean start, so
// do they.
std::vector<Configuration> configurations_of(const Case& failing,
                                             const DetectorUnderTest& detector) {
  const auto start = failing.options.find("start");
  const bool vouched =
      detector.built_in && start != failing.options.end() && start->second == "clean";
  auto all = detector.configurations;
  all.insert(all.end(), detector.of_questions.begin(), detector.of_questions.end());
  return vouched ? with_clean_start(std::move(all)) : all;
}

// Returns the explanation of a shrunk case, which names its own triangles and times. The signature
// stays that of the failure, although a case that was cut from a large mesh may have another cause.
std::string explanation_of(const Finding& finding, std::size_t fails_from = 0) {
  return finding.explanation + (fails_from == 0 ? "" : "; " + fails_from_text(fails_from));
}

// Returns how long a failure may be shrunk. The time grows with the triangles of the mesh, from
// 10,000 on.
double seconds_for(const FailureRecord& failure, const Case& failing, double usual) {
  if (failure.source == Source::repeated) return std::min(usual, most_seconds_of_a_large_mesh);
  constexpr double most_times = 10;
  return usual * std::clamp(static_cast<double>(failing.triangles.rows()) / 10'000, 1., most_times);
}

// Returns whether one run of the case alone has to show the failure: not if a law is broken, or if
// two runs have to agree.
bool may_be_asked_alone(const FailureRecord& failure, const CampaignRequest& request) {
  return request.plugin && failure.claim != name_of(Claim::deterministic);
}

}  // namespace

void shrink_failures(const CampaignRequest& request, Store& store, const ReduceLimits& limits,
                     RunDeadline deadline, const OnText& progress) {
  auto failures = store.failures();
  // Failures that were shrunk in part come before the others of their signature.
  std::stable_partition(failures.begin(), failures.end(),
                        [](const FailureRecord& f) { return !f.smallest.empty(); });
  constexpr int most_tried = 3;
  std::map<std::string, int> tries;  // of each signature
  for (auto& failure : failures) {
    const std::chrono::duration<double> rest = deadline - std::chrono::steady_clock::now();
    if (rest.count() <= 0) return;
    auto& tried_of_kind = tries[failure.signature()];
    if (store.note(done_note(failure))) tried_of_kind = most_tried;
    if (failure.flaky || tried_of_kind >= most_tried) continue;
    const auto& begin = failure.smallest.empty() ? failure.mesh : failure.smallest;
    const auto failing = corpus::parse_case(begin, failure.id());
    if (!failing) continue;
    const auto configurations = configurations_of(failing.value(), request.detector);
    const auto configuration =
        std::ranges::find(configurations, failure.configuration, &Configuration::name);
    if (configuration == configurations.end()) continue;
    const auto detector = request.detector.in(*configuration);
    if (progress) progress(failure.signature());
    // New processes, because one with many earlier cases may fail where a new one does not.
    WorkerProcess worker(request.worker, request.plugin, request.worker_limits()),
        last(request.worker, request.plugin, request.worker_limits());
    const auto shows = [&](const std::string& mesh, WorkerProcess& process) {
      const auto judge = judge_of_detector(request.detector, *configuration, process, request.jobs);
      return judge(corpus::parse_case(mesh, failure.id()).value()).has_value();
    };
    const bool is_asked_alone = may_be_asked_alone(failure, request);
    if (is_asked_alone && !shows(failure.mesh, worker)) {
      failure.flaky = true;
      store.set_smallest(failure);
      ++tried_of_kind;
      continue;
    }
    tried_of_kind = most_tried;
    const double most = seconds_for(failure, failing.value(), limits.seconds);
    const ReduceLimits bounded{std::min(most, rest.count()), limits.calls};
    const Law* law = failure.claim.empty() ? law_named(failure.law) : nullptr;
    const auto store_as_smallest = [&](const Case& better, const std::string& explanation) {
      // The case as the detector saw it: a contract of float32 has rounded its coordinates.
      Case small_case = contract_case(better, detector.contract).value_or(better);
      if (!explanation.empty()) {
        failure.smallest_explanation = explanation;
        small_case.about = about_text(failure.signature(), explanation);
      }
      failure.smallest = case_text(small_case);
      store.set_smallest(failure);
    };
    const OnBetter keep = [&](const Case& better) {
      // A large mesh is asked only at the end, because each question takes long.
      const auto finding = law || is_large(better)
                               ? std::nullopt
                               : judge_of_detector(detector, *configuration, worker)(better);
      store_as_smallest(better, finding ? explanation_of(*finding) : "");
    };
    const Reduction reduction =
        law ? reduce(failing.value(), judge_of_law(*law, *configuration), bounded, keep)
            : shrink_case(failing.value(), detector, *configuration, worker, bounded, keep,
                          request.jobs);
    if (is_large(reduction.smallest) && !law && !reduction.finding.signature.empty())
      store_as_smallest(reduction.smallest,
                        explanation_of(reduction.finding, reduction.fails_from));
    if (is_asked_alone && !failure.smallest.empty() && !shows(failure.smallest, last))
      failure.smallest = failure.smallest_explanation = "";
    if (failure.smallest.empty()) {
      // Nothing smaller was found, so the mesh itself is the smallest.
      failure.smallest = failure.mesh;
      store.set_smallest(failure);
    }
    const bool had_its_time = bounded.seconds >= most;
    const bool shows_no_more = reduction.finding.signature.empty();
    if (reduction.fixed_point || had_its_time || shows_no_more)
      store.set_note(done_note(failure), "done");
  }
}

Finding finding_of(const Failure& failure) {
  Finding finding;
  finding.signature = failure.signature();
  finding.step = failure.step;
  finding.explanation = failure.explanation;
  if (failure.pair) finding.focus = {failure.pair->a, failure.pair->b};
  return finding;
}

}  // namespace assay::properties
