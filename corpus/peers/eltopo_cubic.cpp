// El Topo (Brochu and Bridson 2009): the elementary tests of its default, a cubic solver.
//
// Version: commit 5579391e (2025-05-22) of tysonbrochu/eltopo. Functions: point_triangle_collision
// and segment_segment_collision of its ccd_wrapper, called as its collisionpipeline calls them;
// they tell no time. Settings: USE_CUBIC_SOLVER_CCD, its default, with the values that are fixed
// there (coplanarity to 1e-8 of the sum of the coefficients, distance below 1e-6). Contract: no
// contact at the start; coordinates of usual sizes, because 1e-6 is a length. Claim: free-sound,
// because its readme says that el_topo_integrate "moves the surface vertices while guaranteeing no
// self-intersections", and the wrapper "If there is a collision, returns true". Features that come
// within 1e-6 may be announced, so no-spurious is not claimed.
//
// Expected before the first run: motion within a plane is missed, because the cubic is 0 throughout
// and then t = 0 and t = 1 alone are looked at. Large coordinates and long ways are missed, because
// a root is known to 1e-10 of the coefficients alone, and at the time found the features may be
// farther apart than 1e-6. Ends of features and small lengths are right.
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
