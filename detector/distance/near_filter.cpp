#include <limits>

#include "detector/distance/nearness.h"

namespace assay::detector {
namespace {

// The case analysis of Ericson, Real-Time Collision Detection, 2005, 5.1.5 and 5.1.9. Every share
// along an edge is kept in [0,1], so that the place stays on the edge even if the feature is
// degenerate.

Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector operator+(const Vector& a, const Vector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Vector operator*(double s, const Vector& a) { return {s * a[0], s * a[1], s * a[2]}; }

double share(double part, double whole) {
  return whole > 0 && part > 0 ? std::min(part / whole, 1.0) : 0;
}

// Returns the place of the face that is nearest to the origin.
Vector of_face(const Vector& a, const Vector& b, const Vector& c) {
  const Vector ab = b - a, ac = c - a;
  const double d1 = -dot(ab, a), d2 = -dot(ac, a);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = -dot(ab, b), d4 = -dot(ac, b);
  if (d3 >= 0 && d4 <= d3) return b;
  const double of_c = d1 * d4 - d3 * d2;
  if (of_c <= 0 && d1 >= 0 && d3 <= 0) return a + share(d1, d1 - d3) * ab;
  const double d5 = -dot(ab, c), d6 = -dot(ac, c);
  if (d6 >= 0 && d5 <= d6) return c;
  const double of_b = d5 * d2 - d1 * d6;
  if (of_b <= 0 && d2 >= 0 && d6 <= 0) return a + share(d2, d2 - d6) * ac;
  const double of_a = d3 * d6 - d5 * d4;
  if (of_a <= 0 && d4 >= d3 && d5 >= d6) return b + share(d4 - d3, (d4 - d3) + (d5 - d6)) * (c - b);
  const double p = std::max(of_a, 0.0), q = std::max(of_b, 0.0), r = std::max(of_c, 0.0);
  return (a + share(q, p + q + r) * ab) + share(r, p + q + r) * ac;
}

// Returns the vector from the edge ce to the edge of the origin and b, between nearest places.
Vector between_edges(const Vector& b, const Vector& c, const Vector& e) {
  const Vector v = e - c;
  const double bb = dot(b, b), vv = dot(v, v), bv = dot(b, v), cb = dot(c, b), cv = dot(c, v);
  double s = share(cb * vv - bv * cv, bb * vv - bv * bv);
  double t = bv * s - cv;
  if (t <= 0) {
    t = 0;
    s = share(cb, bb);
  } else if (t >= vv) {
    t = vv > 0 ? 1 : 0;
    s = share(cb + t * bv, bb);
  } else {
    t = share(t, vv);
  }
  return s * b - (c + t * v);
}

double length(const Vector& v) { return std::sqrt(dot(v, v)); }

// The heights of the corners along one vector n at an instant: n.x for each point; that of the
// first is 0.
using Heights = std::array<double, 4>;

// The filter of one query; FirstGroup is its first_group.
template <int FirstGroup>
class NearFilter {
 public:
  NearFilter(const FourPoints& query, double d) : d_(d) {
    Vector magnitude = {0, 0, 0};
    for (std::size_t j = 0; j < 3; ++j) {
      const auto x = difference<double>(query.points[j + 1], query.points[0]);
      grow(magnitude, x);
      at_start_[j] = x.t0;
      at_end_[j] = x.t1;
    }
    const double m = std::max({magnitude[0], magnitude[1], magnitude[2]});
    is_in_range_ = m > least_magnitude && m < greatest_magnitude;
    gap_bound_ = gap_error * m;
    place_bound_ = place_error * m;
  }

  NearResult run() {
    if (!is_in_range_) return {};
    Instant now = instant(0, at_start_);
    if (is_surely_near(now.size)) return {Decision::yes, 0, 0, 0};
    double fall = 0;  // of the distance in unit time, since the instant before
    for (int i = 0; i < max_advances; ++i) {
      const Heights from = heights(now.n, now.x), to = heights(now.n, at_end_);
      const double gap = least_gap(from);
      if (!(gap > now.level)) return {};
      if (least_gap(to) > now.level) return {Decision::no};
      const Descent descent = first_descent(from, to, now.level + gap_bound_);
      // Nearly there: both gap and place are known up to their bounds only.
      constexpr double nearly = 16;
      if (gap - now.level <= nearly * (gap_bound_ + place_bound_))
        return near_after(now, fall > 0 ? fall : descent.rate / (1 - now.time));
      const double safe = now.time + descent.share * (1 - now.time);
      Instant next = instant(i > 0 ? foreseen(now, fall) : safe);
      if (!keeps_apart(now, next)) {
        next = instant(safe);
        if (!(safe > now.time) || !(least_gap(heights(now.n, next.x)) > now.level)) return {};
      } else if (next.time == 1) {
        return {Decision::no};
      }
      fall = (now.size - next.size) / (next.time - now.time);
      now = next;
    }
    return {};
  }

 private:
  // The points at a time, the vector n of that time with length 1, and the distance there. If a gap
  // along n is above the level, the features are farther apart than d.
  struct Instant {
    double time;
    SeenPoints x;
    Vector n;
    double size, level;
  };
  // The pair of corners whose gap is the first to reach a level: the share of the piece until then,
  // and the fall of the gap over the piece.
  struct Descent {
    double share = 1, rate = 0;
  };

  Instant instant(double time, const SeenPoints& x) const {
    const Vector n = between_nearest(x, FirstGroup);
    const double size = length(n);
    const Vector unit = {n[0] / size, n[1] / size, n[2] / size};
    return {time, x, unit, size, length(unit) * (length_slack * d_ + gap_bound_)};
  }
  Instant instant(double time) const { return instant(time, time == 1 ? at_end_ : at(time)); }

  bool is_surely_near(double size) const { return length_slack * size + place_bound_ <= d_; }

  // Returns the time at which the distance reaches d, less the bounds, if it goes on falling at
  // this rate; the end of the step if it does not fall that far.
  double foreseen(const Instant& now, double fall) const {
    constexpr double bounds = 8;
    const double left = now.size - d_ - bounds * (gap_bound_ + place_bound_);
    return left < fall * (1 - now.time) ? now.time + left / fall : 1;
  }

  // Returns whether a vector that goes linearly from the n of one instant to the n of another
  // proves the features farther apart than d in between. REQUIRES that n proves it at the first
  // instant.
  bool keeps_apart(const Instant& from, const Instant& to) const {
    if (!(to.time > from.time) || !(least_gap(heights(to.n, to.x)) > to.level)) return false;
    const Heights a = heights(from.n, to.x), b = heights(to.n, from.x);
    const Heights middle = {0, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2, (a[3] + b[3]) / 2};
    return least_gap(middle) > (from.level + to.level) / 2;
  }

  SeenPoints at(double time) const {
    const double before = 1 - time;
    SeenPoints x;
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) x[j][k] = before * at_start_[j][k] + time * at_end_[j][k];
    }
    return x;
  }

  static Heights heights(const Vector& n, const SeenPoints& x) {
    return {0, dot(n, x[0]), dot(n, x[1]), dot(n, x[2])};
  }

  static double least_gap(const Heights& h) {
    if constexpr (FirstGroup == 1) return h[0] - std::max({h[1], h[2], h[3]});
    return std::min(h[0], h[1]) - std::max(h[2], h[3]);
  }

  static Descent first_descent(const Heights& from, const Heights& to, double level) {
    Descent first;
    for (std::size_t i = 0; i < FirstGroup; ++i) {
      for (std::size_t j = FirstGroup; j < 4; ++j) {
        const double above = (from[i] - from[j]) - level,
                     rate = (from[i] - from[j]) - (to[i] - to[j]);
        if (above >= first.share * rate) continue;
        first = {above / rate, rate};
      }
    }
    return first;
  }

  // Looks for a time soon after `now` at which the features are within d. REQUIRES that they are
  // farther apart than d up to `now`, and by little more there. `fall` is about the rate at which
  // their distance falls.
  NearResult near_after(const Instant& now, double fall) const {
    if (!(fall > 0)) return {};
    const double above = now.size - d_;
    double reach = (std::abs(above) + 4 * place_bound_) / fall + 0x1p-52;
    constexpr int attempts = 3;
    for (int i = 0; i < attempts; ++i, reach *= 8) {
      const double later = std::min(now.time + reach, 1.0);
      if (!(later > now.time)) return {};
      if (is_surely_near(instant(later).size))
        return {Decision::yes, now.time, later, now.time + above / fall};
    }
    return {};
  }

  double d_;
  SeenPoints at_start_, at_end_;
  bool is_in_range_;
  double gap_bound_, place_bound_;
};

}  // namespace

Vector between_nearest(const SeenPoints& x, int first_group) {
  if (first_group == 2) return between_edges(x[0], x[1], x[2]);
  return -1.0 * of_face(x[0], x[1], x[2]);
}

NearResult filter_near(const FourPoints& query, double d) {
  return query.first_group == 1 ? NearFilter<1>(query, d).run() : NearFilter<2>(query, d).run();
}

}  // namespace assay::detector
