// For one vertex p the view value over time is, up to positive factors, the active one of
//   h0 where g0 <= 0,   h1 where g1 >= 0,   hm = h0 |d|^2 - g0 (d.N) in between,
// with h0 = (p0-q0).N, h1 = (p0-q1).N, d = q1-q0, g0 = (p-q0).d, g1 = (p-q1).d. The value is
// continuous (at d = 0 both ends of the line coincide and h0 = h1). So the triangle has a sign over
// the step if and only if the three vertices agree at t=0 and no vertex's active piece has a zero.
//
// Pieces that vanish identically, given that the value at t=0 does not vanish:
//   h0 == 0: its region g0 <= 0 must stay empty: g0 has no root (at t=0 it is empty already).
//   h1 == 0: likewise with g1.
//   hm == 0: its region is open and not the whole step; where it begins or ends the value, which
//            is continuous, vanishes and h0 or h1 is active there: they show it.
#include "detector/view/view_exact.h"

#include "detector/exact/real_root.h"

namespace assay::detector {
namespace {

using PolynomialVector = std::array<Polynomial, 3>;

PolynomialVector operator-(const PolynomialVector& x, const PolynomialVector& y) {
  return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}

Polynomial dot(const PolynomialVector& x, const PolynomialVector& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

PolynomialVector cross(const PolynomialVector& x, const PolynomialVector& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

class ExactView {
 public:
  ExactView(const MovingTriangle& triangle, const ViewPrimitive& primitive)
      : is_point_(primitive.is_point()) {
    const std::array<const MovingPoint*, 5> points = {&triangle[0], &triangle[1], &triangle[2],
                                                      &primitive.q0, &primitive.q1};
    std::array<double, 30> values;
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        values[6 * i + k] = points[i]->t0[k];
        values[6 * i + 3 + k] = points[i]->t1[k];
      }
    }
    std::array<Integer, 30> scaled;
    to_common_integers(values, scaled);
    std::array<PolynomialVector, 5> x;
    for (std::size_t i = 0; i < x.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        x[i][k] = Polynomial::linear(scaled[6 * i + k], scaled[6 * i + 3 + k]);
      }
    }
    const PolynomialVector normal = cross(x[1] - x[0], x[2] - x[0]);
    h0_ = dot(x[0] - x[3], normal);
    if (is_point_) return;
    const PolynomialVector d = x[4] - x[3];
    h1_ = dot(x[0] - x[4], normal);
    length2_ = dot(d, d);
    d_normal_ = dot(d, normal);
    for (std::size_t i = 0; i < 3; ++i) {
      g0_[i] = dot(x[i] - x[3], d);
      g1_[i] = dot(x[i] - x[4], d);
    }
  }

  ViewSign run() const {
    if (is_point_) {
      if (h0_.is_zero() || has_root_in_unit_interval(h0_)) return ViewSign::zero;
      return static_cast<ViewSign>(h0_.sign_at_zero());
    }
    const int sign = value_sign_at_zero(0);
    if (sign == 0 || value_sign_at_zero(1) != sign || value_sign_at_zero(2) != sign) {
      return ViewSign::zero;
    }
    const auto result = static_cast<ViewSign>(sign);
    // One strict sign of both cubics settles every vertex.
    const auto keeps_sign = [sign](const Polynomial& h) {
      return h.sign_at_zero() == sign && !has_root_in_unit_interval(h);
    };
    if (keeps_sign(h0_) && keeps_sign(h1_)) return result;
    for (std::size_t i = 0; i < 3; ++i) {
      if (vanishes(i)) return ViewSign::zero;
    }
    return result;
  }

 private:
  Polynomial middle(std::size_t i) const { return h0_ * length2_ - g0_[i] * d_normal_; }

  int value_sign_at_zero(std::size_t i) const {
    if (g0_[i].sign_at_zero() <= 0) return h0_.sign_at_zero();
    if (g1_[i].sign_at_zero() >= 0) return h1_.sign_at_zero();
    return middle(i).sign_at_zero();
  }

  bool vanishes(std::size_t i) const {
    const Polynomial &g0 = g0_[i], &g1 = g1_[i];
    if (h0_.is_zero()) {
      if (g0.is_zero() || has_root_in_unit_interval(g0)) return true;
    } else {
      for (const auto& root : roots_in_unit_interval(h0_)) {
        if (root.sign_of(g0) <= 0) return true;
      }
    }
    if (h1_.is_zero()) {
      if (g1.is_zero() || has_root_in_unit_interval(g1)) return true;
    } else {
      for (const auto& root : roots_in_unit_interval(h1_)) {
        if (root.sign_of(g1) >= 0) return true;
      }
    }
    const Polynomial hm = middle(i);
    if (hm.is_zero()) return false;
    for (const auto& root : roots_in_unit_interval(hm)) {
      if (root.sign_of(g0) > 0 && root.sign_of(g1) < 0) return true;
    }
    return false;
  }

  bool is_point_;
  Polynomial h0_, h1_, length2_, d_normal_;
  std::array<Polynomial, 3> g0_, g1_;
};

}  // namespace

ViewSign exact_view_sign(const MovingTriangle& triangle, const ViewPrimitive& primitive) {
  return ExactView(triangle, primitive).run();
}

}  // namespace assay::detector
