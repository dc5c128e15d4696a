// El Topo (Brochu and Bridson 2009): the elementary tests of its default, a cubic solver.
//
// Version: commit 5579391e (2025-05-22) of tysonbrochu/eltopo. Functions: point_triangle_collision
// and segment_segment_collision of its ccd_wrapper, called as in its collisionpipeline; they tell
// no time. Settings: USE_CUBIC_SOLVER_CCD, its default, with the values that are fixed in its
// sources (coplanarity to 1e-8 of the sum of the coefficients, distance below 1e-6). Contract: no
// contact at the start; coordinates of usual sizes, because 1e-6 is a length. Claim: free-sound,
// because its readme says that el_topo_integrate "moves the surface vertices while guaranteeing no
// self-intersections", and its ccd_wrapper says "If there is a collision, returns true". Features
// that only come within 1e-6 can be reported, so no-spurious is not claimed.
//
// Expected before the first run: contacts of motion within a plane are missed, because the cubic is
// 0 throughout, and then only t = 0 and t = 1 are looked at. Contacts at large coordinates and on
// long paths are missed, because a root is only accurate to 1e-10 of the coefficients, and at the
// computed root the features can be farther apart than 1e-6. Answers at ends of features and for
// small lengths are right.
#include <ccd_wrapper.h>

#include "corpus/peers/feature_pairs.h"

namespace assay::peers {
namespace {

struct ElTopoCubic {
  static Time vertex_face(const FourPaths& paths) {
    return some_time(ask_points<Vec3d>(
        [](auto p, auto a, auto b, auto c, auto p1, auto a1, auto b1, auto c1) {
          double weights[3], displacement = 0;
          Vec3d normal;
          return point_triangle_collision(p, p1, 0, a, a1, 1, b, b1, 2, c, c1, 3, weights[0],
                                          weights[1], weights[2], normal, displacement);
        },
        paths));
  }
  static Time edge_edge(const FourPaths& paths) {
    return some_time(ask_points<Vec3d>(
        [](auto a, auto b, auto c, auto d, auto a1, auto b1, auto c1, auto d1) {
          double weights[2], displacement = 0;
          Vec3d normal;
          return segment_segment_collision(a, a1, 0, b, b1, 1, c, c1, 2, d, d1, 3, weights[0],
                                           weights[1], normal, displacement);
        },
        paths));
  }
  static plugin::Description describe() {
    return usual_description("El Topo, cubic", "5579391e of 2025-05-22", ASSAY_CLAIM_FREE_SOUND);
  }
};

}  // namespace
}  // namespace assay::peers

ASSAY_EXPORT_DETECTOR(assay::peers::PeerOf<assay::peers::ElTopoCubic>);
