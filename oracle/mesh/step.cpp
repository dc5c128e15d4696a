#include "oracle/mesh/step.h"

#include <algorithm>
#include <cassert>
#include <tuple>
#include <utility>

#include "oracle/processor_state.h"

namespace assay::oracle {

namespace {

using detector::Feature;
using detector::FeatureKind;

auto key(const detector::PairContact& c) {
  return std::tie(c.pair.a, c.pair.b, c.time.lo, c.time.hi, c.feature.kind, c.feature.vertices);
}

// Pairs of triangles, each with the first of its times that were found.
//
// Keeps one contact for each pair of triangles: the least by time, then feature kind, then feature
// vertices. That is a total order, so the contact that is kept does not depend on the order of
// add().
class PairStore {
 public:
  // REQUIRES a != b. Their order does not matter.
  void add(std::int32_t a, std::int32_t b, const detector::TimeEnclosure& time,
           const Feature& feature) {
    contacts_.push_back({{std::min(a, b), std::max(a, b)}, time, feature});
    if (contacts_.size() >= tidy_at_) keep_least();
  }

  // Moves all contacts of another store into this one.
  void merge(PairStore& other) {
    contacts_.insert(contacts_.end(), other.contacts_.begin(), other.contacts_.end());
    other.contacts_ = {};
  }

  // Returns the kept contacts, ascending by pair; the store is empty afterwards.
  std::vector<detector::PairContact> take() {
    keep_least();
    return std::exchange(contacts_, {});
  }

 private:
  void keep_least() {
    std::sort(contacts_.begin(), contacts_.end(),
              [](const auto& x, const auto& y) { return key(x) < key(y); });
    contacts_.erase(std::unique(contacts_.begin(), contacts_.end(),
                                [](const auto& x, const auto& y) { return x.pair == y.pair; }),
                    contacts_.end());
    tidy_at_ = std::max(tidy_at_, 2 * contacts_.size());
  }

  std::vector<detector::PairContact> contacts_;
  std::size_t tidy_at_ = 1 << 16;  // at this size, only the least of each pair stay
};

// The findings of one thread. Candidates are judged as they are met and never stored.
struct FoundPairs {
  PairStore pairs, asked_pairs;
  RungCounts rungs;
  std::uint64_t candidates = 0;
};

// Puts together the findings of all threads. Relations of triangles are asked here, once for each
// pair.
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

}  // namespace

StepFeatures::StepFeatures(const detector::SteppedMesh& motion,
                           const detector::TrianglesView& triangles, const JudgeOptions& options,
                           bool neighbours, WantedPair also_asked)
    : motion_(motion),
      features_(mesh_features(triangles)),
      options_(options),
      neighbours_(neighbours),
      also_asked_(std::move(also_asked)) {
  require_exact_processor_state();
  assert(motion.vertices_t0.rows() == motion.vertices_t1.rows());
  assert(triangles.size() == 0 ||
         (triangles.minCoeff() >= 0 && triangles.maxCoeff() < motion.size()));
  if (options.counted && !options.counted->count_all())
    counted_.emplace(*options.counted, features_);
  if (options.tested && !options.tested->count_all()) tested_.emplace(*options.tested, features_);
}

void StepFeatures::for_each(const BoxOfVertices& boxes, const Workers& workers,
                            const VisitPair& visit) const {
  for (const auto kind : {FeatureKind::vertex_face, FeatureKind::edge_edge})
    for_each_of(kind, boxes, workers, visit);
}

// Visits the feature pairs of one kind that counted pairs of triangles may hold. Each kind has an
// index of its own, so that no more than one tree is in memory at a time.
void StepFeatures::for_each_of(FeatureKind kind, const BoxOfVertices& boxes, const Workers& workers,
                               const VisitPair& visit) const {
  if (workers.gate->stopped()) return;
  const FeatureIndex mesh(features_, boxes);
  const int second = kind == FeatureKind::vertex_face ? 1 : 2;  // place of the second feature
  for_each_pair(mesh, mesh, kind, workers, [&](const FeaturePair& pair, int worker) {
    const auto& v = pair.feature.vertices;
    if (counted_ && !counted_->bodies_meet(v[0], v[second])) return;
    if (some_of(pair, &StepFeatures::may_count)) visit(pair, worker);
  });
}

void StepFeatures::for_each_pierced_at_start(const Workers& workers,
                                             const VisitPierced& visit) const {
  for_each_of(FeatureKind::piercing, swept_boxes(motion_.at_start()), workers,
              [&](const FeaturePair& pair, int worker) {
                const auto at = [&](int i) { return motion_.start(pair.feature.vertices[i]); };
                if (!segment_pierces_triangle(at(0), at(1), {at(2), at(3), at(4)})) return;
                const std::int32_t face = pair.of_second[0];
                for (const std::int32_t t : pair.of_first) {
                  if (counts(t, face)) visit(t, face, pair.feature, worker);
                }
              });
  for (const auto& [s, t] : same_vertices_pairs(features_.faces)) {
    if (!counts(s, t)) continue;
    const Face& f = features_.faces[s];
    visit(s, t, Feature{FeatureKind::same_vertices, {f[0], f[1], f[2], -1, -1}}, 0);
  }
}

bool StepFeatures::some_pair_counts(const FeaturePair& pair) const {
  return passes(counted_, pair) &&
         ((counted_ && counted_->is_of_features()) || some_of(pair, &StepFeatures::counts));
}

StepJudgement StepFeatures::judge(const BoxOfVertices& boxes, StopGate& gate,
                                  const AnswerPair& answer) const {
  std::vector<FoundPairs> found(std::max(options_.jobs, 1));
  const Workers workers{static_cast<int>(found.size()), &gate};
  for_each(boxes, workers, [&](const FeaturePair& pair, int worker) {
    FoundPairs& mine = found[worker];
    const auto [is_contact, first, rung] = answer(points_of(motion_, pair.feature), pair.feature);
    ++mine.candidates;
    mine.rungs.add(rung);
    if (!is_contact || !passes(counted_, pair)) return;
    const bool asked = is_asked(pair);
    for (const std::int32_t s : pair.of_first) {
      for (const std::int32_t t : pair.of_second) {
        if (!may_count(s, t)) continue;
        mine.pairs.add(s, t, first, pair.feature);
        if (asked) mine.asked_pairs.add(s, t, first, pair.feature);
      }
    }
  });
  // Piercings at the start are of neither kind of features. They are asked for if all kinds are.
  for_each_pierced_at_start(
      workers, [&](std::int32_t s, std::int32_t t, const Feature& feature, int worker) {
        found[worker].pairs.add(s, t, {0, 0}, feature);
        if (asks_piercing() && tested_->counts_faces(s, t))
          found[worker].asked_pairs.add(s, t, {0, 0}, feature);
      });
  return judgement_of(found, counted_, tested_, !gate.was_stopped());
}

bool StepFeatures::may_count(std::int32_t s, std::int32_t t) const {
  if (s == t) return false;
  const Face &a = features_.faces[s], &b = features_.faces[t];
  if (!neighbours_ && (holds(b, a[0]) || holds(b, a[1]) || holds(b, a[2]))) return false;
  return !also_asked_ || also_asked_(std::min(s, t), std::max(s, t));
}

bool StepFeatures::counts(std::int32_t s, std::int32_t t) const {
  return may_count(s, t) && (!counted_ || counted_->counts_faces(s, t));
}

bool StepFeatures::some_of(const FeaturePair& pair, Says says) const {
  for (const std::int32_t s : pair.of_first) {
    for (const std::int32_t t : pair.of_second) {
      if ((this->*says)(s, t)) return true;
    }
  }
  return false;
}

// A relation of features is asked before a contact is kept. A relation of triangles is asked once
// for each pair in contact, at the end.
bool StepFeatures::passes(const Relation& relation, const FeaturePair& pair) {
  if (!relation || !relation->is_of_features()) return true;
  const auto& v = pair.feature.vertices;
  return pair.feature.kind == FeatureKind::vertex_face
             ? relation->counts_vertex_face(v[0], static_cast<std::size_t>(pair.of_second[0]))
             : relation->counts_edges({v[0], v[1]}, {v[2], v[3]});
}

bool StepFeatures::is_asked(const FeaturePair& pair) const {
  const auto kind = pair.feature.kind == FeatureKind::vertex_face ? AskedFeatures::vertex_face
                                                                  : AskedFeatures::edge_edge;
  return (options_.features == kind || asks_piercing()) && passes(tested_, pair);
}

StepJudgement judge_step(const detector::SteppedMesh& motion,
                         const detector::TrianglesView& triangles, const JudgeOptions& options) {
  StopGate gate(options.stop);
  return StepFeatures(motion, triangles, options)
      .judge(swept_boxes(motion), gate, [](const detector::FourPoints& points, const Feature&) {
        return contact_of(points, detector::Want::first_time);
      });
}

}  // namespace assay::oracle
