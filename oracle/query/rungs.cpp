#include "oracle/query/rungs.h"

#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <vector>

#include "oracle/query/interval_sign.h"
#include "oracle/query/times/times.h"

namespace assay::oracle {

namespace {

// Returns -1 if all of S lies more than `distance` before all of S' along the axis, 1 if after,
// else 0. If a difference that is rounded to nearest is greater than a double, so is the exact one.
int order_beyond(const FourPoints& q, detector::Point detector::MovingPoint::*end, int axis,
                 double distance) {
  const auto at = [&](int i) { return (q.points[i].*end)[axis]; };
  double s_min = at(0), s_max = at(0), r_min = at(3), r_max = at(3);
  for (int i = 1; i < 3; ++i) {
    double& least = i < q.first_group ? s_min : r_min;
    double& greatest = i < q.first_group ? s_max : r_max;
    least = std::min(least, at(i));
    greatest = std::max(greatest, at(i));
  }
  if (r_min - s_max > distance) return -1;
  return s_min - r_max > distance ? 1 : 0;
}

}  // namespace

bool separated_by_axis(const FourPoints& q, double distance) {
  for (int axis = 0; axis < 3; ++axis) {
    const int at_t0 = order_beyond(q, &detector::MovingPoint::t0, axis, distance);
    if (at_t0 != 0 && at_t0 == order_beyond(q, &detector::MovingPoint::t1, axis, distance)) {
      return true;
    }
  }
  return false;
}

namespace {

using Interval = CGAL::Interval_nt<false>;
using Linear = LinearVector<Interval>;

// Differences stay below 2^301 and F, the largest expression, below 2^910: no overflow.
constexpr double largest_coordinate = 0x1p300;
constexpr int most_depth = 9;
// If a query needs more pieces, the rung "quadratic" is the cheaper one.
constexpr int most_pieces = 40;

// Makes the test of the rung "axis" on a piece. The four points are taken as 0, u_1, u_2, u_3.
bool separated_on_piece(const std::array<Linear, 3>& u, int first_group) {
  for (int k = 0; k < 3; ++k) {
    auto order = [&](const auto& end) {
      int sign = 0;
      for (int i = 0; i < first_group; ++i) {
        for (int j = first_group; j < 4; ++j) {
          const Interval gap =
              i == 0 ? (u[j - 1].*end)[k] : (u[j - 1].*end)[k] - (u[i - 1].*end)[k];
          const int s = sure_sign(gap);
          if (s == 0 || (sign != 0 && s != sign)) return 0;
          sign = s;
        }
      }
      return sign;
    };
    const int at_s = order(&Linear::s);
    if (at_s != 0 && at_s == order(&Linear::e)) return true;
  }
  return false;
}

struct PieceDecision {
  detector::Decision decision = detector::Decision::open;
  bool one_zero = false;  // F is strictly monotone on the piece
};

PieceDecision judge_piece(const std::array<Linear, 3>& u, int first_group) {
  if (separated_on_piece(u, first_group)) return {detector::Decision::no};

  const QuadraticVector<Interval> w1 = cross(u[1], u[2]);
  const Bernstein<Interval, 3> f = dot(u[0], w1);
  if (sure_sign(f) != 0) return {detector::Decision::no};

  const QuadraticVector<Interval> w2 = cross(u[2], u[0]);
  const QuadraticVector<Interval> w3 = cross(u[0], u[1]);
  const bool f_changes = sure_sign(f[0]) * sure_sign(f[3]) < 0;
  bool all_agree = false;
  for (int k = 0; k < 3; ++k) {
    const Bernstein<Interval, 2> lam_0 = sum(sum(w1[k], w2[k]), w3[k]);  // negated
    const int second = first_group == 2 ? 1 : -1;
    const std::array<int, 4> signs = {-sure_sign(lam_0), second * sure_sign(w1[k]),
                                      -sure_sign(w2[k]), -sure_sign(w3[k])};
    int positive = 0, negative = 0;
    for (int s : signs) {
      positive += s > 0;
      negative += s < 0;
    }
    if (positive > 0 && negative > 0) return {detector::Decision::no};
    all_agree = all_agree || positive == 4 || negative == 4;
  }
  if (!f_changes || !all_agree) return {};
  // F' has the scaled coefficients f1 - 3 f0, 2 (f2 - f1), 3 f3 - f2; the factor does not matter.
  const Interval three(3.0);
  const Bernstein<Interval, 2> slope = {f[1] - three * f[0], f[2] - f[1], three * f[3] - f[2]};
  return {detector::Decision::yes, sure_sign(slope) != 0};
}

// Not inlined, because nothing of it may move out of the region that rounds upward.
[[gnu::noinline]] IntervalAnswer judge_pieces(const FourPoints& q, detector::Want want) {
  using Difference = MovingDifference<Interval>;
  const std::array<Difference, 3> differences = {
      Difference{q.points[0], q.points[1]}, {q.points[0], q.points[2]}, {q.points[0], q.points[3]}};
  StepPieces<most_depth> pieces;
  int judged = 0;
  bool all_free = true;
  while (!pieces.empty()) {
    const StepPiece piece = pieces.take();
    if (++judged > most_pieces) return {};
    std::array<Linear, 3> u;
    for (int j = 0; j < 3; ++j) u[j] = differences[j].on(piece.s, piece.e);
    const PieceDecision inside = judge_piece(u, q.first_group);
    if (inside.decision == detector::Decision::no) continue;
    if (inside.decision == detector::Decision::yes) {
      if (want == detector::Want::yes_no) return {detector::Decision::yes};
      if (inside.one_zero) return {detector::Decision::yes, piece.s, piece.e};
    }
    if (piece.depth == most_depth) {
      if (want == detector::Want::first_time) return {};
      all_free = false;
      continue;
    }
    pieces.cut(piece);
  }
  return {all_free ? detector::Decision::no : detector::Decision::open};
}

}  // namespace

IntervalAnswer interval_answer(const FourPoints& q, detector::Want want) {
  if (!all_coordinates_below(q.points, largest_coordinate)) return {};
  const Interval::Protector round_upward;
  return judge_pieces(q, want);
}

ExactAnswer quadratic_answer(ContactPolynomials& polynomials, detector::Want want) {
  const std::vector<IntegerPolynomial> events = event_polynomials(polynomials);
  if (events.size() > 1) {  // coplanar throughout
    // Many such queries begin in contact, and then the other times are not needed.
    const QuadraticTimes start({events.data(), 1});
    const ExactAnswer at_start = first_contact(polynomials, start, want);
    if (at_start.contact) return at_start;
  }
  if (events[0].degree() < 3) return first_contact(polynomials, QuadraticTimes(events), want);
  if (surely_no_zero_in_unit(events[0])) return {};
  return first_contact(polynomials, CubicTimes(events[0]), want);
}

ExactAnswer algebraic_answer(ContactPolynomials& polynomials, detector::Want want) {
  return first_contact(polynomials, AlgebraicTimes(event_polynomials(polynomials)), want);
}

}  // namespace assay::oracle
