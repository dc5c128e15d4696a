// The fast rungs find times at which two features are surely farther apart than d, and times at
// which they surely are within d. Integers decide the rest.
#include "oracle/distance/feature_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/processor_state.h"
#include "oracle/query/interval_sign.h"
#include "oracle/query/rungs.h"
#include "oracle/query/times/times.h"

namespace assay::oracle {

namespace {

using detector::Decision;
using detector::FourPoints;
using detector::Point;
using detector::TimeEnclosure;
using detector::Want;

// Returns a sum that is at least the exact one.
double rounded_up(const Separation& d) {
  const double sum = d.first + d.second;
  if (d.first == 0 || d.second == 0) return sum;
  return std::nextafter(sum, std::numeric_limits<double>::infinity());
}

// The question, enclosed: the points seen from the first one, and d.
class Enclosed {
 public:
  Enclosed(const FourPoints& q, const Separation& d) : first_group_(q.first_group) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) {
        u0_[j][k] = Enclosure(q.points[j + 1].t0[k]) - Enclosure(q.points[0].t0[k]);
        u1_[j][k] = Enclosure(q.points[j + 1].t1[k]) - Enclosure(q.points[0].t1[k]);
      }
    }
    squared_ = square(Enclosure(d.first) + Enclosure(d.second));
  }

  // Returns the greatest time e found such that the features are surely apart on [t,e] in this
  // direction, from S' to S; -1 if they are not surely apart at t. REQUIRES t = grid(t).
  double apart_until(double t, const Point& n) const {
    std::array<Enclosure, 4> at_0, at_1;  // the points along n
    for (int j = 0; j < 3; ++j) {
      at_0[j + 1] = n[0] * u0_[j][0] + n[1] * u0_[j][1] + n[2] * u0_[j][2];
      at_1[j + 1] = n[0] * u1_[j][0] + n[1] * u1_[j][1] + n[2] * u1_[j][2];
    }
    const Enclosure length =
        square(Enclosure(n[0])) + square(Enclosure(n[1])) + square(Enclosure(n[2]));
    const double wanted_squared = (length.hi * squared_).hi;
    const double target = std::sqrt(wanted_squared);  // a goal, no bound
    const auto surely_apart = [&](int i, int j, double at) {
      const Enclosure gap = (1 - at) * (at_0[i] - at_0[j]) + at * (at_1[i] - at_1[j]);
      return gap.lo > 0 && square(gap).lo > wanted_squared;
    };
    double e = 1;
    for (int i = 0; i < first_group_; ++i) {
      for (int j = first_group_; j < 4; ++j) {
        if (!surely_apart(i, j, t)) return -1;
        if (surely_apart(i, j, 1)) continue;
        const double from = (at_0[i] - at_0[j]).lo, to = (at_1[i] - at_1[j]).lo;
        constexpr double safe = 1 - 0x1p-48;
        e = std::min(e, std::max(t, (from - target) / (from - to) * safe));
      }
    }
    e = grid(e);
    for (int i = 0; i < first_group_; ++i) {
      for (int j = first_group_; j < 4; ++j) {
        if (!(e > t) || !surely_apart(i, j, e)) return t;
      }
    }
    return e;
  }

  // Returns whether these places are surely within d at t. REQUIRES t = grid(t).
  bool surely_near(double t, const ClosestPlaces& places) const {
    const auto at = [&](int j, int k) { return (1 - t) * u0_[j - 1][k] + t * u1_[j - 1][k]; };
    const double first = places.first, second = places.second;
    if (first_group_ == 1 && (Enclosure(first) + Enclosure(second)).hi > 1 && second > 0) {
      // Rounding alone may put the place outside. A place a little farther inside will do then.
      const double inside = std::max(0.0, second - 0x1p-50);
      if ((Enclosure(first) + Enclosure(inside)).hi > 1) return false;
      return surely_near(t, {first, inside, places.apart, places.squared});
    }
    Enclosure squared;
    for (int k = 0; k < 3; ++k) {
      const Enclosure u1 = at(1, k), u2 = at(2, k), u3 = at(3, k);
      const Enclosure apart = first_group_ == 1 ? u1 + first * (u2 - u1) + second * (u3 - u1)
                                                : first * u1 - u2 - second * (u3 - u2);
      squared = squared + square(apart);
    }
    return squared.hi <= squared_.lo;
  }

  // Returns a multiple of 2^-52 not above t: 1 minus it is exact.
  static double grid(double t) {
    constexpr double per_unit = 0x1p52;
    return std::floor(t * per_unit) / per_unit;
  }

 private:
  int first_group_;
  std::array<Vector3<Enclosure>, 3> u0_, u1_;  // u_1..u_3 at both ends
  Enclosure squared_;                          // d^2
};

// Returns the same direction with a greatest coordinate of 1, so that no product of it overflows.
Point scaled(const Point& n) {
  const double greatest = std::max({std::fabs(n[0]), std::fabs(n[1]), std::fabs(n[2])});
  return {n[0] / greatest, n[1] / greatest, n[2] / greatest};
}

// Most pairs need one or two stops of the walk.
constexpr int most_stops = 24;

// The findings of the rung "interval".
struct Approach {
  // no: the features are farther apart than d at all times. yes: they are within d at `near`. open:
  // neither is known.
  Decision decision = Decision::open;
  // The features are farther apart than d on [0,apart]. Negative if nothing is known.
  double apart = -1;
  double near = 1;
};

// Walks along the step from time 0. At each time it takes the direction in which the features are
// apart, as found in plain doubles, and asks for how long they stay apart in that direction. Their
// gap in it is linear in time, so two values decide, in interval arithmetic; the walk goes on from
// there. Near the first time it converges as Newton's method does. Two places of the features that
// are surely within d of each other prove a yes.
Approach walk(const FourPoints& q, const Separation& d) {
  const Enclosed question(q, d);
  const double distance = d.first + d.second, squared = distance * distance;
  Approach found;
  double t = 0;
  for (int stop = 0; stop < most_stops; ++stop) {
    const ClosestPlaces places = closest_places(q, t);
    if (!(places.squared > squared)) {
      if (!question.surely_near(t, places)) return found;
      found.decision = Decision::yes;
      found.near = t;
      return found;
    }
    const double e = question.apart_until(t, scaled(places.apart));
    if (e < t) return found;
    found.apart = e;
    if (e == 1) {
      found.decision = Decision::no;
      return found;
    }
    // Shrinking steps say that the first time is near, so look a little beyond it.
    constexpr double small = 0x1p-7, least = 0x1p-44;
    const double step = e - t;
    if (step < small) {
      const double beyond = Enclosed::grid(std::min(1.0, e + std::max(step, least)));
      const ClosestPlaces there = closest_places(q, beyond);
      if (there.squared <= squared && question.surely_near(beyond, there)) {
        found.decision = Decision::yes;
        found.near = beyond;
        return found;
      }
      if (step < least) return found;
    }
    t = e;
  }
  return found;
}

// Coordinates or distances of 2^250 or more are left to the next rung. 0.3 to 0.6 us for most
// pairs.
Approach approach(const FourPoints& q, const Separation& d) {
  // Differences stay below 2^251, and all that is computed from them below 2^1010: no overflow.
  constexpr double largest = 0x1p250;
  if (!all_coordinates_below(q.points, largest)) return {};
  if (!(d.first < largest) || !(d.second < largest)) return {};
  return walk(q, d);
}

// Returns the least distance over the step in plain doubles: a guess.
double guess_least_distance(const FourPoints& q) {
  const auto squared = [&](double t) { return closest_places(q, t).squared; };
  constexpr int samples = 32;
  int best = 0;
  double least = squared(0);
  for (int i = 1; i <= samples; ++i) {
    const double here = squared(static_cast<double>(i) / samples);
    if (here < least) {
      least = here;
      best = i;
    }
  }
  // A ternary search on the two pieces about the best sample.
  double lo = std::max(0, best - 1) / static_cast<double>(samples);
  double hi = std::min(samples, best + 1) / static_cast<double>(samples);
  constexpr int rounds = 60;
  for (int round = 0; round < rounds; ++round) {
    const double a = lo + (hi - lo) / 3, b = hi - (hi - lo) / 3;
    const double at_a = squared(a), at_b = squared(b);
    least = std::min({least, at_a, at_b});
    (at_a < at_b ? hi : lo) = at_a < at_b ? b : a;
  }
  return std::sqrt(least);
}

// Returns the least time over the regions, given that the features are apart on [0,apart], and that
// no time after `last` is asked for. The lesser of two times has the lesser enclosure, so the times
// themselves need not be compared.
std::optional<TimeEnclosure> first_time_of_regions(const Regions& regions, double apart,
                                                   double last, Want want) {
  std::optional<TimeEnclosure> first;
  for (int i = 0; i < regions.size(); ++i) {
    const Region region = regions[i];
    if (apart < 0 && near_at_start(region)) return TimeEnclosure{0, 0};
    const double end = first ? first->hi : last;
    const double begin = apart < 0 ? 0 : apart;
    if (!(begin < end)) continue;
    const auto zero = first_zero(region, begin, end);
    if (zero && (!first || *zero < *first)) first = zero;
    // If no time is wanted, any region will do; otherwise another region may be near at 0.
    if (first && want == Want::yes_no) return first;
  }
  return first;
}

}  // namespace

ContactAnswer first_time_within(const FourPoints& q, const Separation& d, Want want) {
  require_exact_processor_state();
  if (separated_by_axis(q, rounded_up(d))) return {false, {}, Rung::axis};
  const Approach quick = approach(q, d);
  if (quick.decision == Decision::no) return {false, {}, Rung::interval};
  if (quick.decision == Decision::yes && (want == Want::yes_no || quick.near == 0)) {
    return {true, {0, 0}, Rung::interval};
  }
  const auto first = first_time_of_regions(Regions(q, d), quick.apart, quick.near, want);
  const Rung rung = quick.decision == Decision::yes ? Rung::interval : Rung::quadratic;
  if (!first) return {false, {}, rung};
  return {true, want == Want::first_time ? *first : TimeEnclosure{0, 0}, rung};
}

double least_distance(const FourPoints& q) {
  const auto is_within = [&](double d) {
    return first_time_within(q, {d, 0}, Want::yes_no).contact;
  };
  constexpr double most = std::numeric_limits<double>::max();
  if (is_within(0)) return 0;
  if (!is_within(most)) return std::numeric_limits<double>::infinity();
  return enclose_time(guess_least_distance(q), 0, most,
                      [&](double d) { return is_within(d) ? -1 : 1; })
      .hi;
}

namespace {

using detector::Point;

Point operator*(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }

// Returns a share. The share of 0 in 0 is not defined; any value will do.
double share(double part, double whole) {
  return whole > 0 ? std::clamp(part / whole, 0.0, 1.0) : 0;
}

// Finds the place of the face that is nearest to the point. The signs of products tell whether it
// is at a vertex, on an edge or inside (Ericson, Real-Time Collision Detection, 5.1.5).
void nearest_on_face(const Point& p, const Point& a, const Point& b, const Point& c,
                     ClosestPlaces& places) {
  const Point ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  const double d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp), d6 = dot(ac, cp);
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  double &v = places.first, &w = places.second;
  if (d1 <= 0 && d2 <= 0) return;
  if (d3 >= 0 && d4 <= d3) {
    v = 1;
  } else if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    v = share(d1, d1 - d3);
  } else if (d6 >= 0 && d5 <= d6) {
    w = 1;
  } else if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    w = share(d2, d2 - d6);
  } else if (va <= 0 && d4 >= d3 && d5 >= d6) {
    w = share(d4 - d3, (d4 - d3) + (d5 - d6));
    v = 1 - w;
  } else {
    v = share(vb, va + vb + vc);
    w = std::min(share(vc, va + vb + vc), 1 - v);
  }
}

// Finds the nearest places of two edges, which begin at a and c and have the directions u and v.
void nearest_on_edges(const Point& a, const Point& u, const Point& c, const Point& v,
                      ClosestPlaces& places) {
  const Point r = a - c;
  const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), ur = dot(u, r), vr = dot(v, r);
  double &s = places.first, &t = places.second;
  s = share(uv * vr - ur * vv, uu * vv - uv * uv);
  t = share(uv * s + vr, vv);
  s = share(uv * t - ur, uu);
}

}  // namespace

ClosestPlaces closest_places(const detector::FourPoints& q, double t) {
  std::array<Point, 4> x{};  // seen from the first point
  for (int j = 1; j < 4; ++j) {
    for (int k = 0; k < 3; ++k) {
      x[j][k] = (1 - t) * (q.points[j].t0[k] - q.points[0].t0[k]) +
                t * (q.points[j].t1[k] - q.points[0].t1[k]);
    }
  }
  ClosestPlaces places;
  if (q.first_group == 1) {
    nearest_on_face(x[0], x[1], x[2], x[3], places);
    const Point to_b = places.first * (x[2] - x[1]), to_c = places.second * (x[3] - x[1]);
    places.apart = ((Point{} - x[1]) - to_b) - to_c;
  } else {
    const Point v = x[3] - x[2];
    nearest_on_edges(x[0], x[1], x[2], v, places);
    places.apart = (places.first * x[1] - x[2]) - places.second * v;
  }
  places.squared = dot(places.apart, places.apart);
  return places;
}

}  // namespace assay::oracle
