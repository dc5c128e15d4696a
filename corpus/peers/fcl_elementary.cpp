// FCL, the Flexible Collision Library: the elementary tests of its continuous traversal of meshes.
//
// Version: 0.7.0, Debian libfcl-dev. Functions: fcl::detail::Intersect<double>::intersect_VF and
// intersect_EE, called as MeshContinuousCollisionTraversalNode::leafTesting calls them. Settings:
// the defaults (useNewton; a resolution in time of 1e-7 and epsilons of 1e-5 and 1e-7 are fixed in
// the library). Contract: no contact at the start; coordinates of usual sizes, because its
// epsilons are lengths; times within ten times its resolution. Claims: free-sound and not-late
// from its README ("continuous collision detection: detecting whether the two moving models
// overlap during the movement, and optionally, the time of contact"); total and deterministic,
// because they are functions of their arguments that return a bool. FCL's public function for
// meshes takes only rigid motions, so the peer calls the two tests directly; feature_pairs.h leaves
// out features that share a vertex.
#include <fcl/narrowphase/detail/traversal/collision/intersect.h>

#include "corpus/peers/feature_pairs.h"

namespace assay::peers {
namespace {

using Intersect = fcl::detail::Intersect<double>;
using Point = fcl::Vector3<double>;

struct FclTests {
  static Time vertex_face(const FourPaths& paths) {
    const Corners p(paths);
    double time = 2;
    Point where;
    const bool found = Intersect::intersect_VF(p(0, 1), p(0, 2), p(0, 3), p(0, 0), p(1, 1), p(1, 2),
                                               p(1, 3), p(1, 0), &time, &where);
    return at_time(found, time);
  }
  static Time edge_edge(const FourPaths& paths) {
    const Corners p(paths);
    double time = 2;
    Point where;
    const bool found = Intersect::intersect_EE(p(0, 0), p(0, 1), p(0, 2), p(0, 3), p(1, 0), p(1, 1),
                                               p(1, 2), p(1, 3), &time, &where);
    return at_time(found, time);
  }

 private:
  struct Corners {
    const FourPaths& paths;
    explicit Corners(const FourPaths& of) : paths(of) {}
    Point operator()(int at, int i) const {
      const double* p = paths.at[at][i];
      return {p[0], p[1], p[2]};
    }
  };
};

struct FclElementary : FeaturePairs<FclTests> {
  using FeaturePairs::FeaturePairs;
  static plugin::Description describe() {
    auto d =
        usual_description("FCL, Intersect", "0.7.0", ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_NOT_LATE);
    d.time_tolerance = 1e-6;
    return d;
  }
};

}  // namespace
}  // namespace assay::peers

ASSAY_EXPORT_DETECTOR(assay::peers::FclElementary);
