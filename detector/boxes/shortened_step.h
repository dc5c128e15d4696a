// A step as far as a time `until`, for boxes that need to cover no more of it.
//
// Its ends are the places at t=0 and those at `until`, as doubles compute them:
//   x0 + until (x1 - x0), or (1 - until) x0 + until x1 if x1 - x0 overflows,
// and between x0 and x1 in any case. Let M be the largest size of a coordinate of the step, and u
// = 2^-53. In the first form the difference, at most 2 M, is off by 2 M u; the product by another
// 2 M u, and by 2^-1075 if it underflows; the sum by M u: less than 8 M u + 2^-1073 in all, with
// the products of errors. In the second form each product, at most M, is off by 2 M u and
// 2^-1075, and the sum by M u: less than that too. To bring a place between x0 and x1, where the
// true one lies, does not take it farther from that one.
//
// So each coordinate is off by e = 2^-50 M + 2^-1073 at most, at `until`, and by less before that,
// because both motions are linear and begin at one place. A point is off by sqrt(3) e at most, and
// two features that come within d of each other by `until` do so within d + 2 sqrt(3) e in the
// motion that is computed. The slack is 4 e or more. For `until` 0 the places are exact, and it is
// 0.
#pragma once

#include <optional>

#include "detector/mesh/paced_stop.h"
#include "detector/mesh/types.h"

namespace assay::detector {

// The place on the way between two coordinates, as above; for a share in [0,1].
double place_between(double from, double to, double share);

class ShortenedStep {
 public:
  // REQUIRES until in [0,1). The positions of the step must outlive this object. If `pace` was
  // stopped, it must not be used.
  ShortenedStep(const SteppedMesh& step, double until, PacedStop& pace);

  const SteppedMesh& motion() const { return *motion_; }
  // Features that come within d by `until` come within d + slack() in motion().
  double slack() const { return slack_; }

 private:
  Positions end_;
  std::optional<SteppedMesh> motion_;
  double slack_ = 0;
};

}  // namespace assay::detector
