#include "oracle/view/view_sign.h"

#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <cassert>

#include "oracle/processor_state.h"
#include "oracle/query/integer_polynomial.h"
#include "oracle/query/interval_sign.h"
#include "oracle/query/times/times.h"

namespace assay::oracle {

using detector::MovingPoint;
using detector::PairContact;
using detector::ViewSign;

ViewSign view_sign(const MovingTriangle& triangle, const detector::ViewPrimitive& primitive) {
  require_exact_processor_state();
  if (const auto quick = interval_view_sign(triangle, primitive)) return *quick;
  return exact_view_sign(triangle, primitive);
}

std::vector<ViewSign> view_signs(const detector::SteppedMesh& motion,
                                 const detector::TrianglesView& triangles,
                                 std::span<const detector::ViewPrimitive> primitives) {
  const auto count = static_cast<std::size_t>(triangles.rows());
  assert(motion.vertices_t0.rows() == motion.vertices_t1.rows());
  assert(primitives.size() == 1 || primitives.size() == count);
  std::vector<ViewSign> signs;
  for (std::size_t t = 0; t < count; ++t) {
    const auto corner = [&](int i) {
      return motion.path(triangles(static_cast<Eigen::Index>(t), i));
    };
    signs.push_back(
        view_sign({corner(0), corner(1), corner(2)}, primitives[primitives.size() == 1 ? 0 : t]));
  }
  return signs;
}

namespace {

struct ViewPolynomials {
  IntegerPolynomial h0, h1;
  std::array<IntegerPolynomial, 3> g0, g1;  // by vertex of the triangle

  ViewPolynomials(const MovingTriangle& p, const detector::ViewPrimitive& q) {
    const std::array<MovingPoint, 5> points = {p[0], p[1], p[2], q.q0, q.q1};
    const IntegerScale scale(points);
    const PolynomialVector normal =
        cross(moving_difference(scale, p[0], p[1]), moving_difference(scale, p[0], p[2]));
    const PolynomialVector d = moving_difference(scale, q.q0, q.q1);
    h0 = dot(moving_difference(scale, q.q0, p[0]), normal);
    h1 = dot(moving_difference(scale, q.q1, p[0]), normal);
    for (int i = 0; i < 3; ++i) {
      g0[i] = dot(moving_difference(scale, q.q0, p[i]), d);
      g1[i] = dot(moving_difference(scale, q.q1, p[i]), d);
    }
  }
  IntegerPolynomial between(int vertex) const { return h1 * g0[vertex] - h0 * g1[vertex]; }
};

int sign_at_start(const ViewPolynomials& v, int vertex) {
  if (sign_at(v.g0[vertex], 0) <= 0) return sign_at(v.h0, 0);
  if (sign_at(v.g1[vertex], 0) >= 0) return sign_at(v.h1, 0);
  return sign_at(v.between(vertex), 0);
}

bool not_positive_somewhere(const IntegerPolynomial& g) {
  return sign_at(g, 0) <= 0 || sign_at(g, 1) <= 0 || AlgebraicTimes({&g, 1}).size() > 0;
}

// Returns whether h is zero at a time when some g is <= 0.
bool zero_of_end_piece(const IntegerPolynomial& h, std::span<const IntegerPolynomial> gs) {
  if (h.is_zero()) return std::any_of(gs.begin(), gs.end(), not_positive_somewhere);
  const AlgebraicTimes zeros({&h, 1});
  for (int i = 0; i < zeros.size(); ++i) {
    for (const IntegerPolynomial& g : gs) {
      if (zeros.sign(g, i) <= 0) return true;
    }
  }
  return false;
}

// Returns whether the middle piece is zero at a time when it is active. If hm is identically zero,
// the piece is not active at t=0, because the sign there is known not to be zero. So a time at
// which it becomes active is a boundary of the piece, where the view function is zero by
// continuity. There h0 or h1 is zero too, and the end pieces find that.
bool zero_of_middle_piece(const ViewPolynomials& v, int vertex) {
  const IntegerPolynomial hm = v.between(vertex);
  if (hm.is_zero()) return false;
  const AlgebraicTimes zeros({&hm, 1});
  for (int i = 0; i < zeros.size(); ++i) {
    if (zeros.sign(v.g0[vertex], i) > 0 && zeros.sign(v.g1[vertex], i) < 0) return true;
  }
  return false;
}

}  // namespace

ViewSign exact_view_sign(const MovingTriangle& triangle, const detector::ViewPrimitive& primitive) {
  const ViewPolynomials v(triangle, primitive);
  const int sign = sign_at_start(v, 0);
  if (sign == 0) return ViewSign::zero;
  for (int i = 1; i < 3; ++i) {
    if (sign_at_start(v, i) != sign) return ViewSign::zero;
  }
  const std::array<IntegerPolynomial, 3> minus_g1 = {-v.g1[0], -v.g1[1], -v.g1[2]};
  if (zero_of_end_piece(v.h0, v.g0) || zero_of_end_piece(v.h1, minus_g1)) return ViewSign::zero;
  for (int i = 0; i < 3; ++i) {
    if (zero_of_middle_piece(v, i)) return ViewSign::zero;
  }
  return sign > 0 ? ViewSign::positive : ViewSign::negative;
}

namespace {

using Interval = CGAL::Interval_nt<false>;
using Linear = LinearVector<Interval>;
using Difference = MovingDifference<Interval>;

// hm is of fifth degree in differences below 2^151, with fewer than 2^10 terms: no overflow.
constexpr double largest_coordinate = 0x1p150;
constexpr int most_depth = 8;
constexpr int most_pieces = 48;

bool surely_zero(const Interval& x) { return x.inf() == 0 && x.sup() == 0; }

// The polynomials of one vertex: as functions of the piece, or their values at its start.
struct SignsOnRange {
  int h0, h1, g0, g1, hm;

  // Returns 1 or -1 when the view function surely has that sign throughout, else 0.
  int view() const {
    for (const int sign : {1, -1}) {
      const bool before = h0 == sign || g0 > 0;
      const bool after = h1 == sign || g1 < 0;
      const bool between = hm == sign || g0 < 0 || g1 > 0 || (h0 == sign && h1 == sign);
      if (before && after && between) return sign;
    }
    return 0;
  }
};

struct PieceSigns {
  bool all_positive = false, all_negative = false;
  bool some_positive = false, some_negative = false, some_zero = false;

  void add(int whole, int start, bool start_zero) {
    all_positive = all_positive && whole > 0;
    all_negative = all_negative && whole < 0;
    some_positive = some_positive || whole > 0 || start > 0;
    some_negative = some_negative || whole < 0 || start < 0;
    some_zero = some_zero || start_zero;
  }
};

class ViewFunctions {
 public:
  ViewFunctions(const MovingTriangle& p, const detector::ViewPrimitive& q)
      : is_point_(q.is_point()),
        u1_(p[0], p[1]),
        u2_(p[0], p[2]),
        d_(q.q0, q.q1),
        from_q0_{Difference{q.q0, p[0]}, {q.q0, p[1]}, {q.q0, p[2]}},
        from_q1_{Difference{q.q1, p[0]}, {q.q1, p[1]}, {q.q1, p[2]}} {}

  PieceSigns on(const StepPiece& piece) const {
    const QuadraticVector<Interval> normal =
        cross(u1_.on(piece.s, piece.e), u2_.on(piece.s, piece.e));
    const Bernstein<Interval, 3> h0 = dot(from_q0_[0].on(piece.s, piece.e), normal);
    const int sign_h0 = sure_sign(h0);
    PieceSigns signs{true, true};
    if (is_point_) {
      signs.add(sign_h0, sure_sign(h0[0]), surely_zero(h0[0]));
      return signs;
    }
    const Bernstein<Interval, 3> h1 = dot(from_q1_[0].on(piece.s, piece.e), normal);
    const int sign_h1 = sure_sign(h1);
    if (sign_h0 != 0 && sign_h0 == sign_h1) {
      signs.add(sign_h0, 0, false);
      return signs;
    }
    const Linear d = d_.on(piece.s, piece.e);
    for (int i = 0; i < 3; ++i) add_vertex(i, piece, d, h0, h1, signs);
    return signs;
  }

 private:
  void add_vertex(int i, const StepPiece& piece, const Linear& d, const Bernstein<Interval, 3>& h0,
                  const Bernstein<Interval, 3>& h1, PieceSigns& signs) const {
    const Bernstein<Interval, 2> g0 = dot(from_q0_[i].on(piece.s, piece.e), d);
    const Bernstein<Interval, 2> g1 = dot(from_q1_[i].on(piece.s, piece.e), d);
    const Bernstein<Interval, 5> hm = difference(product(h1, g0), product(h0, g1));
    const SignsOnRange whole{sure_sign(h0), sure_sign(h1), sure_sign(g0), sure_sign(g1),
                             sure_sign(hm)};
    const SignsOnRange start{sure_sign(h0[0]), sure_sign(h1[0]), sure_sign(g0[0]), sure_sign(g1[0]),
                             sure_sign(hm[0])};
    const bool start_zero = (surely_zero(h0[0]) && g0[0].sup() <= 0) ||
                            (surely_zero(h1[0]) && g1[0].inf() >= 0) ||
                            (surely_zero(hm[0]) && start.g0 > 0 && start.g1 < 0);
    signs.add(whole.view(), start.view(), start_zero);
  }

  bool is_point_;
  Difference u1_, u2_, d_;
  std::array<Difference, 3> from_q0_, from_q1_;
};

// Not inlined, because nothing of it may move out of the region that rounds upward.
[[gnu::noinline]] std::optional<ViewSign> judge_pieces(const MovingTriangle& triangle,
                                                       const detector::ViewPrimitive& primitive) {
  const ViewFunctions functions(triangle, primitive);
  StepPieces<most_depth> pieces;
  int judged = 0;
  bool positive = false, negative = false, settled = true;
  while (!pieces.empty()) {
    const StepPiece piece = pieces.take();
    if (++judged > most_pieces) return {};
    const PieceSigns signs = functions.on(piece);
    positive = positive || signs.some_positive;
    negative = negative || signs.some_negative;
    // There are two signs: either two vertices differ at one time, or the view function of a
    // vertex, which is continuous, passes zero.
    if (signs.some_zero || (positive && negative)) return ViewSign::zero;
    if (signs.all_positive || signs.all_negative) continue;
    if (piece.depth == most_depth) {
      settled = false;
      continue;
    }
    pieces.cut(piece);
  }
  if (!settled) return {};
  return positive ? ViewSign::positive : ViewSign::negative;
}

}  // namespace

std::optional<ViewSign> interval_view_sign(const MovingTriangle& triangle,
                                           const detector::ViewPrimitive& primitive) {
  const std::array<MovingPoint, 2> ends = {primitive.q0, primitive.q1};
  if (!all_coordinates_below(triangle, largest_coordinate) ||
      !all_coordinates_below(ends, largest_coordinate)) {
    return {};
  }
  const Interval::Protector round_upward;
  return judge_pieces(triangle, primitive);
}

Candidates::Candidates(std::vector<ViewSign> signs, std::vector<std::uint8_t> violated,
                       std::vector<std::int32_t> groups)
    : signs_(std::move(signs)), violated_(std::move(violated)), groups_(std::move(groups)) {
  assert(violated_.empty() || violated_.size() == signs_.size());
  assert(groups_.empty() || groups_.size() == signs_.size());
}

bool Candidates::holds(const detector::TrianglePair& pair) const {
  const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
  if (signs_[a] == ViewSign::zero || signs_[b] == ViewSign::zero) return true;
  if (signs_[a] != signs_[b]) return true;
  if (!violated_.empty() && (violated_[a] || violated_[b])) return true;
  return !groups_.empty() && groups_[a] != groups_[b];
}

bool holds_a_first_contact(const std::vector<PairContact>& pairs, const Candidates& candidates) {
  const auto first = std::min_element(pairs.begin(), pairs.end(),
                                      [](const auto& x, const auto& y) { return x.time < y.time; });
  return first == pairs.end() ||
         std::any_of(pairs.begin(), pairs.end(), [&](const PairContact& contact) {
           return contact.time == first->time && candidates.holds(contact.pair);
         });
}

}  // namespace assay::oracle
