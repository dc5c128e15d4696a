#include "oracle/distance/step_distance.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>

#include "oracle/mesh/feature_pairs.h"
#include "oracle/mesh/pair_relation.h"
#include "oracle/parallel_chunks.h"
#include "oracle/processor_state.h"
#include "oracle/query/contact.h"

namespace assay::oracle {

namespace {

using detector::Feature;
using detector::FeatureKind;
using detector::FourPoints;
using detector::PairContact;
using detector::SteppedMesh;
using detector::TimeEnclosure;
using detector::TrianglesView;
using Holders = std::span<const std::int32_t>;  // the triangles that hold a feature

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double greatest = std::numeric_limits<double>::max();

// Half of d or more. Halves of denormals, and sums, are rounded by one unit at most.
double half_of(const Separation& d) {
  const double half = d.first / 2 + d.second / 2;
  return d.first == 0 && d.second == 0 ? 0 : std::nextafter(half, infinity);
}

// The box over the step, grown: boxes of features within d meet if each is grown by half of d, or
// by its own offset. No box reaches beyond the greatest double, because no coordinate does.
BoxOfVertices grown_boxes(const SteppedMesh& motion, double half,
                          const std::vector<double>& offsets) {
  return [boxes = swept_boxes(motion), half, &offsets](std::span<const std::int32_t> vertices) {
    Box box = boxes(vertices);
    const double by = offsets.empty() ? half : offsets[detector::at(vertices[0])];
    if (by == 0) return box;
    for (int k = 0; k < 3; ++k) {
      box.min[k] = std::max(-greatest, std::nextafter(box.min[k] - by, -infinity));
      box.max[k] = std::min(greatest, std::nextafter(box.max[k] + by, infinity));
    }
    return box;
  };
}

// Two features of a mesh as a question, with their names and the triangles that hold them.
struct Candidate {
  FourPoints points;
  Feature feature;
  Holders of_first, of_second;
  std::size_t first = 0, second = 0;  // the numbers of the features among those of their kind
};

// The features of a mesh over a step, and the pairs of them that counted pairs of triangles hold.
class CountedFeatures {
 public:
  CountedFeatures(const SteppedMesh& motion, const TrianglesView& triangles,
                  const DistanceOptions& options)
      : motion_(motion), features_(mesh_features(triangles)), options_(options) {
    if (options.counted && !options.counted->count_all())
      counted_.emplace(*options.counted, features_);
    if (options.tested && !options.tested->count_all()) tested_.emplace(*options.tested, features_);
  }
  CountedFeatures(const CountedFeatures&) = delete;
  CountedFeatures& operator=(const CountedFeatures&) = delete;

  // Visits the pairs of features whose grown boxes meet, with the number of the calling thread.
  template <class Visit>
  void for_each(const BoxOfVertices& boxes, const Workers& workers, const Visit& visit) const {
    const FeatureIndex mesh(features_, boxes);
    for_each_vertex_face(mesh, mesh, workers, [&](std::size_t i, std::size_t j, int worker) {
      const std::int32_t v = features_.vertices[i];
      const auto face = static_cast<std::int32_t>(j);
      const Face& f = features_.faces[j];
      const Holders of_vertex = features_.triangles_of_vertex.of(i);
      if (!bodies_meet(v, f[0]) || !some_counts(of_vertex, {&face, 1})) return;
      visit(Candidate{{{path(v), path(f[0]), path(f[1]), path(f[2])}, 1},
                      {FeatureKind::vertex_face, {v, f[0], f[1], f[2], -1}},
                      of_vertex,
                      {&face, 1},
                      i,
                      j},
            worker);
    });
    for_each_edge_edge(mesh, mesh, workers, [&](std::size_t i, std::size_t j, int worker) {
      const Edge &a = features_.edges[i], &b = features_.edges[j];
      const Holders of_a = features_.triangles_of_edge.of(i);
      const Holders of_b = features_.triangles_of_edge.of(j);
      if (!bodies_meet(a[0], b[0]) || !some_counts(of_a, of_b)) return;
      visit(Candidate{{{path(a[0]), path(a[1]), path(b[0]), path(b[1])}, 2},
                      {FeatureKind::edge_edge, {a[0], a[1], b[0], b[1], -1}},
                      of_a,
                      of_b,
                      i,
                      j},
            worker);
    });
  }

  // Visits counted pairs that are in contact at t=0 without two features that meet: add(s, t,
  // feature, worker).
  template <class Add>
  void for_each_pierced_at_start(const Workers& workers, const Add& add) const {
    const FeatureIndex mesh(features_, swept_boxes(motion_.at_start()));
    for_each_edge_face(mesh, mesh, workers, [&](std::size_t i, std::size_t j, int worker) {
      const Edge& e = features_.edges[i];
      const Face& f = features_.faces[j];
      const auto face = static_cast<std::int32_t>(j);
      const Holders of_edge = features_.triangles_of_edge.of(i);
      if (!bodies_meet(e[0], f[0]) || !some_counts(of_edge, {&face, 1})) return;
      const auto at = [&](std::int32_t vertex) { return motion_.start(vertex); };
      if (!segment_pierces_triangle(at(e[0]), at(e[1]), {at(f[0]), at(f[1]), at(f[2])})) return;
      const Feature feature{FeatureKind::piercing, {e[0], e[1], f[0], f[1], f[2]}};
      for_each_holding(of_edge, {&face, 1}, [&](std::int32_t s, std::int32_t t) {
        if (!counted_ || counted_->counts_faces(s, t)) add(s, t, feature, worker);
      });
    });
    for (const auto& [s, t] : same_vertices_pairs(features_.faces)) {
      if (!counts(s, t) || (counted_ && !counted_->counts_faces(s, t))) continue;
      const Face& f = features_.faces[s];
      add(s, t, Feature{FeatureKind::same_vertices, {f[0], f[1], f[2], -1, -1}}, 0);
    }
  }

  // Relations take time, so they are asked only about features that are near. A relation of
  // features judges the two features. A relation of triangles judges the triangles that hold them:
  // once for each pair, at the end (judgement_of).
  bool counts(const Candidate& c) const { return passes(counted_, c); }
  bool is_tested(const Candidate& c) const {
    return asks(c.points.first_group == 1 ? AskedFeatures::vertex_face
                                          : AskedFeatures::edge_edge) &&
           passes(tested_, c);
  }
  // Piercing at the start belongs to no kind of features, so it counts only if all kinds do.
  bool is_piercing_tested(std::int32_t s, std::int32_t t) const {
    return asks_piercing() && tested_->counts_faces(s, t);
  }

  // Visits the pairs of triangles that hold two features. They count, unless a relation of
  // triangles leaves them out.
  template <class Visit>
  void for_each_holding(const Holders& of_first, const Holders& of_second,
                        const Visit& visit) const {
    for (const std::int32_t s : of_first) {
      for (const std::int32_t t : of_second) {
        if (counts(s, t)) visit(s, t);
      }
    }
  }

  bool some_pair_counts(const Candidate& c) const {
    if (!counts(c)) return false;
    if (!counted_ || counted_->is_of_features()) return true;
    bool some = false;
    for_each_holding(c.of_first, c.of_second, [&](std::int32_t s, std::int32_t t) {
      some = some || counted_->counts_faces(s, t);
    });
    return some;
  }

  StepJudgement judgement(std::vector<FoundPairs>& found, bool complete) const {
    return judgement_of(found, counted_, tested_, complete);
  }

 private:
  using Relation = std::optional<PairRelation>;  // nothing: every pair passes

  bool bodies_meet(std::int32_t u, std::int32_t v) const {
    return !counted_ || counted_->bodies_meet(u, v);
  }
  bool asks_piercing() const { return tested_ && options_.features == AskedFeatures::all; }
  bool asks(AskedFeatures kind) const { return options_.features == kind || asks_piercing(); }
  bool passes(const Relation& relation, const Candidate& c) const {
    if (!relation || !relation->is_of_features()) return true;
    return c.points.first_group == 1
               ? relation->counts_vertex_face(c.feature.vertices[0], c.second)
               : relation->counts_edges(features_.edges[c.first], features_.edges[c.second]);
  }

  detector::MovingPoint path(std::int32_t vertex) const { return motion_.path(vertex); }

  bool counts(std::int32_t s, std::int32_t t) const {
    if (s == t) return false;
    const Face &a = features_.faces[s], &b = features_.faces[t];
    if (!options_.neighbours && (holds(b, a[0]) || holds(b, a[1]) || holds(b, a[2]))) return false;
    return !options_.also_asked || options_.also_asked(std::min(s, t), std::max(s, t));
  }

  bool some_counts(const Holders& of_first, const Holders& of_second) const {
    for (const std::int32_t s : of_first) {
      for (const std::int32_t t : of_second) {
        if (counts(s, t)) return true;
      }
    }
    return false;
  }

  const SteppedMesh& motion_;
  const MeshFeatures features_;
  const DistanceOptions& options_;
  Relation counted_, tested_;
};

StepJudgement judge(const CountedFeatures& features, const SteppedMesh& motion, const Separation& d,
                    const DistanceOptions& options, StopGate& gate) {
  std::vector<FoundPairs> found(std::max(options.jobs, 1));
  const Workers workers{static_cast<int>(found.size()), &gate};
  const auto separation = [&](const Feature& f, int first_group) -> Separation {
    if (options.offsets.empty()) return d;
    return {options.offsets[detector::at(f.vertices[0])],
            options.offsets[detector::at(f.vertices[first_group])]};
  };
  features.for_each(grown_boxes(motion, half_of(d), options.offsets), workers,
                    [&](const Candidate& c, int worker) {
                      FoundPairs& mine = found[worker];
                      const FirstNear answer =
                          first_time_within(c.points, separation(c.feature, c.points.first_group));
                      ++mine.candidates;
                      mine.rungs.add(answer.rung);
                      if (!answer.near || !features.counts(c)) return;
                      const bool is_tested = features.is_tested(c);
                      features.for_each_holding(
                          c.of_first, c.of_second, [&](std::int32_t s, std::int32_t t) {
                            mine.pairs.add(s, t, answer.first, c.feature);
                            if (is_tested) mine.asked_pairs.add(s, t, answer.first, c.feature);
                          });
                    });
  features.for_each_pierced_at_start(
      workers, [&](std::int32_t s, std::int32_t t, const Feature& feature, int worker) {
        found[worker].pairs.add(s, t, {0, 0}, feature);
        if (features.is_piercing_tested(s, t)) found[worker].asked_pairs.add(s, t, {0, 0}, feature);
      });

  return features.judgement(found, !gate.was_stopped());
}

void require_sound(const SteppedMesh& motion, const TrianglesView& triangles) {
  require_exact_processor_state();
  assert(motion.vertices_t0.rows() == motion.vertices_t1.rows());
  assert(triangles.size() == 0 ||
         (triangles.minCoeff() >= 0 && triangles.maxCoeff() < motion.size()));
  (void)motion, (void)triangles;
}

// The longest side of the box of all vertices over the step, or the greatest double.
double extent(const SteppedMesh& motion) {
  double longest = 0;
  for (int k = 0; motion.size() > 0 && k < 3; ++k) {
    const auto &from = motion.vertices_t0.col(k), &to = motion.vertices_t1.col(k);
    longest = std::max(longest, std::max(from.maxCoeff(), to.maxCoeff()) -
                                    std::min(from.minCoeff(), to.minCoeff()));
  }
  return std::min(longest, greatest);
}

void lower_to(std::atomic<double>& least, double value) {
  double now = least.load();
  while (value < now && !least.compare_exchange_weak(now, value)) {
  }
}

}  // namespace

StepJudgement judge_distance(const SteppedMesh& motion, const TrianglesView& triangles,
                             const Separation& d, const DistanceOptions& options) {
  require_sound(motion, triangles);
  StopGate gate(options.stop);
  return judge(CountedFeatures(motion, triangles, options), motion, d, options, gate);
}

LeastDistance least_distance(const SteppedMesh& motion, const TrianglesView& triangles,
                             const DistanceOptions& options) {
  require_sound(motion, triangles);
  DistanceOptions plain = options;
  plain.offsets.clear();
  const CountedFeatures features(motion, triangles, plain);
  std::atomic<double> least = infinity;
  StopGate gate(options.stop);
  const Workers workers{std::max(options.jobs, 1), &gate};
  features.for_each_pierced_at_start(
      workers, [&](std::int32_t, std::int32_t, const Feature&, int) { least = 0; });
  // Looks among pairs within a distance, and then within a greater one. Two vertices are never
  // farther apart than twice the extent. The order in which threads work does not change the least
  // distance.
  constexpr double first_share = 0x1p-16, growth = 16;
  const double most = std::min(2 * extent(motion), greatest);
  for (double within = most * first_share; least > within && !gate.stopped();
       within = std::max(within * growth, std::numeric_limits<double>::denorm_min())) {
    features.for_each(grown_boxes(motion, half_of({within, 0}), plain.offsets), workers,
                      [&](const Candidate& c, int) {
                        const double now = least;
                        if (now == 0) return;
                        const double nearer = now > within ? within : std::nextafter(now, 0);
                        if (!first_time_within(c.points, {nearer, 0}, detector::Want::yes_no).near)
                          return;
                        if (features.some_pair_counts(c)) lower_to(least, least_distance(c.points));
                      });
    if (within >= most) break;
  }
  LeastDistance result;
  if (gate.was_stopped()) return result;
  result.complete = true;
  result.distance = least;
  if (least == infinity) return result;
  const StepJudgement there = judge(features, motion, {least, 0}, plain, gate);
  result.complete = there.complete;
  if (!there.complete) return result;
  assert(!there.pairs.empty());
  result.where = there.pairs.front();
  return result;
}

}  // namespace assay::oracle
