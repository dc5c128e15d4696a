// Fast Approximate Root in Cubic CCD: the method of "Penetration-free Projective Dynamics on the
// GPU" (Lan et al. 2022) as Zachary Ferguson implemented it again.
//
// Version: commit 138321e2 (2024-04-01) of zfergus/fast-approximate-root-ccd. Functions:
// ccd::point_triangle_ccd and ccd::edge_edge_ccd. Settings: none (Newton's method ends when a step
// is below 1e-6), assertions off, as its own Release build. Contract: no contact at the start,
// coordinates of usual sizes. Claims: deterministic and total alone, because its README says "this
// method can produce false negatives (i.e., miss collisions)" and prints two. Contacts that it
// misses are therefore shown in brackets, and not held against it.
//
// Expected before the first run: the two of its README. A cubic without extrema (4 b b - 12 a c
// below 0) is answered "no" though it has a root. Of several roots only one is looked at, so that
// features that meet at a later one are missed. Newton's method stops short of the root, where a
// contact at the end of a feature or of the step is not inside yet. A motion within a plane is
// answered "yes": alarms. Below lengths of 1e-5 coefficients count as zero.
#include <ccd.hpp>

#include "corpus/peers/feature_pairs.h"

namespace assay::peers {
namespace {

struct FastApproximateRoot {
  static Time vertex_face(const FourPaths& paths) {
    double time = 0;
    const bool found = ask_points<Eigen::Vector3d>(ccd::point_triangle_ccd, paths, time);
    return at_time(found, time);
  }
  static Time edge_edge(const FourPaths& paths) {
    double time = 0;
    const bool found = ask_points<Eigen::Vector3d>(ccd::edge_edge_ccd, paths, time);
    return at_time(found, time);
  }
  static plugin::Description describe() {
    auto d = usual_description("Fast Approximate Root", "138321e2 of 2024-04-01", 0);
    d.time_tolerance = 1e-6;
    return d;
  }
};

}  // namespace
}  // namespace assay::peers

ASSAY_EXPORT_DETECTOR(assay::peers::PeerOf<assay::peers::FastApproximateRoot>);
