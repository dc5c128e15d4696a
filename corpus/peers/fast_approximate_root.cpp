// Fast Approximate Root in Cubic CCD: the method of "Penetration-free Projective Dynamics on the
// GPU" (Lan et al. 2022) in Zachary Ferguson's reimplementation.
//
// Version: commit 138321e2 (2024-04-01) of zfergus/fast-approximate-root-ccd. Functions:
// ccd::point_triangle_ccd and ccd::edge_edge_ccd. Settings: none (Newton's method ends when a step
// is below 1e-6), without assertions, as in its own Release build. Contract: no contact at the
// start, coordinates of usual sizes. Claims: only deterministic and total, because its README says
// "this method can produce false negatives (i.e., miss collisions)" and prints two of them. So
// contacts that it misses are shown in brackets, and do not count as defects.
//
// Expected before the first run: the two false negatives of its README. For a cubic without extrema
// (4 b b - 12 a c below 0) the answer is "no", although the cubic has a root. The function looks at
// one root only, so contacts at a later root are missed. Newton's method stops before the root; at
// that time a contact at the end of a feature or of the step does not show yet. For motion within a
// plane the answer is always "yes", which gives false alarms. For lengths below 1e-5, coefficients
// are treated as zero.
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
