// The additive continuous collision detection (Li et al. 2021) of ppf-contact-solver, on the host.
//
// Version: commit f23b3565 (2026-08-07) of st-tech/ppf-contact-solver. Functions:
// accd::point_triangle_ccd and accd::edge_edge_ccd of contact/accd, which its emulator compiles for
// the host, too. Settings: offset 0, ghat 1e-3 (surfaces keep a gap of a hundredth of ghat), and
// its defaults line_search_max_t 1.25 and ccd_eps 1e-7. Contract: float32; features 1e-5 apart at
// the start, the distance at which it stops features that come nearer; and coordinates up to 10
// (its source says "compare ghat against FLT_EPSILON times the scene radius", and gives 10 as an
// example). The time is a lower bound. Claims: free-sound and not-late ("Contact resolutions are
// penetration-free", its README, line 33). It does not promise that it reports only contacts. As a
// limiter (limiter.h) it gives the time as its share, and claims path-free.
//
// Expected before the first run: few defects, because its distance is the least distance of all
// candidates, and it verifies its last step. A float loses digits in differences of positions, so
// it fails for large coordinates and near misses; features that only come within 1e-5 are reported.
// If the distance at the start is 0 in floats, the share is 0.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
using std::isfinite;  // as CUDA has them
using std::max;
#include <contact/accd.hpp>

#include "corpus/peers/feature_pairs.h"
#include "corpus/peers/limiter.h"

// The data that the solver reads after a step.
namespace accd {
unsigned g_ccd_overlap, g_ccd_overlap_v0, g_ccd_overlap_v1, g_ccd_overlap_kind;
float g_ccd_overlap_d2, g_ccd_overlap_offset;
}  // namespace accd

namespace assay::peers {
namespace {

struct Ppf {
  static Time vertex_face(const FourPaths& paths) {
    return ask_points<Vec3f>(
        [](auto p, auto a, auto b, auto c, auto p1, auto a1, auto b1, auto c1) {
          return told(
              accd::point_triangle_ccd(p, p1, a, b, c, a1, b1, c1, offset, ghat, settings()));
        },
        paths);
  }
  static Time edge_edge(const FourPaths& paths) {
    return ask_points<Vec3f>(
        [](const auto&... points) {
          return told(accd::edge_edge_ccd(points..., offset, ghat, settings()));
        },
        paths);
  }
  static plugin::Description describe() {
    auto d = usual_description("ppf-contact-solver, accd", "f23b3565 of 2026-08-07",
                               ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_NOT_LATE);
    d.coordinates = ASSAY_COORDINATES_FLOAT32;
    d.start = ASSAY_START_APART;
    d.start_distance = 1e-5;
    d.largest = 10;
    return d;
  }

 private:
  static constexpr float offset = 0, ghat = 1e-3f;
  static ParamSet settings() {
    ParamSet all{};
    all.line_search_max_t = 1.25f;
    all.ccd_eps = 1e-7f;
    return all;
  }
  static Time told(float time) { return not_before(time < 1, time); }
};

}  // namespace
}  // namespace assay::peers

ASSAY_EXPORT_DETECTOR(assay::peers::AsBuilt<assay::peers::LowerBoundOf<assay::peers::Ppf>>);
