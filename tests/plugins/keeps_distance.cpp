// A detector of pairs that come within a distance. It takes its answers from the oracle, and can
// have a fault. ASSAY_KEEPS_DISTANCE holds words of told.h, and
//
//   separation=D
//   ours           the steps are answered by the built-in detector
//   or one of these faults:
//   ignores-it     looks for contacts alone
//   squares-it     uses d in place of d^2
//   half-boxes     grows the box of each triangle by d/4 in place of d/2
//   no-edges       ignores feet of the perpendicular on edges and at vertices
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

#include "detector/detector.h"
#include "detector/plugin/assay_detector.hpp"
#include "oracle/distance/feature_distance.h"
#include "oracle/distance/step_distance.h"
#include "tests/plugins/told.h"

namespace {

using namespace assay;
using detector::FeatureKind, detector::PairContact, detector::SteppedMesh, plugin::Result;

const tests::Told& told() {
  static const tests::Told words("ASSAY_KEEPS_DISTANCE");
  return words;
}

double asked_distance() {
  if (told().has("ignores-it")) return 0;
  const double d = told().number_of("separation");
  return told().has("squares-it") ? std::sqrt(d) : d;
}

// Whether the boxes of the two triangles over the step are farther apart than d/2 along an axis.
bool are_boxes_apart(const SteppedMesh& motion, const detector::Triangles& triangles,
                     detector::TrianglePair pair) {
  const double most = told().number_of("separation") / 2;
  for (int k = 0; k < 3; ++k) {
    double lo[2], hi[2];
    for (const int side : {0, 1}) {
      lo[side] = INFINITY;
      hi[side] = -INFINITY;
      for (int i = 0; i < 3; ++i) {
        const auto v = triangles(side == 0 ? pair.a : pair.b, i);
        for (const double x : {motion.vertices_t0(v, k), motion.vertices_t1(v, k)}) {
          lo[side] = std::min(lo[side], x);
          hi[side] = std::max(hi[side], x);
        }
      }
    }
    if (lo[1] - hi[0] > most || lo[0] - hi[1] > most) return true;
  }
  return false;
}

bool has_foot_on_edge(const detector::FourPoints& q, double t) {
  const auto places = oracle::closest_places(q, t);
  const auto is_inside = [](double share) { return 0 < share && share < 1; };
  const double third = q.first_group == 1 ? 1 - places.first - places.second : 0.5;
  return !is_inside(places.first) || !is_inside(places.second) || !is_inside(third);
}

detector::FourPoints features_of(const SteppedMesh& motion, std::span<const std::int32_t> v,
                                 bool is_face) {
  return {{motion.path(v[0]), motion.path(v[1]), motion.path(v[2]), motion.path(v[3])},
          is_face ? 1 : 2};
}

class KeepsDistance {
 public:
  static plugin::Description describe() {
    auto d = told().description(
        "keeps distance", ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_NOT_LATE | ASSAY_CLAIM_FIRST_TIME |
                              ASSAY_CLAIM_ALL_PAIRS | ASSAY_CLAIM_NO_SPURIOUS | ASSAY_CLAIM_TOTAL);
    d.adjacency = ASSAY_ADJACENCY_NO_SHARED_VERTEX;
    return d;
  }

  explicit KeepsDistance(const plugin::Mesh& mesh) : triangles_(plugin::eigen(mesh.triangles)) {
    if (!told().has("ours")) return;
    auto made = detector::Detector::create(
        triangles_, plugin::eigen(mesh.positions),
        {.culling = detector::Culling::bvh, .separation = told().number_of("separation")});
    if (!made) throw plugin::Refused(made.error().message);
    ours_ = std::move(made.value());
  }

  Result evaluate(plugin::Positions x_t0, plugin::Positions x_t1) {
    const detector::Positions from = plugin::eigen(x_t0), to = plugin::eigen(x_t1);
    const SteppedMesh motion{from, to};
    auto pairs = ours_ ? ours_->evaluate(from, to).pairs
                       : oracle::judge_distance(motion, triangles_, {asked_distance(), 0}).pairs;
    std::erase_if(pairs, [&](const PairContact& contact) {
      const bool is_face = contact.feature.kind == FeatureKind::vertex_face,
                 has_places = is_face || contact.feature.kind == FeatureKind::edge_edge;
      return (told().has("half-boxes") && are_boxes_apart(motion, triangles_, contact.pair)) ||
             (told().has("no-edges") && has_places &&
              has_foot_on_edge(features_of(motion, contact.feature.vertices, is_face),
                               contact.time.lo));
    });
    if (pairs.empty()) return Result::free();
    Result result = Result::collision(1, 1);
    for (const auto& [pair, time, feature] : pairs) {
      result.add(pair.a, pair.b, time.lo, time.hi);
      result.first = std::min(result.first, plugin::Interval{{time.lo, time.hi}});
    }
    return result;
  }

  static Result query(std::int32_t kind, plugin::Positions x_t0, plugin::Positions x_t1) {
    const detector::Positions from = plugin::eigen(x_t0), to = plugin::eigen(x_t1);
    const SteppedMesh motion{from, to};
    const auto q = features_of(motion, std::array{0, 1, 2, 3}, kind == ASSAY_QUERY_VERTEX_FACE);
    const auto answer = oracle::first_time_within(q, {asked_distance(), 0});
    if (!answer.contact) return Result::free();
    if (told().has("no-edges") && has_foot_on_edge(q, answer.first.lo)) return Result::free();
    return Result::collision(answer.first.lo, answer.first.hi);
  }

 private:
  detector::Triangles triangles_;
  std::optional<detector::Detector> ours_;
};

}  // namespace

ASSAY_EXPORT_DETECTOR(KeepsDistance);
