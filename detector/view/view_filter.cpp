// L1: with N = (p1-p0) x (p2-p0), h0 = (p-q0).N and h1 = (p-q1).N (the same for every point p of
// the triangle's plane), d = q1 - q0 and s = clamp((p-q0).d / d.d, 0, 1), the view value at p is
//   (p - n(p)).N = (1-s) h0 + s h1.
// This value is affine in s, and s is a clamped linear function on the triangle. So the extremes of
// the value over the triangle are at the three vertices, each with its own s, and the triangle is
// positive when the value is positive at the three vertices. h0 > 0 and h1 > 0 together are enough.
// L2: h0 and h1 are cubics in t. Over a piece of the step this file bounds h0 and h1 by their
// Bernstein coefficients, bounds the s of each vertex in the same way, and bounds the value from
// both. A piece that these bounds do not decide is halved. If the ends of the segment move, nothing
// else changes.
//
// Error bounds, in the notation of bernstein.h. At t=0 and at t=1, E_k bounds coordinate k of the
// edges p1-p0 and p2-p0, W_k bounds coordinate k of p-q, and D_k bounds coordinate k of d.
//   T = W_x E_y E_z + W_y E_z E_x + W_z E_x E_y
//   G = W_x D_x + W_y D_y + W_z D_z
//   L = D_x^2 + D_y^2 + D_z^2
//
//   quantity          | operations                  | error in u         | size
//   h0, h1            | w . n, middle               | 22 T               | 2 T
//   h0, h1 halved     | a cubic with B = 2 T        | as before + 6 T    | 2 T
//   (p-q0).d          | x . y, middle               | 6 G                | G
//   (p-q0).d halved   | a quadratic with B = G      | as before + 2 G    | G
//   d.d               | x . y, middle               | 6 L                | L
//   d.d halved        | a quadratic with B = L      | as before + 2 L    | L
//
// view_cubic_error and view_axial_error are these errors plus two u.
#include <algorithm>
#include <cmath>

#include "detector/view/view_signs.h"

namespace assay::detector {
namespace {

template <class T>
struct Range {
  T lo, hi;
};

template <class T, std::size_t n>
Range<T> range_of(const std::array<T, n>& b, T error) {
  const auto [least, greatest] = std::minmax_element(b.begin(), b.end());
  return {*least - error, *greatest + error};
}

template <class T>
Range<T> around(T value, T error) {
  return {value - error, value + error};
}

// Returns the sign of (1-s) h0 + s h1 if it is surely the same for all values in the ranges, else
// 0. The sums of ranges above were rounded once more, and these values are rounded four times:
// `slack` covers that.
template <class Bounds, class T>
int sure_value_sign(const Range<T>& h0, const Range<T>& h1, const Range<T>& s) {
  constexpr T slack = 16 * Bounds::unit;
  const T margin = slack * (std::max(std::abs(h0.lo), std::abs(h0.hi)) +
                            std::max(std::abs(h1.lo), std::abs(h1.hi)));
  const auto value = [](T a, T b, T s_) { return a + s_ * (b - a); };
  if (std::min(value(h0.lo, h1.lo, s.lo), value(h0.lo, h1.lo, s.hi)) > margin) return 1;
  if (std::max(value(h0.hi, h1.hi, s.lo), value(h0.hi, h1.hi, s.hi)) < -margin) return -1;
  return 0;
}

template <class Bounds, class T>
Range<T> clamped_axial(const Range<T>& along, const Range<T>& length2) {
  constexpr T slack = 8 * Bounds::unit;
  if (!(length2.lo > 0)) return {0, 1};
  const T lo = along.lo > 0 ? along.lo / length2.hi * (1 - slack) : 0;
  const T hi = along.hi > 0 ? along.hi / length2.lo * (1 + slack) : 0;
  return {std::min(lo, T(1)), std::min(hi, T(1))};
}

template <class Bounds>
class ViewFilter {
  using Number = typename Bounds::Number;
  using NumberRange = Range<Number>;

 public:
  ViewFilter(const MovingTriangle& triangle, const ViewPrimitive& primitive)
      : is_point_(primitive.is_point()) {
    const auto e1 = difference<Number>(triangle[1], triangle[0]);
    const auto e2 = difference<Number>(triangle[2], triangle[0]);
    VectorOf<Number> edge = {0, 0, 0};
    grow(edge, e1);
    grow(edge, e2);
    normal_ = cross(e1, e2);
    usable_ = usable(edge) &&
              make_cubic(difference<Number>(triangle[0], primitive.q0), edge, h0_, scale0_);
    if (is_point_ || !usable_) return;
    usable_ = make_cubic(difference<Number>(triangle[0], primitive.q1), edge, h1_, scale1_) &&
              make_axial(triangle, primitive);
  }

  std::optional<ViewSign> run() {
    if (!usable_) return std::nullopt;
    Piece piece{h0_, h1_, along_, length2_};
    visit(piece, 0);
    if (seen_positive_ && seen_negative_) return ViewSign::zero;
    if (open_) return std::nullopt;
    return seen_positive_ ? ViewSign::positive : ViewSign::negative;
  }

 private:
  static bool usable(const VectorOf<Number>& magnitude) {
    if constexpr (Bounds::proved) return in_range(magnitude);
    return true;
  }

  struct Piece {
    CubicOf<Number> h0, h1;
    std::array<QuadraticOf<Number>, 3> along;  // (p_i - q0).d
    QuadraticOf<Number> length2;               // d.d
  };

  bool make_cubic(const MovingVectorOf<Number>& w, const VectorOf<Number>& edge, CubicOf<Number>& h,
                  Number& scale) {
    VectorOf<Number> reach = {0, 0, 0};
    grow(reach, w);
    if (!usable(reach)) return false;
    h = triple_product(w, normal_);
    scale =
        reach[0] * edge[1] * edge[2] + reach[1] * edge[2] * edge[0] + reach[2] * edge[0] * edge[1];
    return true;
  }

  bool make_axial(const MovingTriangle& triangle, const ViewPrimitive& primitive) {
    const auto d = difference<Number>(primitive.q1, primitive.q0);
    VectorOf<Number> reach = {0, 0, 0}, line = {0, 0, 0};
    grow(line, d);
    length2_ = dot(d, d);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto w = difference<Number>(triangle[i], primitive.q0);
      grow(reach, w);
      along_[i] = dot(w, d);
    }
    along_scale_ = dot(reach, line);
    length2_scale_ = dot(line, line);
    return usable(reach) && usable(line);
  }

  // Notes the signs that are sure in the piece. True if both signs were seen, so that there is
  // nothing more to learn.
  bool visit(const Piece& piece, int depth) {
    if (settle(piece, depth)) return seen_positive_ && seen_negative_;
    note_end_values(piece, depth);
    if (seen_positive_ && seen_negative_) return true;
    if (depth == max_view_depth) {
      open_ = true;
      return false;
    }
    Piece left{}, right{};
    halve(piece.h0, left.h0, right.h0);
    if (!is_point_) {
      halve(piece.h1, left.h1, right.h1);
      halve(piece.length2, left.length2, right.length2);
      for (std::size_t i = 0; i < 3; ++i) halve(piece.along[i], left.along[i], right.along[i]);
    }
    return visit(left, depth + 1) || visit(right, depth + 1);
  }

  bool settle(const Piece& piece, int depth) {
    const NumberRange h0 = range_of(piece.h0, view_cubic_error<Bounds>(depth) * scale0_);
    if (is_point_) return note(h0.lo > 0 ? 1 : h0.hi < 0 ? -1 : 0);
    const NumberRange h1 = range_of(piece.h1, view_cubic_error<Bounds>(depth) * scale1_);
    const int whole_line = sure_value_sign<Bounds, Number>(h0, h1, {0, 1});
    if (whole_line != 0) return note(whole_line);
    const NumberRange length2 =
        range_of(piece.length2, view_axial_error<Bounds>(depth) * length2_scale_);
    int common = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const NumberRange along =
          range_of(piece.along[i], view_axial_error<Bounds>(depth) * along_scale_);
      const int sign =
          sure_value_sign<Bounds, Number>(h0, h1, clamped_axial<Bounds, Number>(along, length2));
      if (sign == 0) return false;
      note(sign);
      if (i > 0 && sign != common) return true;
      common = sign;
    }
    return true;
  }

  void note_end_values(const Piece& piece, int depth) {
    for (const bool at_end : {false, true}) {
      const Number error0 = view_cubic_error<Bounds>(depth) * scale0_;
      const NumberRange h0 = around(at_end ? piece.h0[3] : piece.h0[0], error0);
      if (is_point_) {
        note(h0.lo > 0 ? 1 : h0.hi < 0 ? -1 : 0);
        continue;
      }
      const NumberRange h1 =
          around(at_end ? piece.h1[3] : piece.h1[0], view_cubic_error<Bounds>(depth) * scale1_);
      const Number axial = view_axial_error<Bounds>(depth);
      const NumberRange length2 =
          around(at_end ? piece.length2[2] : piece.length2[0], axial * length2_scale_);
      for (const auto& a : piece.along) {
        const NumberRange along = around(at_end ? a[2] : a[0], axial * along_scale_);
        note(
            sure_value_sign<Bounds, Number>(h0, h1, clamped_axial<Bounds, Number>(along, length2)));
      }
    }
  }

  bool note(int sign) {
    seen_positive_ |= sign > 0;
    seen_negative_ |= sign < 0;
    return sign != 0;
  }

  bool is_point_, usable_ = false;
  CrossQuadraticOf<Number> normal_{};
  CubicOf<Number> h0_{}, h1_{};
  std::array<QuadraticOf<Number>, 3> along_{};
  QuadraticOf<Number> length2_{};
  Number scale0_ = 0, scale1_ = 0, along_scale_ = 0, length2_scale_ = 0;
  bool seen_positive_ = false, seen_negative_ = false, open_ = false;
};

}  // namespace

std::optional<ViewSign> filter_view_sign(const MovingTriangle& triangle,
                                         const ViewPrimitive& primitive) {
  return ViewFilter<ProvedBounds>(triangle, primitive).run();
}

template <class Number>
ViewSign plain_view_sign(const MovingTriangle& triangle, const ViewPrimitive& primitive) {
  return ViewFilter<NoBounds<Number>>(triangle, primitive).run().value_or(ViewSign::zero);
}

template ViewSign plain_view_sign<double>(const MovingTriangle&, const ViewPrimitive&);
template ViewSign plain_view_sign<float>(const MovingTriangle&, const ViewPrimitive&);

}  // namespace assay::detector
