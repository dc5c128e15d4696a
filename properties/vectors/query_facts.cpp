#include "properties/vectors/query_facts.h"

#include <algorithm>
#include <cmath>

#include "oracle/distance/feature_distance.h"
#include "oracle/distance/region_times.h"
#include "oracle/query/contact.h"
#include "oracle/query/contact_events.h"
#include "oracle/query/times/algebraic_times.h"
#include "properties/search/gap.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {
namespace {

using detector::FourPoints;
using detector::MovingPoint;
using detector::TimeEnclosure;
using oracle::ContactPolynomials;
using oracle::Integer;
using oracle::IntegerPolynomial;

// The integers without their common divisor.
std::vector<std::string> decimals_of(const IntegerPolynomial& p) {
  Integer divisor = 0;
  for (const auto& c : p.c) divisor = gcd(divisor, c);
  std::vector<std::string> decimals;
  for (const auto& c : p.c) decimals.push_back(Integer(c / divisor).get_str());
  return decimals;
}

// t itself, which is 0 at the start.
const std::vector<std::string> start_of_step = {"0", "1"};

// Whether p has a zero at the time that is enclosed. REQUIRES that p is not identically zero, and
// that all zeros of p in the enclosure are that time or are not in question.
bool vanishes_at(const IntegerPolynomial& p, const TimeEnclosure& time) {
  if (time.lo == time.hi) return sign_at(p, time.lo) == 0;
  if (p.degree() < 1) return false;
  const oracle::AlgebraicTimes zeros({&p, 1});
  for (int i = 0; i < zeros.size(); ++i) {
    if (zeros.enclosure(i) == time) return true;
  }
  return false;
}

std::vector<std::string> polynomial_of(ContactPolynomials& polynomials,
                                       const TimeEnclosure& first) {
  if (first.hi == 0) return start_of_step;
  for (const auto& p : event_polynomials(polynomials)) {
    if (vanishes_at(p, first)) return decimals_of(p);
  }
  return {};
}

// Zeros of odd order are where the sign changes; the order is 3 at most.
bool changes_sign(const IntegerPolynomial& f, const oracle::ExactTimes& times, int i) {
  const auto slope = derivative(f);
  return times.sign(slope, i) != 0 || times.sign(derivative(slope), i) == 0;
}

bool passes(ContactPolynomials& polynomials) {
  const auto& f = polynomials.coplanarity();
  if (f.degree() < 1) return false;
  const oracle::AlgebraicTimes times({&f, 1});
  for (int i = 0; i < times.size(); ++i) {
    const auto at = times.enclosure(i);
    const bool is_inside = at.hi > 0 && at.lo < 1;
    if (is_inside && changes_sign(f, times, i) && contact_at(polynomials, times, i)) return true;
  }
  return false;
}

// Signs of the four sides along an axis at which they are not all 0, at the time of a zero of one
// of `events`; nothing if there is no such axis.
struct Meeting {
  bool has_normal = false;  // of the face, or of the two edges
  bool at_end = false;      // of a feature: a side is 0
};

Meeting meeting_at(ContactPolynomials& polynomials, int first_group, const TimeEnclosure& first) {
  Meeting meeting;
  const auto look = [&](const auto& sign) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto& sides = polynomials.sides(axis);
      IntegerPolynomial normal;
      for (int i = 0; i < first_group; ++i) normal = normal + sides[static_cast<std::size_t>(i)];
      meeting.has_normal = meeting.has_normal || sign(normal) != 0;
      int zeros = 0;
      for (const auto& side : sides) zeros += sign(side) == 0 ? 1 : 0;
      meeting.at_end = meeting.at_end || (zeros > 0 && zeros < 4);
    }
  };
  if (first.lo == first.hi) {
    look([&](const IntegerPolynomial& p) { return sign_at(p, first.lo); });
    return meeting;
  }
  const auto events = event_polynomials(polynomials);
  const oracle::AlgebraicTimes times(events);
  for (int i = 0; i < times.size(); ++i) {
    if (times.enclosure(i) != first) continue;
    look([&](const IntegerPolynomial& p) { return times.sign(p, i); });
    break;
  }
  return meeting;
}

bool has_double_root(const IntegerPolynomial& f) {
  if (f.degree() < 2) return false;
  const oracle::AlgebraicTimes times({&f, 1});
  const auto slope = derivative(f);
  for (int i = 0; i < times.size(); ++i) {
    if (times.sign(slope, i) == 0) return true;
  }
  return false;
}

template <class Use>
void for_each_coordinate(std::span<const MovingPoint> points, const Use& use) {
  for (const auto& p : points) {
    for (const auto* end : {&p.t0, &p.t1})
      for (const double x : *end) use(std::abs(x));
  }
}

// The longest side of the box around some points.
double extent_of(std::span<const MovingPoint> points, detector::Point MovingPoint::*end) {
  double extent = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    double lo = INFINITY, hi = -INFINITY;
    for (const auto& p : points) {
      lo = std::min(lo, (p.*end)[k]);
      hi = std::max(hi, (p.*end)[k]);
    }
    extent = std::max(extent, hi - lo);
  }
  return extent;
}

}  // namespace

VectorFacts contact_facts(const FourPoints& query) {
  VectorFacts facts;
  const auto answer = oracle::contact_of(query, detector::Want::first_time);
  if (!answer.contact) return facts;
  ContactPolynomials polynomials(query);
  facts.result = passes(polynomials) ? VectorResult::collision : VectorResult::acceptable;
  facts.first = answer.first;
  facts.polynomial = polynomial_of(polynomials, answer.first);
  return facts;
}

VectorFacts distance_facts(const FourPoints& query, double d) {
  VectorFacts facts;
  facts.least_distance = oracle::least_distance(query);
  const auto near = oracle::first_time_within(query, {d, 0});
  if (!near.near) return facts;
  const auto less = oracle::first_time_within(query, {d, -d * 0x1p-60}, detector::Want::yes_no);
  facts.result = less.near ? VectorResult::collision : VectorResult::acceptable;
  facts.first = near.first;
  if (near.first.hi == 0) {
    facts.polynomial = start_of_step;
    return facts;
  }
  const oracle::Regions regions(query, {d, 0});
  for (int i = 0; i < regions.size(); ++i) {
    const auto region = regions[i];
    const auto zero = first_zero(region, 0, 1);
    if (!zero || *zero != near.first) continue;
    facts.polynomial = decimals_of(region.f);
    break;
  }
  return facts;
}

std::set<VectorFlag> number_flags_of(std::span<const MovingPoint> points,
                                     VectorPrecision precision) {
  using enum VectorFlag;
  const bool is_float = precision == VectorPrecision::float32;
  const double least_normal = is_float ? 0x1p-126 : 0x1p-1022;
  double least = INFINITY, greatest = 0;
  for_each_coordinate(points, [&](double x) {
    if (x > 0) least = std::min(least, x);
    greatest = std::max(greatest, x);
  });
  std::set<VectorFlag> flags;
  const double extent = extent_of(points, &MovingPoint::t0);
  double longest = 0;
  for (const auto& p : points) {
    for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, std::abs(p.t1[k] - p.t0[k]));
  }
  if (greatest == 0) return {at_rest};
  const int bits = is_float ? 24 : 53, spread = std::ilogb(greatest) - std::ilogb(least);
  if (least < least_normal) flags.insert(denormal);
  if (greatest >= (is_float ? 0x1p40 : 0x1p340)) flags.insert(large_numbers);
  if (spread > bits) flags.insert(mixed_scales);
  if (extent > 0 && greatest >= std::ldexp(extent, bits / 2)) flags.insert(far_from_origin);
  if (longest == 0) flags.insert(at_rest);
  if (extent > 0 && longest >= 0x1p10 * extent) flags.insert(huge_step);
  return flags;
}

std::set<VectorFlag> flags_of(const FourPoints& query, const VectorFacts& facts, double distance,
                              VectorPrecision precision) {
  using enum VectorFlag;
  auto flags = number_flags_of(query.points, precision);
  if (facts.first && facts.first->hi == 0) flags.insert(at_start);
  if (facts.first && facts.first->lo == 1) flags.insert(at_end);
  ContactPolynomials polynomials(query);
  if (distance > 0) {
    if (facts.result == VectorResult::acceptable) flags.insert(at_distance);
    const int bits = precision == VectorPrecision::float32 ? 10 : 26;
    if (facts.result == VectorResult::free && std::isfinite(*facts.least_distance) &&
        *facts.least_distance - distance <= std::ldexp(distance, -bits))
      flags.insert(near_miss);
    if (facts.first && query.first_group == 2 &&
        !meeting_at(polynomials, 2, {facts.first->lo, facts.first->lo}).has_normal)
      flags.insert(parallel_edges);
    return flags;
  }
  const auto& f = polynomials.coplanarity();
  if (f.is_zero()) flags.insert(coplanar_throughout);
  if (has_double_root(f)) flags.insert(double_root);
  if (facts.first) {
    const auto meeting = meeting_at(polynomials, query.first_group, *facts.first);
    if (!meeting.has_normal) flags.insert(query.first_group == 1 ? no_area : parallel_edges);
    if (meeting.at_end) flags.insert(touch_at_end);
  }
  const Gap gap = gap_of(query, facts.first ? facts.first->lo : 0);
  const double near = precision == VectorPrecision::float32 ? 0x1p-10 : 0x1p-26;
  if (!flags.contains(double_root) && gap[Hardness::double_root] < near) flags.insert(tangential);
  const double extent = extent_of(query.points, &MovingPoint::t0);
  if (facts.result == VectorResult::free && oracle::least_distance(query) <= near * extent)
    flags.insert(near_miss);
  return flags;
}

VectorHardness hardness_of(const FourPoints& query, const VectorFacts& facts, double distance) {
  // What is a value at the time of the contact says nothing where there is none.
  constexpr Hardness of_all[] = {Hardness::flat, Hardness::double_root};
  constexpr Hardness of_contacts[] = {Hardness::flat, Hardness::double_root, Hardness::no_area,
                                      Hardness::side, Hardness::end_of_step};
  constexpr int most_bits = 64;
  VectorHardness hard;
  const auto take = [&](Hardness kind, double share) {
    const int bits = share > 0 ? std::min(-std::ilogb(std::min(share, 1.0)), most_bits) : most_bits;
    if (bits > hard.bits || hard.kind.empty()) hard = {name_of(kind), bits};
  };
  if (distance > 0) {
    const double least = *facts.least_distance;
    const bool is_told = facts.result != VectorResult::acceptable && std::isfinite(least);
    if (facts.result == VectorResult::acceptable) take(Hardness::distance, 0);
    if (is_told) take(Hardness::distance, std::abs(least - distance) / std::max(least, distance));
    return hard;
  }
  const Gap gap = gap_of(query, facts.first ? facts.first->lo : 0);
  if (facts.first) {
    for (const auto kind : of_contacts) take(kind, gap[kind]);
    return hard;
  }
  for (const auto kind : of_all) take(kind, gap[kind]);
  const double extent = extent_of(query.points, &MovingPoint::t0);
  const double least = oracle::least_distance(query);
  if (extent > 0 && std::isfinite(least)) take(Hardness::distance, std::min(least / extent, 1.0));
  return hard;
}

Vector query_vector(corpus::Case c, double distance, VectorPrecision precision) {
  const auto query = *query_of(c);
  Vector v;
  v.c = std::move(c);
  v.question = distance > 0 ? VectorQuestion::distance : VectorQuestion::contact;
  v.distance = distance;
  v.steps = {distance > 0 ? distance_facts(query, distance) : contact_facts(query)};
  const auto flags = flags_of(query, v.steps[0], distance, precision);
  v.flags.assign(flags.begin(), flags.end());
  v.hard = hardness_of(query, v.steps[0], distance);
  return v;
}

}  // namespace assay::properties
