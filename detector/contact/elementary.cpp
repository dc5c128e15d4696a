#include "detector/contact/elementary.h"

#include <cmath>

#include "detector/contact/contact_pieces.h"
#include "detector/contact/fixed_products.h"
#include "detector/contact/rungs.h"

namespace assay::detector {
namespace {

// surely_later() has two proofs, each in doubles and then, if these cannot tell, in integers.
//
// Order along an axis. If the two groups are strictly ordered along an axis at t=0 and in the same
// sense at `until`, they are ordered at all times between, because every point moves linearly.
//   Doubles: with M the largest size of a coordinate along the axis, x + until (y - x) is off by
//   less than 8 M u + 2^-1073 (boxes/moving_box.h), and so is each of the two bounds that are
//   compared.
//   Integers: (2^62 - m) x + m y, where m 2^-62 is `until` rounded up, which proves no less. This
//   sum has 62 bits more than a coordinate, so W + 1 limbs hold it.
//
// Coplanarity. The cubic F (contact_pieces.h) has no zero in [0, until] if its Bernstein
// coefficients over that piece have one sign, and the first and the last are not 0. De Casteljau's
// scheme gives them: three levels of (1 - until) x + until y.
//   Doubles: a level is computed as x + until (y - x). With B the largest size of a coefficient, at
//   most 6 MxMyMz, the difference is off by 2 u B beside the errors of x and y, the product by
//   2 u B more, and the sum by u B: 5 u B a level. The older errors are averaged. So the
//   coefficients are off by cubic_error(0) + 3 * 5 * 6 u = cubic_error(0) + 90 u, times MxMyMz.
//   Integers: each level takes 62 bits more. The coefficients begin with 3c + 8 bits
//   (fixed_products.h) and end with 3c + 194 bits. As 3c <= 192 W - 24 they fit 3 W + 3 limbs,
//   which are 192 W + 192 bits, signs included.

// The bounds of the two groups.
template <class T>
struct GroupBounds {
  std::array<T, 2> lo, hi;
};

// value(i) is the value of point i.
template <class Value>
auto bounds_of(int first_group, const Value& value) {
  using T = decltype(value(std::size_t{}));
  GroupBounds<T> bounds;
  for (std::size_t i = 0; i < 4; ++i) {
    const T x = value(i);
    const auto split = static_cast<std::size_t>(first_group);
    const std::size_t g = i < split ? 0 : 1;
    const bool is_first = i == 0 || i == split;
    if (is_first || x < bounds.lo[g]) bounds.lo[g] = x;
    if (is_first || bounds.hi[g] < x) bounds.hi[g] = x;
  }
  return bounds;
}

// Returns 1 if the first group lies below the second along the axis at t=0, -1 if above, else 0.
int order_at_start(const FourPoints& query, std::size_t axis) {
  const auto at_start =
      bounds_of(query.first_group, [&](std::size_t i) { return query.points[i].t0[axis]; });
  return at_start.hi[0] < at_start.lo[1] ? 1 : at_start.hi[1] < at_start.lo[0] ? -1 : 0;
}

// With u = 2^-53 a place x + s (y - x), s in [0,1], is off by less than 8 M u + 2^-1073, and a
// coefficient of F over [0,s] by at most 90 u MxMyMz more than one over [0,1]. M bounds |x| and
// |y|, and 2 M is a double. The difference, at most 2 M, is off by 2 M u; its product with s by 2 M
// u more and by 2^-1075 if it underflows; the sum, at most M beside its error, by less than 2 M u
// more. De Casteljau's scheme takes three levels of such sums on coefficients of at most B = 6
// MxMyMz: the difference is off by 2 u B, the product by 2 u B and the sum by u B, so a level adds
// 5 u B, and three add 90 u MxMyMz; the errors of the operands are averaged.

// Returns whether the groups are still in this order at `until`; `open` if doubles cannot tell.
Decision stays_ordered(const FourPoints& query, std::size_t axis, int order, double until) {
  double largest = 0;
  const auto there = bounds_of(query.first_group, [&](std::size_t i) {
    const double x = query.points[i].t0[axis], y = query.points[i].t1[axis];
    largest = std::max({largest, std::abs(x), std::abs(y)});
    return x + until * (y - x);
  });
  // Differences and products of the greatest doubles may overflow.
  if (largest > 0x1p1000) return Decision::open;
  const double gap = order > 0 ? there.lo[1] - there.hi[0] : there.lo[0] - there.hi[1];
  // Twice 8 M u, and the rounding of the gap.
  const double bound = 0x1p-48 * largest + 0x1p-1070;
  return gap > bound ? Decision::yes : gap < -bound ? Decision::no : Decision::open;
}

struct Weights {
  explicit Weights(double until) : until_(static_cast<std::uint64_t>(std::ceil(until * 0x1p62))) {}
  // Returns (1 - until) x + until y, times 2^62.
  template <class T>
  T mean(const T& x, const T& y) const {
    return x.times((std::uint64_t{1} << 62) - until_) + y.times(until_);
  }

 private:
  std::uint64_t until_;
};

template <std::size_t W>
bool stays_ordered(const QueryIntegers& integers, int first_group, std::size_t axis, int order,
                   const Weights& weights) {
  using Value = FixedInteger<W + 1>;
  struct Ordered : Value {
    explicit Ordered(const Value& value) : Value(value) {}
    Ordered() = default;
    bool operator<(const Ordered& other) const { return (Value(*this) - Value(other)).negative(); }
  };
  const auto there = bounds_of(first_group, [&](std::size_t i) {
    return Ordered(
        weights.mean(Value(integers.at<W>(i, 0, axis)), Value(integers.at<W>(i, 1, axis))));
  });
  return order > 0 ? there.hi[0] < there.lo[1] : there.hi[1] < there.lo[0];
}

// Replaces the coefficients over [0,1] by those over [0,until]. `mean` is one step of a level.
template <class T, class Mean>
void cut(std::array<T, 4>& b, const Mean& mean) {
  for (std::size_t level = 1; level < 4; ++level) {
    for (std::size_t i = 3; i >= level; --i) b[i] = mean(b[i - 1], b[i]);
  }
}

template <std::size_t W>
bool stays_off_plane(const QueryIntegers& integers, int first_group, const Weights& weights) {
  using Value = FixedInteger<3 * W + 3>;
  const auto f = FixedProducts<W>(integers, first_group).coplanarity();
  std::array<Value, 4> b = {Value(f[0] + f[0] + f[0]), Value(f[1]), Value(f[2]),
                            Value(f[3] + f[3] + f[3])};
  // Coefficient i ends with a factor 2^(62 i). Only signs are read.
  cut(b, [&](const Value& x, const Value& y) { return weights.mean(x, y); });
  const int sign = b[0].sign();
  if (sign == 0 || b[3].sign() != sign) return false;
  return b[1].sign() != -sign && b[2].sign() != -sign;
}

// The parts of a query that doubles have left open.
struct Open {
  std::array<int, 3> order = {0, 0, 0};  // by axis; 0: not open
  bool off_plane = false;
  bool any() const { return order[0] != 0 || order[1] != 0 || order[2] != 0 || off_plane; }
};

template <std::size_t W>
bool stay_apart(const QueryIntegers& integers, int first_group, const Open& open,
                const Weights& weights) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (open.order[axis] != 0 &&
        stays_ordered<W>(integers, first_group, axis, open.order[axis], weights)) {
      return true;
    }
  }
  return open.off_plane && stays_off_plane<W>(integers, first_group, weights);
}

}  // namespace

Later surely_later(const FourPoints& query, double until) {
  Open open;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int order = order_at_start(query, axis);
    if (order == 0) continue;
    const Decision decision = stays_ordered(query, axis, order, until);
    if (decision == Decision::yes) return Later::by_doubles;
    if (decision == Decision::open) open.order[axis] = order;
  }
  std::array<MovingVector, 3> u;
  Vector magnitude = {0, 0, 0};
  for (std::size_t j = 0; j < 3; ++j) {
    u[j] = difference(query.points[j + 1], query.points[0]);
    grow(magnitude, u[j]);
  }
  if (!in_range(magnitude)) return Later::no;
  Cubic f = triple_product(u[0], cross(u[1], u[2]));
  cut(f, [until](double x, double y) { return x + until * (y - x); });
  constexpr double error = cubic_error(0) + 90 * unit_roundoff;
  const double bound = error * magnitude[0] * magnitude[1] * magnitude[2];
  if (sure_sign(f, bound) != 0) return Later::by_doubles;
  // Integers tell only if all coefficients may have the sign of the first one.
  const int sign = sign_beyond(f[0], bound);
  open.off_plane = sign != 0 && std::none_of(f.begin(), f.end(), [&](double coefficient) {
                     return sign_beyond(coefficient, bound) == -sign;
                   });
  if (!open.any()) return Later::no;
  const QueryIntegers integers(query);
  const Weights weights(until);
  const bool is_later =
      integers.bits() <= most_bits<1>   ? stay_apart<1>(integers, query.first_group, open, weights)
      : integers.bits() <= most_bits<2> ? stay_apart<2>(integers, query.first_group, open, weights)
                                        : false;
  return is_later ? Later::by_integers : Later::no;
}

ContactResult test_contact_past_axis(const FourPoints& query, Want want) {
  const FilterResult filtered = filter_contact(query, want);
  if (filtered.decision == Decision::no) return {false, {}, ContactRung::filter};
  if (filtered.decision == Decision::yes) {
    if (want == Want::yes_no) return {true, {}, ContactRung::filter};
    if (filtered.time_bracketed) {
      return {true, exact_bracketed_time(query, filtered.lo, filtered.hi, filtered.time_guess),
              ContactRung::filter};
    }
  }
  ContactResult result = exact_contact(query, want);
  // The filter knew that there is a contact, and only its time was left to the integers.
  if (filtered.decision != Decision::open) result.rung = ContactRung::filter;
  return result;
}

bool ElementaryTest::is_apart_along_an_axis(const FourPoints& query) const {
  return separated_along_an_axis(query);
}

ContactResult ElementaryTest::test_until(const FourPoints& query, Want want, double until) const {
  if (separation() > 0) return test(query, want);
  switch (surely_later(query, until)) {
    case Later::by_doubles:
      return {false, {}, ContactRung::filter};
    case Later::by_integers:
      return {false, {}, ContactRung::fixed};
    case Later::no:
      break;
  }
  return test(query, want);
}

namespace {

class ExactTest : public ElementaryTest {
 public:
  const QueryKernels* first_rungs() const override { return &query_kernels(); }
};

class BoundedTest : public ElementaryTest {
 public:
  ContactResult test(const FourPoints& query, Want want) const override {
    return bounded_contact(query, want);
  }
  bool pierces(const Point& e0, const Point& e1, const std::array<Point, 3>& face) const override {
    return bounded_piercing(e0, e1, face) != Decision::no;
  }
  TimeEnclosure piercing_time(const Point& e0, const Point& e1,
                              const std::array<Point, 3>& face) const override {
    return {0, bounded_piercing(e0, e1, face) == Decision::yes ? 0.0 : 1.0};
  }
};

template <class Number>
class PlainTest : public ElementaryTest {
 public:
  ContactResult test(const FourPoints& query, Want want) const override {
    return plain_contact<Number>(query, want);
  }
  bool pierces(const Point& e0, const Point& e1, const std::array<Point, 3>& face) const override {
    return plain_piercing<Number>(e0, e1, face);
  }
};

}  // namespace

std::shared_ptr<const ElementaryTest> make_elementary_test(Arithmetic arithmetic) {
  switch (arithmetic) {
    case Arithmetic::bounded:
      return std::make_shared<BoundedTest>();
    case Arithmetic::double_precision:
      return std::make_shared<PlainTest<double>>();
    case Arithmetic::single_precision:
      return std::make_shared<PlainTest<float>>();
    case Arithmetic::exact:
      break;
  }
  return std::make_shared<ExactTest>();
}

ContactResult test_contact(const FourPoints& query, Want want, Arithmetic arithmetic) {
  if (separated_along_an_axis(query)) return {false, {}, ContactRung::axis};
  switch (arithmetic) {
    case Arithmetic::bounded:
      return bounded_contact(query, want);
    case Arithmetic::double_precision:
      return plain_contact<double>(query, want);
    case Arithmetic::single_precision:
      return plain_contact<float>(query, want);
    case Arithmetic::exact:
      break;
  }
  return test_contact_past_axis(query, want);
}

}  // namespace assay::detector
