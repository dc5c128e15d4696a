#include "oracle/query/times/quadratic_times.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace assay::oracle {

QuadraticTimes::QuadraticTimes(std::span<const IntegerPolynomial> polynomials) {
  const IntegerPolynomial from_start = {{0, 1}}, from_end = {{-1, 1}};
  std::vector<QuadraticTime> zeros;
  for (const IntegerPolynomial& p : polynomials) {
    assert(!p.is_zero());
    if (p.degree() == 0 || surely_no_zero_in_unit(p)) continue;
    zeros.clear();
    QuadraticTime::append_zeros(p, zeros);
    for (QuadraticTime& zero : zeros) {
      if (zero.sign(from_start) >= 0 && zero.sign(from_end) <= 0) times_.push_back(std::move(zero));
    }
  }
  std::sort(times_.begin(), times_.end(),
            [](const auto& a, const auto& b) { return a.compare(b) < 0; });
  times_.erase(std::unique(times_.begin(), times_.end(),
                           [](const auto& a, const auto& b) { return a.compare(b) == 0; }),
               times_.end());
}

int QuadraticTimes::size() const { return static_cast<int>(times_.size()); }

int QuadraticTimes::sign(const IntegerPolynomial& q, int i) const { return times_[i].sign(q); }

detector::TimeEnclosure QuadraticTimes::enclosure(int i) const { return times_[i].enclosure(); }

}  // namespace assay::oracle
