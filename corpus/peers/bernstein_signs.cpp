// Bernstein sign classification in its two public forms: BSC (Tang et al. 2014), which is exact if
// its filter cannot decide, and TightCCD (Wang et al. 2015), which uses error bounds.
// ASSAY_PEER_SIGNS chooses one of them.
//
// Version: commits 8db61b25 (2020-09-25) of
// Continuous-Collision-Detection/Root-Parity-and-Bernstein-Sign-Classification, and 366384ba
// (2020-09-23) of Continuous-Collision-Detection/TightCCD. Functions: Intersect_VF_robust (the
// vertex is the last argument, as in CCD-Wrapper) and Intersect_EE_robust of the headers bsc and
// bsc_tightbound; they tell no time. An exception of BSC ("Inflection points are not handled
// exactly in BSC!") counts as a collision, as in CCD-Wrapper ("Conservative answer upon failure").
// Settings: none. Contract: no contact at the start; coordinates of usual sizes. Claims: free-sound
// from the abstracts of their papers: BSC offers "a geometrically exact CCD algorithm ... to
// perform reliable Boolean collision queries", TightCCD "eliminates all the false negatives and 90
// - 95% of the false positives". No-spurious is claimed for neither.
//
// Expected before the first run: both can be wrong if the cubic has an inflection in the step (a
// comment of bsc_tightbound says of its own line "here has false negatives"), for motion within a
// plane, where all coefficients are 0, and for triangles without area. Differences of coordinates
// are rounded before the exact arithmetic begins, and BSC's bounds do not cover this rounding.
#include <cfenv>
#include <stdexcept>
#include ASSAY_PEER_HEADER

#include "corpus/peers/feature_pairs.h"

namespace assay::peers {
namespace {

struct Bsc {
  static constexpr auto name = "BSC", version = "8db61b25 of 2020-09-25";
};
struct TightCcd {
  static constexpr auto name = "TightCCD", version = "366384ba of 2020-09-23";
};
using Signs = ASSAY_PEER_SIGNS;

struct BernsteinSigns {
  static Time vertex_face(const FourPaths& paths) {
    FourPaths vertex_last = paths;
    for (auto& at : vertex_last.at) std::rotate(at, at + 1, at + 4);
    return ask(ASSAY_PEER_NAMESPACE::Intersect_VF_robust, vertex_last);
  }
  static Time edge_edge(const FourPaths& paths) {
    return ask(ASSAY_PEER_NAMESPACE::Intersect_EE_robust, paths);
  }
  static plugin::Description describe() {
    return usual_description(Signs::name, Signs::version, ASSAY_CLAIM_FREE_SOUND);
  }

 private:
  template <class Test>
  static Time ask(const Test& test, const FourPaths& paths) {
    std::fesetround(FE_TONEAREST);
    try {
      return some_time(ask_points<Vec3d>(test, paths));
    } catch (const std::runtime_error&) {
      return some_time(true);
    }
  }
};

}  // namespace
}  // namespace assay::peers

ASSAY_EXPORT_DETECTOR(assay::peers::PeerOf<assay::peers::BernsteinSigns>);
