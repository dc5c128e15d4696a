#include "oracle/referee/referee.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "oracle/processor_state.h"
#include "oracle/referee/existence.h"

namespace assay::oracle {

namespace {

class Referee {
 public:
  Referee(const detector::FourPoints& query, const RefereeOptions& options)
      : query_(query), options_(options), hull_(double_hull(query)) {}

  detector::Decision run() {
    const int deepest = std::clamp(options_.depth, 0, most_depth);
    std::vector<std::int64_t> pieces = {0};  // piece k of depth d is [k/2^d, (k+1)/2^d]
    std::uint64_t looked_at = 0;
    // Goes breadth first, so that a contact is found while few pieces are left, whatever its time.
    for (int depth = 0; depth <= deepest; ++depth) {
      std::vector<std::int64_t> left;
      for (const std::int64_t k : pieces) {
        if (++looked_at > options_.max_boxes) return detector::Decision::open;
        if (!separated(k, depth)) left.push_back(k);
      }
      if (left.empty()) return detector::Decision::no;
      if (contact_in_some(left, depth)) return detector::Decision::yes;
      pieces.clear();
      for (const std::int64_t k : left) {
        pieces.push_back(2 * k);
        if (begins_in_time(2 * k + 1, depth + 1)) pieces.push_back(2 * k + 1);
      }
    }
    return detector::Decision::open;
  }

 private:
  static constexpr int most_depth = 61;
  static constexpr int most_depth_of_doubles = 53;  // the ends, and 1 minus them, are doubles
  static constexpr std::size_t witnesses_a_level = 4;

  // Returns the hull in integers, which is made when doubles do not suffice.
  const IntegerHull& exact() {
    if (!exact_) exact_ = integer_hull(query_);
    return *exact_;
  }

  static double time(std::int64_t k, int depth) {
    return std::ldexp(static_cast<double>(k), -depth);
  }

  // Returns false if the piece surely begins at `until` or later, so that it is not asked about.
  bool begins_in_time(std::int64_t k, int depth) const {
    return depth > most_depth_of_doubles || time(k, depth) < options_.until;
  }

  bool separated(std::int64_t k, int depth) {
    if (depth <= most_depth_of_doubles) {
      const SeparationProof quick = separated_in_double(hull_, time(k, depth), time(k + 1, depth));
      if (quick != SeparationProof::near) return quick == SeparationProof::separated;
    }
    return separated_in_integers(exact(), k, depth);
  }

  bool contact_in_some(const std::vector<std::int64_t>& left, int depth) {
    if (depth == 0 && options_.until >= 1 && contact_at({1, 1})) return true;
    const std::size_t tries = std::min(left.size(), witnesses_a_level);
    for (std::size_t i = 0; i < tries; ++i) {
      const std::int64_t k = left[i * left.size() / tries];
      if (contact_at(simplest_fraction(k, depth))) return true;
      if (crossing(guess_crossing(hull_, time(k, depth), time(k + 1, depth)))) return true;
    }
    return false;
  }

  bool contact_at(const Fraction& time) {
    if (std::find(tried_.begin(), tried_.end(), time) != tried_.end()) return false;
    tried_.push_back(time);
    if (mpq_class(time.p, time.q) > mpq_class(options_.until)) return false;
    return contains_origin(exact().at(time.p, time.q));
  }

  bool crossing(const std::optional<Crossing>& guess) {
    if (!guess) return false;
    // Many pieces lead to the same place, which is to be tried once.
    constexpr double same_place = 0x1p-40;
    for (const Crossing& c : refused_) {
      if (c.base == guess->base && std::fabs(c.t - guess->t) < same_place &&
          std::fabs(c.u - guess->u) < same_place && std::fabs(c.v - guess->v) < same_place) {
        return false;
      }
    }
    refused_.push_back(*guess);
    return crossing_in_a_box(exact(), *guess, options_.until);
  }

  const detector::FourPoints& query_;
  const RefereeOptions options_;
  const DoubleHull hull_;
  std::optional<IntegerHull> exact_;
  std::vector<Fraction> tried_;
  std::vector<Crossing> refused_;
};

}  // namespace

detector::Decision referee(const detector::FourPoints& query, const RefereeOptions& options) {
  require_exact_processor_state();
  return Referee(query, options).run();
}

namespace {

using detector::FourPoints;

using Rational = mpq_class;
// Coefficients of powers of s in [0,1], which runs over the times from lo to hi.
using Linear = std::array<Rational, 2>;
using Quadratic = std::array<Rational, 3>;
using Cubic = std::array<Rational, 4>;
using LinearPoint = std::array<Linear, 3>;

// The most halvings of an interval of s. They leave 2^-300 of its length, which tells apart zeros
// of polynomials whose coordinates differ in their last bits alone.
constexpr int halvings = 300;

template <std::size_t A, std::size_t B>
std::array<Rational, A + B - 1> product(const std::array<Rational, A>& a,
                                        const std::array<Rational, B>& b) {
  std::array<Rational, A + B - 1> c;
  for (std::size_t i = 0; i < A; ++i) {
    for (std::size_t j = 0; j < B; ++j) c[i + j] += a[i] * b[j];
  }
  return c;
}

template <std::size_t N>
std::array<Rational, N> combined(const std::array<Rational, N>& a, int sign,
                                 const std::array<Rational, N>& b) {
  std::array<Rational, N> c;
  for (std::size_t i = 0; i < N; ++i) c[i] = a[i] + sign * b[i];
  return c;
}

template <std::size_t N>
Rational value(const std::array<Rational, N>& p, const Rational& s) {
  Rational sum = p[N - 1];
  for (std::size_t i = N - 1; i-- > 0;) sum = sum * s + p[i];
  return sum;
}

// Returns the least and the greatest sign that a quadratic is known to have on [x,y]: those of its
// Bernstein coefficients there.
std::array<int, 2> signs_on(const Quadratic& q, const Rational& x, const Rational& y) {
  const Rational middle = q[0] + q[1] * (x + y) / 2 + q[2] * x * y;
  const std::array<int, 3> signs = {sgn(value(q, x)), sgn(middle), sgn(value(q, y))};
  const auto [least, greatest] = std::minmax_element(signs.begin(), signs.end());
  return {*least, *greatest};
}

class Bracket {
 public:
  Bracket(const FourPoints& query, double lo, double hi) : first_group_(query.first_group) {
    const Rational from(lo), length = Rational(hi) - from;
    std::array<LinearPoint, 4> x;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Rational begin(query.points[i].t0[k]), way = Rational(query.points[i].t1[k]) - begin;
        x[i][k] = {begin + way * from, way * length};
      }
    }
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) u_[j][k] = combined(x[j + 1][k], -1, x[0][k]);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const Cubic part = product(u_[0][k], cross(1, 2, k));
      f_ = combined(f_, 1, part);
      lambda_[k] = {Quadratic{}, cross(1, 2, k), cross(2, 0, k), cross(0, 1, k)};
      for (std::size_t i = 1; i < 4; ++i)
        lambda_[k][0] = combined(lambda_[k][0], -1, lambda_[k][i]);
    }
  }

  bool holds_contact() const {
    if (contact_on(0, 1)) return true;
    const std::vector<Rational> ends = monotone_ends();
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      if (contact_on(ends[i], ends[i + 1])) return true;
    }
    return false;
  }

 private:
  Quadratic cross(std::size_t a, std::size_t b, std::size_t k) const {
    const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
    return combined(product(u_[a][l], u_[b][m]), -1, product(u_[a][m], u_[b][l]));
  }

  // Returns 0, places near the extremes of F, and 1. If F has several zeros, it changes its sign
  // between two of these.
  std::vector<Rational> monotone_ends() const {
    const Quadratic slope = {f_[1], 2 * f_[2], 3 * f_[3]};
    std::vector<Rational> ends = {0, 1};
    if (sgn(slope[2]) != 0) {
      const Rational turn = -slope[1] / (2 * slope[2]);
      if (turn > 0 && turn < 1) ends = {0, turn, 1};
    }
    std::vector<Rational> all = ends;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      Rational x = ends[i], y = ends[i + 1];
      const int before = sgn(value(slope, x));
      if (before * sgn(value(slope, y)) >= 0) continue;
      for (int n = 0; n < halvings; ++n) {
        const Rational middle = (x + y) / 2;
        (sgn(value(slope, middle)) == before ? x : y) = middle;
      }
      all.push_back(x);
    }
    std::sort(all.begin(), all.end());
    return all;
  }

  bool contact_on(Rational x, Rational y) const {
    const int before = sgn(value(f_, x));
    if (before == 0) return sgn(x) != 0 && meet_on(x, x) == detector::Decision::yes;
    if (before * sgn(value(f_, y)) >= 0) return false;
    for (int n = 0; n < halvings; ++n) {
      const auto decision = meet_on(x, y);
      if (decision != detector::Decision::open) return decision == detector::Decision::yes;
      const Rational middle = (x + y) / 2;
      const int there = sgn(value(f_, middle));
      if (there == 0) return meet_on(middle, middle) == detector::Decision::yes;
      (there == before ? x : y) = middle;
    }
    return false;
  }

  // Returns whether the features meet at every zero of F in [x,y]. Yes: the L of some axis are all
  // >= 0, or all <= 0, and one of them is never zero. No: the L of some axis take both signs
  // throughout.
  detector::Decision meet_on(const Rational& x, const Rational& y) const {
    for (const auto& of_axis : lambda_) {
      std::array<bool, 2> on_side = {true, true};   // all <= 0, all >= 0
      std::array<bool, 2> strict = {false, false};  // one is always < 0, one always > 0
      for (int i = 0; i < 4; ++i) {
        auto [least, greatest] = signs_on(of_axis[static_cast<std::size_t>(i)], x, y);
        if (i >= first_group_) std::swap(least = -least, greatest = -greatest);
        on_side[0] = on_side[0] && greatest <= 0;
        on_side[1] = on_side[1] && least >= 0;
        strict[0] = strict[0] || greatest < 0;
        strict[1] = strict[1] || least > 0;
      }
      if (strict[0] && strict[1]) return detector::Decision::no;
      if ((on_side[0] && strict[0]) || (on_side[1] && strict[1])) return detector::Decision::yes;
    }
    return detector::Decision::open;
  }

  int first_group_;
  std::array<LinearPoint, 3> u_;
  Cubic f_;
  std::array<std::array<Quadratic, 4>, 3> lambda_;  // by axis and point
};

}  // namespace

bool meet_between(const detector::FourPoints& query, double lo, double hi) {
  return Bracket(query, lo, hi).holds_contact();
}

}  // namespace assay::oracle
