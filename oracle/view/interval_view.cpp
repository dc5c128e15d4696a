#include <CGAL/Interval_nt.h>

#include "oracle/query/interval_sign.h"
#include "oracle/view/view_sign.h"

namespace assay::oracle {

namespace {

using detector::MovingPoint;
using detector::ViewSign;
using Interval = CGAL::Interval_nt<false>;
using Linear = LinearVector<Interval>;

// hm is of fifth degree in differences below 2^151, with fewer than 2^10 terms: no overflow.
constexpr double largest_coordinate = 0x1p150;
constexpr double split_at = 15.0 / 32.0;  // as in the interval rung of contacts
constexpr int most_depth = 8;
constexpr int most_pieces = 48;

struct Piece {
  double s, e;
  int depth;
};

// A difference of two moving points, kept at both ends of the step.
class Difference {
 public:
  Difference(const MovingPoint& from, const MovingPoint& to) {
    for (int k = 0; k < 3; ++k) {
      t0_[k] = Interval(to.t0[k]) - Interval(from.t0[k]);
      t1_[k] = Interval(to.t1[k]) - Interval(from.t1[k]);
    }
  }
  Linear on(const Piece& piece) const { return {at(piece.s), at(piece.e)}; }

 private:
  Vector3<Interval> at(double t) const {
    if (t == 0) return t0_;
    if (t == 1) return t1_;
    Vector3<Interval> u;
    for (int k = 0; k < 3; ++k) u[k] = Interval(1 - t) * t0_[k] + Interval(t) * t1_[k];
    return u;
  }
  Vector3<Interval> t0_, t1_;
};

bool surely_zero(const Interval& x) { return x.inf() == 0 && x.sup() == 0; }

// The polynomials of one vertex: as functions of the piece, or their values at its start.
struct SignsOnRange {
  int h0, h1, g0, g1, hm;

  // 1 or -1 when the view function surely has that sign throughout.
  int view() const {
    for (const int wanted : {1, -1}) {
      const bool before = h0 == wanted || g0 > 0;
      const bool after = h1 == wanted || g1 < 0;
      const bool between = hm == wanted || g0 < 0 || g1 > 0 || (h0 == wanted && h1 == wanted);
      if (before && after && between) return wanted;
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

  PieceSigns on(const Piece& piece) const {
    const QuadraticVector<Interval> normal = cross(u1_.on(piece), u2_.on(piece));
    const Bernstein<Interval, 3> h0 = dot(from_q0_[0].on(piece), normal);
    const int sign_h0 = sure_sign(h0);
    PieceSigns signs{true, true};
    if (is_point_) {
      signs.add(sign_h0, sure_sign(h0[0]), surely_zero(h0[0]));
      return signs;
    }
    const Bernstein<Interval, 3> h1 = dot(from_q1_[0].on(piece), normal);
    const int sign_h1 = sure_sign(h1);
    if (sign_h0 != 0 && sign_h0 == sign_h1) {
      signs.add(sign_h0, 0, false);
      return signs;
    }
    const Linear d = d_.on(piece);
    for (int i = 0; i < 3; ++i) add_vertex(i, piece, d, h0, h1, signs);
    return signs;
  }

 private:
  void add_vertex(int i, const Piece& piece, const Linear& d, const Bernstein<Interval, 3>& h0,
                  const Bernstein<Interval, 3>& h1, PieceSigns& signs) const {
    const Bernstein<Interval, 2> g0 = dot(from_q0_[i].on(piece), d);
    const Bernstein<Interval, 2> g1 = dot(from_q1_[i].on(piece), d);
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
  std::array<Piece, most_depth + 2> stack;
  int size = 0, judged = 0;
  stack[size++] = {0, 1, 0};
  bool positive = false, negative = false, settled = true;
  while (size > 0) {
    const Piece piece = stack[--size];
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
    const double middle = piece.s + (piece.e - piece.s) * split_at;
    stack[size++] = {middle, piece.e, piece.depth + 1};
    stack[size++] = {piece.s, middle, piece.depth + 1};
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

}  // namespace assay::oracle
