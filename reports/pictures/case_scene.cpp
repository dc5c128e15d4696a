#include "reports/pictures/case_scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include "detector/mesh/mesh_checks.h"
#include "properties/judging/case_check.h"
#include "properties/judging/exam.h"
#include "properties/worker/plugin/query_case.h"
#include "reports/terminal/option_words.h"
#include "reports/terminal/work.h"

namespace assay::reports {

namespace {

using Vector = Eigen::Vector3d;
using Corners = std::array<std::int32_t, 3>;

// The point where the line e0 e1 crosses the plane of f, within the edge. If it is parallel to the
// plane, the middle of the edge.
Vector on_plane(const Vector& e0, const Vector& e1, const std::array<Vector, 3>& f) {
  const Vector normal = (f[1] - f[0]).cross(f[2] - f[0]);
  const double h0 = normal.dot(e0 - f[0]), h1 = normal.dot(e1 - f[0]);
  const double part = h0 == h1 ? 0.5 : std::clamp(h0 / (h0 - h1), 0.0, 1.0);
  return e0 + part * (e1 - e0);
}

// The points where two triangles come closest, by features that share no vertex. Nothing if all of
// their features share one.
template <class Place>
std::optional<NearestPoints> where_closest(const Corners& a, const Corners& b, const Place& place) {
  std::optional<NearestPoints> best;
  const auto offer = [&](const NearestPoints& points) {
    if (!best || points.distance() < best->distance()) best = points;
  };
  const auto has = [](const Corners& corners, std::int32_t v) {
    return std::find(corners.begin(), corners.end(), v) != corners.end();
  };
  for (const auto& [vertices, face] : {std::pair(a, b), std::pair(b, a)}) {
    const std::array<Vector, 3> corners = {place(face[0]), place(face[1]), place(face[2])};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto from = vertices[i], to = vertices[(i + 1) % 3];
      if (has(face, from)) continue;
      offer(nearest_of_triangle(place(from), corners));
      // An edge that pierces the face.
      if (!has(face, to))
        offer(nearest_of_triangle(on_plane(place(from), place(to), corners), corners));
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Corners first = {a[i], a[(i + 1) % 3], -1}, second = {b[j], b[(j + 1) % 3], -2};
      if (has(first, second[0]) || has(first, second[1])) continue;
      offer(nearest_of_segments(place(first[0]), place(first[1]), place(second[0]),
                                place(second[1])));
    }
  }
  return best;
}

// part / whole, clamped to [0,1]. It is 0 if the whole has no length.
double share(double part, double whole) {
  return whole > 0 ? std::clamp(part / whole, 0.0, 1.0) : 0.0;
}

// The largest coordinate, as a power of two. If numbers are divided by it, no product of four of
// them overflows.
double size_of(std::initializer_list<Vector> points) {
  double largest = 0;
  for (const auto& point : points) largest = std::max(largest, point.cwiseAbs().maxCoeff());
  return largest > 0 ? std::ldexp(1.0, std::ilogb(largest)) : 1;
}

NearestPoints scaled(const NearestPoints& nearest, double size) {
  return {size * nearest.a, size * nearest.b};
}

// The parameters are clamped one after the other, as in Ericson, Real-Time Collision Detection,
// 5.1.9.
NearestPoints of_segments(const Vector& a0, const Vector& a1, const Vector& b0, const Vector& b1) {
  const Vector a = a1 - a0, b = b1 - b0, gap = a0 - b0;
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b);
  const double ag = a.dot(gap), bg = b.dot(gap);
  double s = share(ab * bg - ag * bb, aa * bb - ab * ab);
  const double u = share(ab * s + bg, bb);
  s = share(ab * u - ag, aa);
  return {a0 + s * a, b0 + u * b};
}

NearestPoints of_triangle(const Vector& point, const std::array<Vector, 3>& corners) {
  const Vector normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const double area = normal.squaredNorm();
  bool inside = area > 0;
  NearestPoints best;
  double least = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector& from = corners[i];
    const Vector& to = corners[(i + 1) % 3];
    inside = inside && normal.dot((to - from).cross(point - from)) >= 0;
    const NearestPoints on_edge = of_segments(point, point, from, to);
    if (i == 0 || on_edge.distance() < least) {
      best = on_edge;
      least = on_edge.distance();
    }
  }
  if (inside) best = {point, point - normal * (normal.dot(point - corners[0]) / area)};
  return best;
}

template <class List>
bool has_pair(const List& list, const detector::TrianglePair& pair) {
  return std::any_of(list.begin(), list.end(), [&](const auto& one) { return one.pair == pair; });
}

std::string end_text(const properties::CaseRun& run) {
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

std::optional<NearestPoints> contact_places(const detector::PairContact& contact,
                                            const detector::TrianglesView& triangles,
                                            const detector::PositionsView& x_t0,
                                            const detector::PositionsView& x_t1, double t) {
  const auto place = [&](std::int32_t vertex) -> Vector {
    return (1 - t) * x_t0.row(vertex).transpose() + t * x_t1.row(vertex).transpose();
  };
  const auto corners = [&](std::int32_t triangle) -> Corners {
    const auto row = triangles.row(triangle);
    return {row[0], row[1], row[2]};
  };
  const auto one = [](const Vector& at) { return NearestPoints{at, at}; };
  const auto& v = contact.feature.vertices;
  std::optional<NearestPoints> places;
  if (contact.feature.kind == detector::FeatureKind::same_vertices) {
    const auto f = corners(contact.pair.a);
    places = one((place(f[0]) + place(f[1]) + place(f[2])) / 3);
  } else if (v[0] < 0) {
    places = where_closest(corners(contact.pair.a), corners(contact.pair.b), place);
  } else if (contact.feature.kind == detector::FeatureKind::vertex_face) {
    places = nearest_of_triangle(place(v[0]), {place(v[1]), place(v[2]), place(v[3])});
  } else if (contact.feature.kind == detector::FeatureKind::edge_edge) {
    places = nearest_of_segments(place(v[0]), place(v[1]), place(v[2]), place(v[3]));
  } else {
    places = one(on_plane(place(v[0]), place(v[1]), {place(v[2]), place(v[3]), place(v[4])}));
  }
  return places && std::isfinite(places->distance()) ? places : std::nullopt;
}

NearestPoints nearest_of_segments(const Vector& a0, const Vector& a1, const Vector& b0,
                                  const Vector& b1) {
  const double size = size_of({a0, a1, b0, b1});
  return scaled(of_segments(a0 / size, a1 / size, b0 / size, b1 / size), size);
}

NearestPoints nearest_of_triangle(const Vector& point, const std::array<Vector, 3>& corners) {
  const double size = size_of({point, corners[0], corners[1], corners[2]});
  return scaled(
      of_triangle(point / size, {corners[0] / size, corners[1] / size, corners[2] / size}), size);
}

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
    // Of the features that are within d at t = 0 any may be named, not the nearest.
    feature = {};
  }
  auto nearest = contact_places(contact, c.triangles, start_of(c, step.span), end_of(c, step.span),
                                middle(contact.time));
  // Of triangles that pierce each other only rounding is left.
  if (nearest && nearest->distance() < 1e-9 * contract.separation) nearest->b = nearest->a;
  return nearest;
}

std::string SceneStep::difference(const detector::TrianglePair& pair,
                                  const CaseScene& scene) const {
  const auto* exact = contact_of(truth.pairs, pair);
  if (!exact && contact_of(truth.left_out, pair)) return "left out by the contract";
  if (!diff || !answered) return "not run";
  if (has_pair(diff->missing_candidates, pair)) return "no candidate";
  using properties::Claim;
  const auto& claims = scene.claims;
  const auto* reported = contact_of(answered->pairs, pair);
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
  auto seen = properties::contracted(c, detector.contract);
  if (!seen) return std::nullopt;
  CaseScene scene;
  const properties::Exam exam{detector, {&configuration, 1}, worker};
  properties::Examined examined;
  examined.c = std::move(*seen);
  examined.runs = {{RunEnd::not_run, "the detector is not at hand", {}}};
  if (worker) run_first(exam, examined);
  judge(exam, examined);
  scene.c = std::move(examined.c);
  auto& truth = examined.truth;
  auto& judged = examined.verdicts[0];
  const auto& run = examined.runs[0];
  scene.failure = judged.failure;
  scene.contract = detector.contract;
  if (run.end != RunEnd::completed) scene.ended = end_text(run);
  scene.reports_pairs =
      run.has_answers && detector.contract.reports_pairs() && !properties::says_query(scene.c);
  scene.claims = properties::judged_claims(detector.claims_in(configuration), detector.contract);
  if (scene.failure && scene.failure->claim == properties::Claim::commit_free)
    show_way(scene, run.limits[scene.failure->step]->positions, truth);
  const auto script = corpus::steps_of(scene.c);
  for (std::size_t s = 0; s < script.size(); ++s) {
    SceneStep step{script[s], truth_of(scene.c, truth[s], detector.contract), {}, {}};
    if (s < run.steps.size()) step.answered = run.steps[s];
    if (s < run.candidates.size()) step.candidates = run.candidates[s];
    if (s < judged.steps.size()) step.diff = std::move(judged.steps[s]);
    // Of the way that is allowed the detector answers nothing.
    if (scene.failure && scene.failure->claim == properties::Claim::commit_free &&
        scene.failure->step == s) {
      step.answered.reset();
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
  properties::Configuration chosen{configuration, {}};
  if (const auto options = properties::read_options(c); detector_.built_in && options)
    chosen.options = options.value();
  auto scene = make_scene(c, detector_.in(chosen), chosen, worker_ ? &*worker_ : nullptr);
  if (scene && !absent_.empty()) scene->ended = absent_;
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
