#include "oracle/referee/second_opinion.h"

#include <algorithm>
#include <cassert>
#include <initializer_list>
#include <tuple>

#include "oracle/mesh/feature_pairs.h"
#include "oracle/parallel_chunks.h"
#include "oracle/processor_state.h"

namespace assay::oracle {

namespace {

using detector::Feature;
using detector::FeatureKind;
using detector::TrianglePair;

// Equal for equal indices in equal order, otherwise as good as random (splitmix64's mixing).
double hash_to_unit(std::initializer_list<std::int32_t> indices) {
  std::uint64_t h = indices.size();
  for (const std::int32_t index : indices) {
    h += 0x9e3779b97f4a7c15U + static_cast<std::uint64_t>(static_cast<std::uint32_t>(index));
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9U;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebU;
    h ^= h >> 31;
  }
  return static_cast<double>(h >> 11) * 0x1p-53;
}

auto order_of(const Contradiction& c) {
  const double time = std::holds_alternative<double>(c.time)
                          ? std::get<double>(c.time)
                          : static_cast<double>(std::get<RationalTime>(c.time).numerator) /
                                static_cast<double>(std::get<RationalTime>(c.time).denominator);
  return std::tuple(c.kind, c.feature.kind, c.feature.vertices, c.pair, time);
}

class Second {
 public:
  Second(const detector::SteppedMesh& motion, const detector::TrianglesView& triangles,
         const StepJudgement& judgement, const SecondOpinionOptions& options)
      : motion_(motion),
        triangles_(triangles),
        judgement_(judgement),
        options_(options),
        features_(mesh_features(triangles)),
        gate_(options.stop),
        found_(std::max(options.jobs, 1)) {}

  SecondOpinion run() {
    const FeatureIndex mesh(features_, swept_boxes(motion_));
    const Workers workers = {static_cast<int>(found_.size()), &gate_};
    if (!gate_.stopped()) {
      for_each_vertex_face(mesh, mesh, workers, [this](std::size_t a, std::size_t b, int worker) {
        ask_vertex_face(a, b, found_[static_cast<std::size_t>(worker)]);
      });
      if (judgement_.complete) {
        for_each_face_face(mesh, mesh, workers, [this](std::size_t a, std::size_t b, int worker) {
          check_pair(a, b, found_[static_cast<std::size_t>(worker)]);
        });
      }
    }
    if (!gate_.stopped()) {
      for_each_edge_edge(mesh, mesh, workers, [this](std::size_t a, std::size_t b, int worker) {
        ask_edge_edge(a, b, found_[static_cast<std::size_t>(worker)]);
      });
    }
    return collect();
  }

 private:
  bool chosen(std::initializer_list<std::int32_t> indices) const {
    return hash_to_unit(indices) < options_.share;
  }

  detector::MovingPoint path(std::int32_t vertex) const { return motion_.path(vertex); }

  void ask_vertex_face(std::size_t item, std::size_t face, SecondOpinion& found) const {
    const std::int32_t v = features_.vertices[item];
    const Face& f = features_.faces[face];
    if (!chosen({v, f[0], f[1], f[2]})) return;
    const detector::VertexFace query = {path(v), {path(f[0]), path(f[1]), path(f[2])}};
    const Feature feature{FeatureKind::vertex_face, {v, f[0], f[1], f[2], -1}};
    const bool judged = vertex_face_contact(query, detector::Want::yes_no).contact;
    if (!compare_query(feature, judged, referee(query, options_.referee), found)) return;
    for (const std::int32_t t : features_.triangles_of_vertex.of(item)) {
      demand_pair(feature, t, static_cast<std::int32_t>(face), found);
    }
  }

  void ask_edge_edge(std::size_t item, std::size_t other, SecondOpinion& found) const {
    const Edge &a = features_.edges[item], &b = features_.edges[other];
    if (!chosen({a[0], a[1], b[0], b[1]})) return;
    const detector::EdgeEdge query = {{path(a[0]), path(a[1])}, {path(b[0]), path(b[1])}};
    const Feature feature{FeatureKind::edge_edge, {a[0], a[1], b[0], b[1], -1}};
    const bool judged = edge_edge_contact(query, detector::Want::yes_no).contact;
    if (!compare_query(feature, judged, referee(query, options_.referee), found)) return;
    for (const std::int32_t s : features_.triangles_of_edge.of(item)) {
      for (const std::int32_t t : features_.triangles_of_edge.of(other)) {
        demand_pair(feature, s, t, found);
      }
    }
  }

  // Counts and compares; true when the referee has proved a contact.
  static bool compare_query(const Feature& feature, bool judged, detector::Decision verdict,
                            SecondOpinion& found) {
    ++found.queries;
    if (verdict == detector::Decision::open) {
      ++found.open;
      return false;
    }
    const bool contact = verdict == detector::Decision::yes;
    ++(contact ? found.contact : found.no_contact);
    if (contact != judged) {
      found.contradictions.push_back(
          {ContradictionKind::query, feature, {-1, -1}, {}, judged, contact});
    }
    return contact;
  }

  const detector::PairContact* judged_pair(TrianglePair pair) const {
    const auto at = std::lower_bound(judgement_.pairs.begin(), judgement_.pairs.end(), pair,
                                     [](const auto& contact, auto p) { return contact.pair < p; });
    return at != judgement_.pairs.end() && at->pair == pair ? &*at : nullptr;
  }

  void demand_pair(const Feature& feature, std::int32_t s, std::int32_t t,
                   SecondOpinion& found) const {
    const TrianglePair pair{std::min(s, t), std::max(s, t)};
    if (!judgement_.complete || judged_pair(pair)) return;
    found.contradictions.push_back(
        {ContradictionKind::missing_pair, feature, pair, {}, false, true});
  }

  void check_pair(std::size_t item, std::size_t other, SecondOpinion& found) const {
    const TrianglePair pair{static_cast<std::int32_t>(item), static_cast<std::int32_t>(other)};
    if (!chosen({pair.a, pair.b})) return;
    const detector::PairContact* judged = judged_pair(pair);
    for (const RationalTime& time : {RationalTime{0, 1}, {1, 3}, {1, 2}, {1, 1}}) {
      check_pair_at(pair, judged, time, found);
    }
    if (judged && judged->time.lo == judged->time.hi) {
      check_pair_at(pair, judged, judged->time.hi, found);
    }
  }

  void check_pair_at(TrianglePair pair, const detector::PairContact* judged, const StaticTime& time,
                     SecondOpinion& found) const {
    ++found.static_checks;
    const bool is_contact = triangles_meet(motion_, triangles_, pair, time);
    auto report = [&](ContradictionKind kind, bool by_judgement) {
      found.contradictions.push_back({kind, {}, pair, time, by_judgement, is_contact});
    };
    if (!judged) {
      if (is_contact) report(ContradictionKind::static_pair, false);
      return;
    }
    const detector::TimeEnclosure& first = judged->time;
    const bool is_double = first.lo == first.hi;
    const int side = compare(time, first.lo);  // the first time is lo, or above it
    if (is_contact && (side < 0 || (side == 0 && !is_double))) {
      report(ContradictionKind::static_late, false);
    }
    if (!is_contact && side == 0 && is_double) report(ContradictionKind::static_apart, true);
  }

  SecondOpinion collect() {
    SecondOpinion all;
    for (const SecondOpinion& part : found_) {
      all.queries += part.queries;
      all.contact += part.contact;
      all.no_contact += part.no_contact;
      all.open += part.open;
      all.static_checks += part.static_checks;
      all.contradictions.insert(all.contradictions.end(), part.contradictions.begin(),
                                part.contradictions.end());
    }
    std::sort(all.contradictions.begin(), all.contradictions.end(),
              [](const auto& x, const auto& y) { return order_of(x) < order_of(y); });
    all.complete = !gate_.was_stopped();
    return all;
  }

  const detector::SteppedMesh& motion_;
  const detector::TrianglesView& triangles_;
  const StepJudgement& judgement_;
  const SecondOpinionOptions& options_;
  const MeshFeatures features_;
  StopGate gate_;
  std::vector<SecondOpinion> found_;  // by thread
};

}  // namespace

SecondOpinion second_opinion(const detector::SteppedMesh& motion,
                             const detector::TrianglesView& triangles,
                             const StepJudgement& judgement, const SecondOpinionOptions& options) {
  require_exact_processor_state();
  assert(motion.vertices_t0.rows() == motion.vertices_t1.rows());
  assert(options.share > 0 && options.share <= 1);
  return Second(motion, triangles, judgement, options).run();
}

}  // namespace assay::oracle
