// The textbook method (cubic.h) in doubles, the roots in closed form.
//
// Version: 1, of this file. Settings: one tolerance of 1e-6, of barycentric numbers and of times.
// Contract: no contact at the start, coordinates of usual sizes, times within the tolerance.
// Claims: free-sound and not-late, because Bridson, Fedkiw and Anderson, Robust treatment of
// collisions, contact and friction for cloth animation (2002), section 6.1, offer the same test
// ("we check for interference at the roots") as one that finds all collisions of a step; total and
// deterministic, because it is a function of its arguments. The book promises all of this without
// a word on rounding.
//
// As a limiter (limiter.h) it stops at 0.9 of the first time, the part that solvers with a line
// search keep (Li et al., Incremental potential contact, 2020, scale the time of a collision
// before they step). Claims: commit-free and path-free, from the same place: who finds every
// collision and stops a tenth before the first is free.
#include "corpus/peers/closed_form.h"
#include "corpus/peers/limiter.h"

namespace assay::peers {
namespace {

struct Doubles {
  using Number = double;
  static constexpr double tolerance = 1e-6, small = 1e-12;
};

struct CubicDouble : FeaturePairs<CubicTests<ClosedForm<Doubles>>> {
  static constexpr double part_of_time = .9;
  static constexpr std::uint32_t limit_claims = ASSAY_CLAIM_COMMIT_FREE | ASSAY_CLAIM_PATH_FREE;

  using FeaturePairs::FeaturePairs;
  static plugin::Description describe() {
    plugin::Description d = cubic_description();
    d.name =
        ASSAY_PEER_LIMIT ? "cubic in doubles, 0.9 of its time" : "cubic in doubles, tolerance 1e-6";
    d.time_tolerance = Doubles::tolerance;
    return d;
  }
};

}  // namespace
}  // namespace assay::peers

ASSAY_EXPORT_DETECTOR(assay::peers::AsBuilt<assay::peers::CubicDouble>);
