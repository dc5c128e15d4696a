#include "oracle/mesh/step.h"

#include <algorithm>
#include <cassert>
#include <tuple>
#include <utility>

#include "oracle/mesh/feature_pairs.h"
#include "oracle/parallel_chunks.h"
#include "oracle/processor_state.h"

namespace assay::oracle {

namespace {

using detector::Feature;
using detector::FeatureKind;

class StepJudge {
 public:
  StepJudge(const detector::SteppedMesh& motion, const detector::TrianglesView& triangles,
            const JudgeOptions& options)
      : motion_(motion),
        features_(mesh_features(triangles)),
        gate_(options.stop),
        asked_features_(options.features),
        workers_(std::max(options.jobs, 1)) {
    if (options.counted && !options.counted->count_all())
      counted_.emplace(*options.counted, features_);
    if (options.tested && !options.tested->count_all()) tested_.emplace(*options.tested, features_);
    tells_apart_ = asked_features_ != AskedFeatures::all || tested_;
  }

  StepJudgement run() {
    judge_same_vertices();
    judge_vertices_and_faces();
    judge_edges();
    judge_piercing();
    return judgement_of(workers_, counted_, tested_, !gate_.was_stopped());
  }

 private:
  // The features with their boxes over the step, or at t=0 alone if the mesh at rest is given.
  // Each phase makes its own, so that no more than one tree is in memory at a time.
  FeatureIndex index_over(const detector::SteppedMesh& motion) const {
    return {features_, swept_boxes(motion)};
  }

  Workers workers() { return {static_cast<int>(workers_.size()), &gate_}; }

  void judge_same_vertices() {
    for (const auto& [a, b] : same_vertices_pairs(features_.faces)) {
      const Face& f = features_.faces[a];
      const Feature feature{FeatureKind::same_vertices, {f[0], f[1], f[2], -1, -1}};
      add_at_start(a, b, feature, workers_[0]);
    }
  }

  void judge_vertices_and_faces() {
    if (gate_.stopped()) return;
    const FeatureIndex mesh = index_over(motion_);
    for_each_vertex_face(mesh, mesh, workers(), [this](std::size_t a, std::size_t b, int worker) {
      judge_vertex_face(a, b, workers_[worker]);
    });
  }

  void judge_edges() {
    if (gate_.stopped()) return;
    const FeatureIndex mesh = index_over(motion_);
    for_each_edge_edge(mesh, mesh, workers(), [this](std::size_t a, std::size_t b, int worker) {
      judge_edge_edge(a, b, workers_[worker]);
    });
  }

  void judge_piercing() {
    if (gate_.stopped()) return;
    const FeatureIndex mesh = index_over(motion_.at_start());
    for_each_edge_face(mesh, mesh, workers(), [this](std::size_t a, std::size_t b, int worker) {
      judge_edge_face_at_start(a, b, workers_[worker]);
    });
  }

  detector::MovingPoint path(std::int32_t vertex) const { return motion_.path(vertex); }

  void judge_vertex_face(std::size_t item, std::size_t face, FoundPairs& worker) {
    const std::int32_t v = features_.vertices[item];
    const Face& f = features_.faces[face];
    if (!bodies_meet(v, f[0])) return;
    ++worker.candidates;
    const ContactAnswer answer = vertex_face_contact(
        {path(v), {path(f[0]), path(f[1]), path(f[2])}}, detector::Want::first_time);
    worker.rungs.add(answer.rung);
    const auto counts = [&](const PairRelation& in) { return in.counts_vertex_face(v, face); };
    if (!answer.contact || !passes(counted_, counts)) return;
    const bool is_asked = asks(AskedFeatures::vertex_face) && passes(tested_, counts);
    const Feature feature{FeatureKind::vertex_face, {v, f[0], f[1], f[2], -1}};
    for (const std::int32_t t : features_.triangles_of_vertex.of(item)) {
      worker.pairs.add(t, static_cast<std::int32_t>(face), answer.first, feature);
      if (is_asked)
        worker.asked_pairs.add(t, static_cast<std::int32_t>(face), answer.first, feature);
    }
  }

  void judge_edge_edge(std::size_t item, std::size_t other, FoundPairs& worker) {
    const Edge &a = features_.edges[item], &b = features_.edges[other];
    if (!bodies_meet(a[0], b[0])) return;
    ++worker.candidates;
    const ContactAnswer answer = edge_edge_contact(
        {{path(a[0]), path(a[1])}, {path(b[0]), path(b[1])}}, detector::Want::first_time);
    worker.rungs.add(answer.rung);
    const auto counts = [&](const PairRelation& in) { return in.counts_edges(a, b); };
    if (!answer.contact || !passes(counted_, counts)) return;
    const bool is_asked = asks(AskedFeatures::edge_edge) && passes(tested_, counts);
    const Feature feature{FeatureKind::edge_edge, {a[0], a[1], b[0], b[1], -1}};
    for (const std::int32_t s : features_.triangles_of_edge.of(item)) {
      for (const std::int32_t t : features_.triangles_of_edge.of(other)) {
        worker.pairs.add(s, t, answer.first, feature);
        if (is_asked) worker.asked_pairs.add(s, t, answer.first, feature);
      }
    }
  }

  void judge_edge_face_at_start(std::size_t item, std::size_t face, FoundPairs& worker) {
    const Edge& e = features_.edges[item];
    const Face& f = features_.faces[face];
    if (!bodies_meet(e[0], f[0])) return;
    auto at = [&](std::int32_t vertex) { return motion_.start(vertex); };
    if (!segment_pierces_triangle(at(e[0]), at(e[1]), {at(f[0]), at(f[1]), at(f[2])})) return;
    const Feature feature{FeatureKind::piercing, {e[0], e[1], f[0], f[1], f[2]}};
    for (const std::int32_t t : features_.triangles_of_edge.of(item)) {
      add_at_start(t, static_cast<std::int32_t>(face), feature, worker);
    }
  }

  bool bodies_meet(std::int32_t u, std::int32_t v) const {
    return !counted_ || counted_->bodies_meet(u, v);
  }
  bool asks(AskedFeatures kind) const {
    return tells_apart_ && (asked_features_ == kind || asked_features_ == AskedFeatures::all);
  }
  // A relation of features is asked before a contact is kept. A relation of triangles is asked once
  // for each pair in contact, at the end (judgement_of).
  using Relation = std::optional<PairRelation>;  // nothing: every pair passes
  template <class Counts>
  static bool passes(const Relation& relation, const Counts& counts) {
    return !relation || !relation->is_of_features() || counts(*relation);
  }

  // A contact that shows only at the start belongs to no kind of features, so it counts only if all
  // kinds do.
  void add_at_start(std::int32_t a, std::int32_t b, const Feature& feature,
                    FoundPairs& worker) const {
    const auto counts = [&](const PairRelation& in) { return in.counts_faces(a, b); };
    if (!passes(counted_, counts)) return;
    worker.pairs.add(a, b, {0, 0}, feature);
    if (tells_apart_ && asked_features_ == AskedFeatures::all && passes(tested_, counts))
      worker.asked_pairs.add(a, b, {0, 0}, feature);
  }

  const detector::SteppedMesh& motion_;
  const MeshFeatures features_;
  StopGate gate_;
  const AskedFeatures asked_features_;
  Relation counted_, tested_;
  bool tells_apart_ = false;  // whether asked_pairs is asked for
  std::vector<FoundPairs> workers_;
};

}  // namespace

StepJudgement judge_step(const detector::SteppedMesh& motion,
                         const detector::TrianglesView& triangles, const JudgeOptions& options) {
  require_exact_processor_state();
  assert(motion.vertices_t0.rows() == motion.vertices_t1.rows());
  assert(triangles.size() == 0 ||
         (triangles.minCoeff() >= 0 && triangles.maxCoeff() < motion.size()));
  return StepJudge(motion, triangles, options).run();
}

namespace {

auto key(const detector::PairContact& c) {
  return std::tie(c.pair.a, c.pair.b, c.time.lo, c.time.hi, c.feature.kind, c.feature.vertices);
}

}  // namespace

void PairStore::add(std::int32_t a, std::int32_t b, const detector::TimeEnclosure& time,
                    const detector::Feature& feature) {
  contacts_.push_back({{std::min(a, b), std::max(a, b)}, time, feature});
  if (contacts_.size() >= tidy_at_) keep_least();
}

void PairStore::merge(PairStore& other) {
  contacts_.insert(contacts_.end(), other.contacts_.begin(), other.contacts_.end());
  other.contacts_ = {};
}

std::vector<detector::PairContact> PairStore::take() {
  keep_least();
  return std::exchange(contacts_, {});
}

void PairStore::keep_least() {
  std::sort(contacts_.begin(), contacts_.end(),
            [](const auto& x, const auto& y) { return key(x) < key(y); });
  contacts_.erase(std::unique(contacts_.begin(), contacts_.end(),
                              [](const auto& x, const auto& y) { return x.pair == y.pair; }),
                  contacts_.end());
  tidy_at_ = std::max(tidy_at_, 2 * contacts_.size());
}

StepJudgement judgement_of(std::vector<FoundPairs>& found,
                           const std::optional<PairRelation>& counted,
                           const std::optional<PairRelation>& tested, bool complete) {
  StepJudgement result;
  for (FoundPairs& one : found) {
    if (&one != found.data()) {
      found[0].pairs.merge(one.pairs);
      found[0].asked_pairs.merge(one.asked_pairs);
    }
    result.rungs += one.rungs;
    result.feature_candidates += one.candidates;
  }
  result.pairs = found[0].pairs.take();
  result.asked_pairs = found[0].asked_pairs.take();
  keep_counted(counted, result.pairs);
  keep_counted(counted, result.asked_pairs);
  keep_counted(tested, result.asked_pairs);
  if (!complete) return result;
  result.complete = true;
  result.answer = result.pairs.empty() ? detector::Answer::free : detector::Answer::collision;
  if (result.pairs.empty()) return result;
  result.first =
      std::min_element(result.pairs.begin(), result.pairs.end(), [](const auto& x, const auto& y) {
        return x.time < y.time;
      })->time;
  return result;
}

}  // namespace assay::oracle
