#include "reports/pictures/case_scene.h"

#include <algorithm>

#include "detector/mesh/mesh_checks.h"
#include "properties/judging/judged_run.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::reports {

using properties::RunEnd;

const detector::PairContact* contact_of(const std::vector<detector::PairContact>& contacts,
                                        const std::optional<detector::TrianglePair>& pair) {
  if (!pair) return nullptr;
  const auto found = std::find_if(contacts.begin(), contacts.end(),
                                  [&](const auto& contact) { return contact.pair == *pair; });
  return found == contacts.end() ? nullptr : &*found;
}

std::size_t CaseScene::shown_step() const {
  if (failure) return std::min(failure->step, steps.empty() ? 0 : steps.size() - 1);
  for (std::size_t s = 0; s < steps.size(); ++s) {
    if (!steps[s].truth.pairs.empty()) return s;
  }
  return 0;
}

std::optional<detector::TrianglePair> CaseScene::shown_pair() const {
  if (failure && failure->pair) return failure->pair;
  if (steps.empty()) return std::nullopt;
  const auto& pairs = steps[shown_step()].truth.pairs;
  const auto first = std::min_element(pairs.begin(), pairs.end(),
                                      [](const auto& a, const auto& b) { return a.time < b.time; });
  return first == pairs.end() ? std::nullopt : std::optional(first->pair);
}

namespace {

bool has_views(const properties::CaseRun& run) {
  return run.end == RunEnd::completed &&
         std::any_of(run.steps.begin(), run.steps.end(),
                     [](const auto& step) { return !step.doubts.empty(); });
}

std::string end_text(const properties::CaseRun& run) {
  return run.explanation.empty()
             ? properties::name_of(run.end)
             : std::string(properties::name_of(run.end)) + ": " + run.explanation;
}

}  // namespace

std::optional<CaseScene> make_scene(const corpus::Case& c,
                                    const properties::DetectorUnderTest& detector,
                                    const properties::Configuration& configuration,
                                    const SceneWorkers& workers) {
  auto seen = properties::contracted(c, detector.contract);
  if (!seen) return std::nullopt;
  CaseScene scene;
  scene.c = std::move(*seen);
  const auto truth = properties::judge_case(scene.c, detector.contract);
  properties::CaseRun run{RunEnd::not_run, "the detector is not at hand", {}};
  if (workers.detector) run = workers.detector->run(scene.c, {&configuration, 1}).front();
  if (run.end != RunEnd::not_run) {
    scene.failure = properties::judge_trial(scene.c, truth, run, configuration, detector).failure;
  }
  if (run.end != RunEnd::completed) scene.ended = end_text(run);
  scene.reports_pairs =
      run.has_answers && detector.contract.reports_pairs && !properties::says_query(scene.c);
  properties::CaseRun views = run;
  if (!has_views(run)) {
    const properties::Configuration with_views{"view-point", {detector::Culling::view_point}};
    views = workers.reference->run(scene.c, {&with_views, 1}).front();
    scene.views_by = "the built-in detector, culling view-point";
  }
  const auto script = corpus::steps_of(scene.c);
  for (std::size_t s = 0; s < script.size(); ++s) {
    SceneStep step{script[s], truth[s], {}, {}};
    if (s < run.steps.size()) step.answered = run.steps[s];
    if (s < run.candidates.size()) step.candidates = run.candidates[s];
    if (s < views.steps.size() && !views.steps[s].doubts.empty()) step.seen = views.steps[s];
    scene.steps.push_back(std::move(step));
  }
  if (!detector::check_triangles(scene.c.triangles, scene.c.frames[0].rows())) {
    scene.surface = detector::make_surface(scene.c.triangles, scene.c.frames[0].rows());
  }
  return scene;
}

}  // namespace assay::reports
