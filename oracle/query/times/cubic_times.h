// The zeros of one cubic in the closed step, between those of its derivative.
#pragma once

#include <vector>

#include "oracle/query/times/quadratic_time.h"
#include "oracle/query/times/time_enclosure.h"

namespace assay::oracle {

// On the pieces of the step between the zeros of its derivative a cubic f is strictly monotone. So
// its zeros are some of the bounds of these pieces, and one inside of each piece at whose bounds f
// has opposite signs. A zero is held by its piece. All questions come down to signs of f at zeros
// of quadratics, which are closed formulas; nothing is isolated or refined.
class CubicTimes final : public ExactTimes {
 public:
  // REQUIRES degree 2 or 3.
  explicit CubicTimes(IntegerPolynomial f);

  int size() const override;
  // REQUIRES degree <= 2.
  int sign(const IntegerPolynomial& q, int i) const override;
  detector::TimeEnclosure enclosure(int i) const override;

 private:
  struct Zero {
    std::size_t bound;    // where it is, or where its piece begins
    bool inside = false;  // of the piece
  };
  // The exact sign of the zero minus another time or a double in [0,1].
  template <class Time>
  int compare(const Zero& zero, const Time& other) const;

  IntegerPolynomial f_;
  std::vector<QuadraticTime> bounds_;  // from 0 to 1
  std::vector<int> signs_;             // of f at the bounds
  std::vector<Zero> zeros_;
};

}  // namespace assay::oracle
