#include <algorithm>
#include <cmath>

#include "oracle/distance/feature_distance.h"
#include "oracle/query/contact_events.h"
#include "properties/search/degeneracy.h"

namespace assay::properties {
namespace {
using oracle::Integer;
using oracle::IntegerPolynomial;

constexpr double most_bits = 64;

// A polynomial whose greatest coefficient is below 1 and at least 1/2: value = c(t) 2^exponent.
struct Scaled {
  std::array<double, 4> c{};
  long exponent = 0;
  double at(double t) const { return ((c[3] * t + c[2]) * t + c[1]) * t + c[0]; }
};

double mantissa_of(const Integer& x, long& exponent) {
  return mpz_get_d_2exp(&exponent, x.get_mpz_t());
}

Scaled scaled(const IntegerPolynomial& p) {
  Scaled out;
  std::array<long, 4> exponents{};
  bool any = false;
  for (std::size_t i = 0; i < p.c.size(); ++i) {
    out.c[i] = mantissa_of(p.c[i], exponents[i]);
    if (out.c[i] == 0) continue;
    out.exponent = any ? std::max(out.exponent, exponents[i]) : exponents[i];
    any = true;
  }
  for (std::size_t i = 0; i < p.c.size(); ++i)
    out.c[i] = std::ldexp(out.c[i], static_cast<int>(exponents[i] - out.exponent));
  return out;
}

// Returns |x| / 2^exponent, at most 1.
double share_of(const Integer& x, long exponent) {
  long own = 0;
  const double mantissa = std::abs(mantissa_of(x, own));
  const double share =
      std::ldexp(mantissa, static_cast<int>(std::clamp(own - exponent, -1000L, 1L)));
  return mantissa == 0 ? 0 : std::min(share, 1.0);
}

// How the projected point lies in the feature at a time: 0 at its end, positive inside, negative
// outside, as a share of the greatest L.
class Sides {
 public:
  Sides(oracle::ContactPolynomials& polynomials, int first_group)
      : first_group_(static_cast<std::size_t>(first_group)) {
    for (int axis = 0; axis < 3; ++axis) {
      long exponent = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        auto& side = sides_[static_cast<std::size_t>(axis)][i];
        side = scaled(polynomials.sides(axis)[i]);
        exponent = i == 0 ? side.exponent : std::max(exponent, side.exponent);
      }
      exponents_[static_cast<std::size_t>(axis)] = exponent;
    }
    greatest_ = *std::ranges::max_element(exponents_);
  }

  struct Place {
    double inside = 0;  // from -1 to 1
    double normal = 0;  // of the face or of the two edges, over the greatest L of the step
  };
  Place at(double t) const {
    Place place;
    double greatest_of_all = 0;
    for (const auto& sides : sides_) {
      double least = 0, greatest = 0, smallest = 1, normal = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        const int exponent = static_cast<int>(std::max(sides[i].exponent - greatest_, -2000L));
        const double value = std::ldexp(sides[i].at(t), exponent);
        least = std::min(least, value);
        greatest = std::max(greatest, value);
        smallest = std::min(smallest, std::abs(value));
        // The normal is the sum of the lam of the first group.
        if (i < first_group_) normal += value;
      }
      place.normal = std::max(place.normal, std::abs(normal));
      const double size = std::max(greatest, -least), other = std::min(greatest, -least);
      if (size <= greatest_of_all) continue;
      greatest_of_all = size;
      place.inside = other > 0 ? -other / size : smallest / size;
    }
    return place;
  }

 private:
  std::size_t first_group_;
  std::array<std::array<Scaled, 4>, 3> sides_;
  std::array<long, 3> exponents_{};
  long greatest_ = 0;
};

// Returns the unit of the error bounds of the filters: the product over the axes of the greatest
// |coordinate| of the u_j.
double log2_of_bound(const FourPoints& q) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    double greatest = 0;
    for (std::size_t j = 1; j < 4; ++j) {
      greatest = std::max({greatest, std::abs(q.points[j].t0[k] - q.points[0].t0[k]),
                           std::abs(q.points[j].t1[k] - q.points[0].t1[k])});
    }
    sum += std::log2(greatest);
  }
  return sum;
}

double log2_of(const Integer& x) {
  long exponent = 0;
  const double mantissa = std::abs(mantissa_of(x, exponent));
  return std::log2(mantissa) + static_cast<double>(exponent);
}

// Returns the times at which a cubic may have a double root.
std::array<double, 2> critical_times(const Scaled& f) {
  const double a = 3 * f.c[3], b = f.c[2], c = f.c[1];  // a t^2 + 2 b t + c
  if (a == 0) return {b == 0 ? -1 : -c / (2 * b), -1};
  const double root = std::sqrt(std::max(b * b - a * c, 0.0));
  return {(-b - root) / a, (-b + root) / a};
}

// Returns how far the distance at this time is from the asked one, divided by the greater of the
// two and, for a contact, the extent. 1 if a contact is asked for and there is one.
double share_of_distance(const FourPoints& query, double time, double separation) {
  const double distance = std::sqrt(oracle::closest_places(query, time).squared);
  if (!(distance < 1e300) || (separation == 0 && distance == 0)) return 1;
  if (separation > 0) return std::abs(distance - separation) / std::max(distance, separation);
  double extent = distance;
  for (std::size_t k = 0; k < 3; ++k) {
    for (const auto& p : query.points)
      extent = std::max(extent, std::abs(p.t0[k] - query.points[0].t0[k]));
  }
  return std::max(distance / extent, 0x1p-53);
}

double from_outside(double inside) { return std::max(-inside, 0.0); }

}  // namespace

Gap gap_of(const FourPoints& query, double time, double separation) {
  Gap gap;
  gap.share.fill(1);
  gap[Hardness::distance] = share_of_distance(query, time, separation);
  oracle::ContactPolynomials polynomials(query);
  const IntegerPolynomial& f = polynomials.coplanarity();
  const Sides sides(polynomials, query.first_group);
  const auto meeting = sides.at(time);
  gap[Hardness::no_area] = std::min(meeting.normal, 1.0);
  gap[Hardness::side] = std::min(std::abs(meeting.inside), 1.0);
  if (f.is_zero()) {
    gap[Hardness::flat] = 0;
    return gap;
  }
  const Scaled form = scaled(f);
  Integer at_1 = 0;
  for (const auto& c : f.c) at_1 += c;
  gap[Hardness::end_of_step] =
      std::min(std::max(share_of(f.c[0], form.exponent), from_outside(sides.at(0).inside)),
               std::max(share_of(at_1, form.exponent), from_outside(sides.at(1).inside)));
  const long discriminant_exponent = (f.degree() == 3 ? 4 : 2) * form.exponent;
  if (f.degree() >= 2) {
    const double near = share_of(discriminant(f), discriminant_exponent);
    for (const double t : critical_times(form)) {
      if (!(t >= 0 && t <= 1)) continue;
      gap[Hardness::double_root] =
          std::min(gap[Hardness::double_root], std::max(near, from_outside(sides.at(t).inside)));
    }
  }
  const auto bernstein = oracle::bernstein_over_unit(f);
  double least = 1e300, greatest = -1e300;
  for (const auto& b : bernstein) {
    const double size = b == 0 ? -1e300 : log2_of(b);
    least = std::min(least, size);
    greatest = std::max(greatest, size);
  }
  // The scaled coefficients are the coefficients times a small number, which is left out.
  const double unit = 3.0 * oracle::IntegerScale(query.points).exponent() - log2_of_bound(query);
  gap[Hardness::flat] = std::exp2(std::clamp(greatest + unit, -1000.0, 0.0));
  // Some 128 units of 2^-53. A value exactly at a bound is worth 40 bits, and each factor of two
  // away 4 bits less.
  constexpr double bits_of_bound = -46, bits_at_bound = 40, bits_less = 4;
  const double bits = bits_at_bound - bits_less * std::abs(least + unit - bits_of_bound);
  if (least > -1e300) gap[Hardness::bound] = std::exp2(-std::max(bits, 0.0));
  return gap;
}

double nearness(const Gap& gap) {
  double first = 0, second = 0;
  for (const double share : gap.share) {
    const double bits = share > 0 ? std::min(-std::log2(share), most_bits) : most_bits;
    second = std::max(second, std::min(first, bits));
    first = std::max(first, bits);
  }
  return first + second / 2;
}

}  // namespace assay::properties
