#include "reports/pictures/case_scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "detector/contact_place.h"
#include "detector/mesh/mesh_checks.h"
#include "properties/judging/case_options.h"
#include "properties/judging/exam.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::reports {

namespace {

using Vector = Eigen::Vector3d;
// Returns the points of both triangles between which the place of a contact lies.
NearestPoints points_of(const detector::PairContact& contact,
                        const detector::TrianglesView& triangles,
                        const detector::SteppedMesh& motion) {
  const auto place = detector::contact_place(motion, triangles, contact);
  const double t = contact.time.lo;
  const auto on = [&](std::size_t side) {
    Vector sum = Vector::Zero();
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto v =
          triangles(side == 0 ? contact.pair.a : contact.pair.b, static_cast<Eigen::Index>(corner));
      sum += place.barycentric[side][corner] *
             ((1 - t) * motion.vertices_t0.row(v) + t * motion.vertices_t1.row(v)).transpose();
    }
    return sum;
  };
  return {on(0), on(1)};
}

// Returns the features of the two triangles that share no vertex: an edge and a face only meet
// where the edge pierces the face.
std::vector<detector::Feature> features_of(const std::array<std::int32_t, 3>& a,
                                           const std::array<std::int32_t, 3>& b) {
  using detector::FeatureKind;
  const auto has = [](const auto& corners, std::int32_t v) {
    return std::find(corners.begin(), corners.end(), v) != corners.end();
  };
  std::vector<detector::Feature> features;
  for (std::size_t i = 0; i < 3; ++i) {
    for (const auto& [of, f] : {std::pair(a, b), std::pair(b, a)}) {
      const auto from = of[i], to = of[(i + 1) % 3];
      if (has(f, from)) continue;
      features.push_back({FeatureKind::vertex_face, {from, f[0], f[1], f[2], -1}});
      if (!has(f, to)) features.push_back({FeatureKind::piercing, {from, to, f[0], f[1], f[2]}});
    }
    for (std::size_t j = 0; j < 3; ++j) {
      const std::array<std::int32_t, 2> e = {a[i], a[(i + 1) % 3]}, g = {b[j], b[(j + 1) % 3]};
      if (!has(e, g[0]) && !has(e, g[1]))
        features.push_back({FeatureKind::edge_edge, {e[0], e[1], g[0], g[1], -1}});
    }
  }
  return features;
}

template <class List>
bool has_pair(const List& list, const detector::TrianglePair& pair) {
  return std::any_of(list.begin(), list.end(), [&](const auto& one) { return one.pair == pair; });
}

std::string ending(const properties::CaseRun& run) {
  return run.explanation.empty()
             ? properties::name_of(run.end)
             : std::string(properties::name_of(run.end)) + ": " + run.explanation;
}

// Lets the step that fails end where the limiter lets the caller stop: the contact is on that way.
void show_way(CaseScene& scene, const detector::Positions& stop,
              std::vector<oracle::StepJudgement>& truth) {
  auto& c = scene.c;
  const std::size_t s = scene.failure->step;
  c.script = corpus::steps_of(c);
  c.script[s].to = static_cast<std::int32_t>(c.frames.size());
  c.frames.push_back(stop);
  c.view.reset();
  const auto alone = properties::with_steps(c, {s}, scene.contract);
  truth[s] = properties::judge_case(alone, scene.contract).front();
}

}  // namespace

std::optional<NearestPoints> contact_places(detector::PairContact contact,
                                            const detector::TrianglesView& triangles,
                                            const detector::SteppedMesh& motion, double t) {
  const auto corners = [&](std::int32_t triangle) {
    const auto row = triangles.row(triangle);
    return std::array{row[0], row[1], row[2]};
  };
  contact.time = {t, t};
  const bool is_named = contact.feature.vertices[0] >= 0,
             is_one = is_named && contact.feature.kind == detector::FeatureKind::piercing;
  auto features = std::vector{contact.feature};
  if (!is_named) features = features_of(corners(contact.pair.a), corners(contact.pair.b));
  std::optional<NearestPoints> best;
  for (const auto& feature : features) {
    contact.feature = feature;
    const auto points = points_of(contact, triangles, motion);
    if (!best || points.distance() < best->distance()) best = points;
  }
  if (best && is_one) best->b = best->a;
  return best && std::isfinite(best->distance()) ? best : std::nullopt;
}

using properties::RunEnd;

const detector::PairContact* contact_of(const std::vector<detector::PairContact>& contacts,
                                        const std::optional<detector::TrianglePair>& pair) {
  if (!pair) return nullptr;
  const auto place = std::find_if(contacts.begin(), contacts.end(),
                                  [&](const auto& contact) { return contact.pair == *pair; });
  return place == contacts.end() ? nullptr : &*place;
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

double middle(const detector::TimeEnclosure& time) { return time.lo + (time.hi - time.lo) / 2; }

std::string CaseScene::asked_distance() const {
  const auto &d = contract.separation, &slack = contract.margin;
  std::string text = d > 0 ? "d " + properties::number_text(d) : "";
  if (slack > 0) text += (d > 0 ? ", slack " : "slack ") + properties::number_text(slack);
  return text;
}

std::optional<NearestPoints> CaseScene::nearest_points(const SceneStep& step,
                                                       detector::PairContact contact) const {
  using detector::FeatureKind;
  auto& feature = contact.feature;
  if (const auto query = properties::query_of(c)) {
    feature = {query->first_group == 1 ? FeatureKind::vertex_face : FeatureKind::edge_edge,
               {0, 1, 2, 3, -1}};
  } else if (contract.separation > 0 && feature.kind != FeatureKind::piercing) {
    // If several features are within d at t = 0, the named one need not be the nearest.
    feature = {};
  }
  auto nearest = contact_places(
      contact, c.triangles, {start_of(c, step.span), end_of(c, step.span)}, middle(contact.time));
  // If triangles pierce each other, their distance is only rounding.
  if (nearest && nearest->distance() < 1e-9 * contract.separation) nearest->b = nearest->a;
  return nearest;
}

std::string SceneStep::difference(const detector::TrianglePair& pair,
                                  const CaseScene& scene) const {
  const auto* exact = contact_of(truth.pairs, pair);
  if (!exact && contact_of(truth.left_out, pair)) return "left out by the contract";
  if (!diff || !answer) return "not run";
  if (has_pair(diff->missing_candidates, pair)) return "no candidate";
  using properties::Claim;
  const auto& claims = scene.claims;
  const auto* reported = contact_of(answer->pairs, pair);
  if (!exact) return claims.has(Claim::no_spurious) ? "spurious" : "no contact, not claimed";
  if (!reported) {
    const bool are_claimed = claims.has_any({Claim::all_pairs, Claim::first_pairs});
    if (scene.reports_pairs && are_claimed && has_pair(diff->missing, pair)) return "missing";
    return diff->answered_free && claims.has(Claim::free_sound) ? "answered free" : "not claimed";
  }
  if (has_pair(diff->early, pair))
    return claims.has(Claim::no_spurious) ? "early" : "earlier, not claimed";
  const bool is_late =
      has_pair(diff->late, pair) ||
      properties::time_off(reported->time, exact->time, scene.contract.time_tolerance).late > 0;
  if (!is_late) return "agrees";
  return claims.has(Claim::all_pairs) ? "late" : "later, not claimed";
}

std::optional<CaseScene> make_scene(const corpus::Case& c,
                                    const properties::DetectorUnderTest& detector,
                                    const properties::Configuration& configuration,
                                    properties::WorkerProcess* worker) {
  auto contracted_case = properties::contract_case(c, detector.contract);
  if (!contracted_case) return std::nullopt;
  CaseScene scene;
  const properties::Exam exam{detector, {&configuration, 1}, worker};
  properties::CaseResults results;
  results.c = std::move(*contracted_case);
  results.runs = {{RunEnd::not_run, "the detector is not available", {}}};
  if (worker) run_first(exam, results);
  judge(exam, results);
  scene.c = std::move(results.c);
  auto& truth = results.truth;
  auto& verdict = results.verdicts[0];
  const auto& run = results.runs[0];
  scene.failure = verdict.failure;
  scene.contract = detector.contract;
  if (run.end != RunEnd::completed) scene.ending = ending(run);
  scene.reports_pairs =
      run.has_answers && detector.contract.reports_pairs() && !properties::says_query(scene.c);
  scene.claims = properties::judged_claims(detector.claims_in(configuration), detector.contract);
  if (scene.failure && scene.failure->claim == properties::Claim::commit_free)
    show_way(scene, run.limits[scene.failure->step]->positions, truth);
  const auto script = corpus::steps_of(scene.c);
  for (std::size_t s = 0; s < script.size(); ++s) {
    SceneStep step{script[s], truth_of(scene.c, truth[s], detector.contract), {}, {}};
    if (s < run.steps.size()) step.answer = run.steps[s];
    if (s < run.candidates.size()) step.candidates = run.candidates[s];
    if (s < verdict.steps.size()) step.diff = std::move(verdict.steps[s]);
    // The detector gives no answer about the allowed way.
    if (scene.failure && scene.failure->claim == properties::Claim::commit_free &&
        scene.failure->step == s) {
      step.answer.reset();
      step.diff.reset();
    }
    scene.steps.push_back(std::move(step));
  }
  if (!detector::check_triangles(scene.c.triangles, scene.c.frames[0].rows())) {
    scene.surface = detector::make_surface(scene.c.triangles, scene.c.frames[0].rows());
  }
  return scene;
}

SceneMaker::SceneMaker(const std::optional<DetectorWords>& detector)
    : detector_(properties::built_in_detector()) {
  if (!detector) {
    absent_ = "the store does not name the plug-in's library";
    return;
  }
  auto subject = choose_detector(*detector);
  if (!subject) {
    absent_ = subject.error().message;
    return;
  }
  detector_ = subject.value().detector;
  worker_.emplace(subject.value().process());
}

std::optional<CaseScene> SceneMaker::scene_of(const corpus::Case& c,
                                              const std::string& configuration) {
  properties::Configuration choice{configuration, {}};
  if (const auto options = properties::read_options(c); detector_.built_in && options)
    choice.options = options.value();
  auto scene = make_scene(c, detector_.in(choice), choice, worker_ ? &*worker_ : nullptr);
  if (scene && !absent_.empty()) scene->ending = absent_;
  return scene;
}

Expected<void> SceneMaker::write_picture(const std::string& case_file, const corpus::Case& c,
                                         const std::string& configuration,
                                         const std::string& title) {
  if (c.triangles.rows() > most_shown_triangles) return outcome::success();
  const auto scene = scene_of(c, configuration);
  if (!scene) return outcome::success();
  return write_text_file(picture_file(case_file), mesh_svg(*scene, title));
}

std::string picture_file(const std::string& case_file) {
  constexpr std::string_view json = ".json";
  const bool is_json = case_file.ends_with(json);
  return case_file.substr(0, case_file.size() - (is_json ? json.size() : 0)) + ".svg";
}

}  // namespace assay::reports
