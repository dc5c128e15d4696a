// Additive continuous collision detection (Li et al. 2021) as two simulators implement it, in
// doubles, on the CPU: CodimIpc if ASSAY_PEER_CODIM_IPC is 1, otherwise Libuipc.
//
//   CodimIpc  Point_Triangle_CCD and Edge_Edge_CCD of Math/Distance/CCD, commit 9c6cbe3a
//             (2022-11-01) of ipc-sim/Codim-IPC, with eta 0.1 and thickness 0. Its test of boxes
//             comes first, as in FEM/IPC
//   Libuipc   point_triangle_ccd and edge_edge_ccd of utils/distance/ccd, commit 619a5412
//             (2026-07-08) of spiriMirror/libuipc, with eta 0.1, thickness 0 and at most 1000
//             rounds. These functions are compiled for host and device. Its test whether boxes are
//             d_hat 0.01 apart comes first, as in stackless_bvh_simplex_trajectory_filter
//
// Contract: features are 1e-6 apart at the start (both sources say "we ensured other place that all
// dist smaller than dHat are positive", and a distance that rounds to 0 gives NaN), and coordinates
// are of usual sizes; the time is a lower bound. Claims: free-sound and not-late, because the
// authors of both simulators promise it: C-IPC "interpenetration-free" (its paper's abstract),
// libuipc "penetration-free frictional contact" (README, line 18). Neither simulator promises that
// it reports only contacts, so features that only come near can be reported. As a limiter
// (limiter.h), each gives the time as its share, and claims path-free.
//
// Expected before the first run: both stop before contacts, and report features that only come
// near. If the distance of the lines of parallel edges is rounded to 0, both use the distance of
// the corners ("this must be some far away nearly parallel edges"). The corners can be farther
// apart than the edges, so a contact is missed. (The first run did not yet leave out starts that
// are nearer than the contract allows. These starts gave the expected results, and CodimIpc never
// ended if a vertex started on a face.)
#include <cmath>
#if ASSAY_PEER_CODIM_IPC
#include <Eigen/Dense>
#include <vector>
// This header needs the two above.
#include <Math/Distance/CCD.h>
#else
#include <utils/distance/distance_flagged.h>
// This header needs the one above.
#include <utils/distance/ccd.h>
#endif

#include "corpus/peers/feature_pairs.h"
#include "corpus/peers/limiter.h"

namespace assay::peers {
namespace {

#if ASSAY_PEER_CODIM_IPC
struct Engine {
  static constexpr auto name = "C-IPC, additive", version = "9c6cbe3a of 2022-11-01";
  static constexpr auto faces_near = JGSL::Point_Triangle_CCD_Broadphase<double>;
  static constexpr auto edges_near = JGSL::Edge_Edge_CCD_Broadphase<double>;
  static constexpr auto faces = JGSL::Point_Triangle_CCD<double>;
  static constexpr auto edges = JGSL::Edge_Edge_CCD<double>;
  template <class Test, class... Points>
  static bool ask(const Test& test, double& time, const Points&... points) {
    return test(points..., eta, 0, time);
  }
  static constexpr double eta = .1, boxes_apart = 0;
};
#else
namespace distance = uipc::backend::cuda::distance;
struct Engine {
  static constexpr auto name = "libuipc, additive", version = "619a5412 of 2026-07-08";
  static constexpr auto faces_near = distance::point_triangle_ccd_broadphase<double>;
  static constexpr auto edges_near = distance::edge_edge_ccd_broadphase<double>;
  static constexpr auto faces = distance::point_triangle_ccd<double>;
  static constexpr auto edges = distance::edge_edge_ccd<double>;
  template <class Test, class... Points>
  static bool ask(const Test& test, double& time, const Points&... points) {
    return test(points..., eta, 0, most_rounds, time);
  }
  static constexpr double eta = .1, boxes_apart = .01;
  static constexpr int most_rounds = 1000;
};
#endif

struct Additive {
  static Time vertex_face(const FourPaths& paths) {
    return ask(Engine::faces_near, Engine::faces, paths);
  }
  static Time edge_edge(const FourPaths& paths) {
    return ask(Engine::edges_near, Engine::edges, paths);
  }

  static plugin::Description describe() {
    auto d = usual_description(Engine::name, Engine::version,
                               ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_NOT_LATE);
    d.start = ASSAY_START_APART;
    d.start_distance = 1e-6;
    return d;
  }

 private:
  using Point = Eigen::Matrix<double, 3, 1>;

  // Returns the way of a point, which both methods take. It is rounded up, because a way that is
  // rounded short ends before a contact at t = 1.
  static Point way(const Point& from, const Point& to) {
    Point way = to - from;
    for (int k = 0; k < 3; ++k) {
      // The rounding error of the difference, exactly (Knuth's two-sum).
      const double back = way[k] - to[k], lost = (to[k] - (way[k] - back)) - (from[k] + back);
      if (lost != 0 && (lost > 0) == (way[k] > 0)) way[k] = std::nextafter(way[k], 2 * way[k]);
    }
    return way;
  }

  template <class Near, class Test>
  static Time ask(const Near& near, const Test& test, const FourPaths& paths) {
    return ask_points<Point>(
        [&](const Point& a, const Point& b, const Point& c, const Point& d, const Point& a1,
            const Point& b1, const Point& c1, const Point& d1) -> Time {
          const Point da = way(a, a1), db = way(b, b1), dc = way(c, c1), dd = way(d, d1);
          if (!near(a, b, c, d, da, db, dc, dd, Engine::boxes_apart)) return std::nullopt;
          double time = 1;
          const bool found = Engine::ask(test, time, a, b, c, d, da, db, dc, dd);
          return not_before(found, time);
        },
        paths);
  }
};

}  // namespace
}  // namespace assay::peers

ASSAY_EXPORT_DETECTOR(assay::peers::AsBuilt<assay::peers::LowerBoundOf<assay::peers::Additive>>);
