// A limiter, which says how far a step may go, by the built-in detector; and limiters with a fault.
// ASSAY_LIMITS_STEPS holds words of told.h, and
//
//   separation=D
//   share-alone    gives a share and no positions, and claims nothing about positions
//   positions      gives positions and no share
//   or one of these faults:
//   rounds-up      gives the upper end of the first contact time as share
//   nearest-vertex stops only the first vertex of the first contact
//   forgets-one    lets the last vertex go on to the end
//   ignores-it     looks for contacts alone, whatever the separation is
//   last-pair      uses the time of the last pair in the list
//   float-end      rounds the positions to float32
//   stale-start    goes on from the start of the previous step
//   at-contact     stops at the place of the contact
//   parallel-zero  does not move if the edges of the first contact are parallel
//   by-order       tests only vertices of the triangle with the lower number
#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "detector/detector.h"
#include "detector/plugin/assay_detector.hpp"
#include "tests/plugins/told.h"

namespace {

using namespace assay;
using detector::FeatureKind, detector::PairContact, plugin::Limit;

const tests::Told& told() {
  static const tests::Told words("ASSAY_LIMITS_STEPS");
  return words;
}

constexpr double progress = 0.9;

class LimitsSteps {
 public:
  static plugin::Description describe() {
    std::uint32_t claims = ASSAY_CLAIM_WHOLE | ASSAY_CLAIM_TOTAL | ASSAY_CLAIM_DETERMINISTIC;
    if (!told().has("share-alone")) claims |= ASSAY_CLAIM_COMMIT_FREE;
    if (!told().has("positions")) claims |= ASSAY_CLAIM_PATH_FREE | ASSAY_CLAIM_PROGRESS;
    auto d = told().description("limits steps", claims);
    if (!told().has("positions")) d.progress = progress;
    if (told().has("share-alone")) d.limit_gives = ASSAY_LIMIT_START_PLUS;
    if (d.separation > 0) d.adjacency = ASSAY_ADJACENCY_NO_SHARED_VERTEX;
    return d;
  }

  explicit LimitsSteps(const plugin::Mesh& mesh)
      : triangles_(plugin::eigen(mesh.triangles)), before_(plugin::eigen(mesh.positions)) {
    const double d = told().has("ignores-it") ? 0 : told().number_of("separation");
    auto made = detector::Detector::create(triangles_, before_,
                                           {.culling = detector::Culling::bvh, .separation = d});
    if (!made) throw plugin::Refused(made.error().message);
    detector_.emplace(std::move(made.value()));
  }

  Limit limit(plugin::Positions x_t0, plugin::Positions x_t1) {
    const detector::Positions from = plugin::eigen(x_t0), to = plugin::eigen(x_t1);
    const auto right = detector_->limit(from, to);
    if (right.problem) throw std::runtime_error(right.problem->message);
    share_ = right.share;
    positions_ = right.positions;
    if (right.answer == detector::Answer::collision && share_ > 0) plant(from, to);
    if (told().has("float-end")) positions_ = positions_.cast<float>().cast<double>();
    before_ = from;
    if (told().has("share-alone")) return Limit::of_share(share_);
    return Limit::at({positions_.data(), positions_.data() + positions_.size()},
                     told().has("positions") ? -1 : share_);
  }

 private:
  void go(const detector::Positions& from, const detector::Positions& to, double share) {
    share_ = share;
    positions_ = from + share * (to - from);
  }

  // Makes the right answer to a step with a contact a wrong one.
  void plant(const detector::Positions& from, const detector::Positions& to) {
    const auto pairs = detector_->evaluate(from, to).pairs;
    const auto first = std::min_element(
        pairs.begin(), pairs.end(),
        [](const PairContact& a, const PairContact& b) { return a.time < b.time; });
    if (first == pairs.end()) return;
    const auto& feature = first->feature;
    if (told().has("rounds-up")) go(from, to, first->time.hi);
    if (told().has("at-contact")) go(from, to, first->time.lo);
    if (told().has("nearest-vertex") && feature.vertices[0] >= 0) {
      const detector::Positions stopped = positions_;
      positions_ = to;
      positions_.row(feature.vertices[0]) = stopped.row(feature.vertices[0]);
    }
    if (told().has("forgets-one")) positions_.bottomRows(1) = to.bottomRows(1);
    if (told().has("last-pair")) go(from, to, 0.95 * pairs.back().time.lo);
    if (told().has("stale-start")) positions_ = before_ + share_ * (to - before_);
    if (told().has("parallel-zero") && feature.kind == FeatureKind::edge_edge &&
        are_parallel(from, feature.vertices))
      go(from, to, 0);
    if (told().has("by-order")) {
      double least = 1;
      for (const auto& contact : pairs) {
        if (is_of_lower(contact)) least = std::min(least, 0.95 * contact.time.lo);
      }
      go(from, to, least);
    }
  }

  static bool are_parallel(const detector::Positions& x, const std::array<std::int32_t, 5>& v) {
    const Eigen::Vector3d a = x.row(v[1]) - x.row(v[0]), b = x.row(v[3]) - x.row(v[2]);
    return a.cross(b).norm() <= 1e-9 * a.norm() * b.norm();
  }

  bool is_of_lower(const PairContact& contact) const {
    if (contact.feature.kind != FeatureKind::vertex_face) return true;
    return (triangles_.row(contact.pair.a).array() == contact.feature.vertices[0]).any();
  }

  detector::Triangles triangles_;
  detector::Positions before_, positions_;
  double share_ = 0;
  std::optional<detector::Detector> detector_;
};

}  // namespace

ASSAY_EXPORT_DETECTOR(LimitsSteps);
