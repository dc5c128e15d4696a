// The textbook method (cubic.h) in doubles, the roots in closed form.
//
// Version: 1, of this file. Settings: one tolerance of 1e-6, of barycentric numbers and of times.
// Contract: no contact at the start, coordinates of usual sizes, times within the tolerance.
// Claims: free-sound and not-late, because Bridson, Fedkiw and Anderson, Robust treatment of
// collisions, contact and friction for cloth animation (2002), section 6.1, offer the same test
// ("we check for interference at the roots") as one that finds all collisions of a step; total and
// deterministic, because it is a function of its arguments. The book promises all of this without
// a word on rounding.
#include "corpus/peers/closed_form.h"

namespace assay::peers {
namespace {

struct Doubles {
  using Number = double;
  static constexpr double tolerance = 1e-6, small = 1e-12;
};

struct CubicDouble : FeaturePairs<CubicTests<ClosedForm<Doubles>>> {
  using FeaturePairs::FeaturePairs;
  static plugin::Description describe() {
    plugin::Description d = cubic_description();
    d.name = "cubic in doubles, tolerance 1e-6";
    d.time_tolerance = Doubles::tolerance;
    return d;
  }
};

}  // namespace
}  // namespace assay::peers

ASSAY_EXPORT_DETECTOR(assay::peers::CubicDouble);
