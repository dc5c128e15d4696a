#include "oracle/referee/second_opinion.h"

#include <algorithm>
#include <cassert>
#include <initializer_list>
#include <tuple>

#include "oracle/referee/referee.h"

namespace assay::oracle {

namespace {

using detector::Feature;
using detector::TrianglePair;

// Returns a hash in [0,1). It is equal for equal indices in equal order, and as good as random for
// different ones (splitmix64's mixing).
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
        gate_(options.stop),
        found_(std::max(options.jobs, 1)) {}

  SecondOpinion run() {
    const Workers workers = {static_cast<int>(found_.size()), &gate_};
    const auto of = [this](int worker) -> auto& {
      return found_[static_cast<std::size_t>(worker)];
    };
    const auto boxes = swept_boxes(motion_);
    StepFeatures(motion_, triangles_, {})
        .for_each(boxes, workers,
                  [&](const FeaturePair& pair, int worker) { ask(pair, of(worker)); });
    if (judgement_.complete && !gate_.stopped()) {
      const MeshFeatures features = mesh_features(triangles_);
      const FeatureIndex mesh(features, boxes);
      for_each_face_face(mesh, workers, [&](std::int32_t a, std::int32_t b, int worker) {
        check_pair({a, b}, of(worker));
      });
    }
    return collect();
  }

 private:
  bool chosen(std::initializer_list<std::int32_t> indices) const {
    return hash_to_unit(indices) < options_.share;
  }

  void ask(const FeaturePair& pair, SecondOpinion& found) const {
    const auto& [feature, of_first, of_second] = pair;
    const auto& v = feature.vertices;
    if (!chosen({v[0], v[1], v[2], v[3]})) return;
    const auto points = points_of(motion_, feature);
    const bool judged = contact_of(points, detector::Want::yes_no).contact;
    if (!compare_query(feature, judged, referee(points), found)) return;
    for (const std::int32_t s : of_first) {
      for (const std::int32_t t : of_second) demand_pair(feature, s, t, found);
    }
  }

  // Counts and compares. Returns true when the referee has proved a contact.
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

  void check_pair(TrianglePair pair, SecondOpinion& found) const {
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
  StopGate gate_;
  std::vector<SecondOpinion> found_;  // by thread
};

}  // namespace

SecondOpinion second_opinion(const detector::SteppedMesh& motion,
                             const detector::TrianglesView& triangles,
                             const StepJudgement& judgement, const SecondOpinionOptions& options) {
  assert(options.share > 0 && options.share <= 1);
  return Second(motion, triangles, judgement, options).run();
}

}  // namespace assay::oracle
