#include "oracle/query/contact.h"

#include <CGAL/Interval_nt.h>

#include <algorithm>

#include "oracle/processor_state.h"
#include "oracle/query/contact_events.h"
#include "oracle/query/interval_sign.h"
#include "oracle/query/rungs.h"

namespace assay::oracle {

ContactAnswer contact_of(const FourPoints& q, detector::Want want) {
  require_exact_processor_state();
  if (separated_by_axis(q)) return {false, {}, Rung::axis};

  const IntervalAnswer quick = interval_answer(q, want);
  if (quick.decision == detector::Decision::no) return {false, {}, Rung::interval};
  if (quick.decision == detector::Decision::yes && want == detector::Want::yes_no) {
    return {true, {}, Rung::interval};
  }

  ContactPolynomials polynomials(q);
  if (quick.decision == detector::Decision::yes) {
    return {true, simple_zero_time(polynomials.coplanarity(), quick.s, quick.e), Rung::interval};
  }
  const ExactAnswer full = quadratic_answer(polynomials, want);
  return {full.contact, full.first, Rung::quadratic};
}

std::optional<detector::TimeEnclosure> first_time_by_kernel(const FourPoints& q) {
  require_exact_processor_state();
  ContactPolynomials polynomials(q);
  const ExactAnswer full = algebraic_answer(polynomials, detector::Want::first_time);
  if (!full.contact) return {};
  return full.first;
}

void RungCounts::add(Rung rung) {
  ++(rung == Rung::axis ? axis : rung == Rung::interval ? interval : quadratic);
}

RungCounts& RungCounts::operator+=(const RungCounts& other) {
  axis += other.axis;
  interval += other.interval;
  quadratic += other.quadratic;
  return *this;
}

ContactAnswer vertex_face_contact(const detector::VertexFace& query, detector::Want want) {
  return contact_of(four_points(query), want);
}

ContactAnswer edge_edge_contact(const detector::EdgeEdge& query, detector::Want want) {
  return contact_of(four_points(query), want);
}

// segment_pierces_triangle: signs of 3x3 determinants, by intervals and then by integers.
namespace {

using detector::MovingPoint;
using detector::Point;
using Interval = CGAL::Interval_nt<false>;

// The five points of the question, all at rest: e0, e1, f0, f1, f2.
using Configuration = std::array<MovingPoint, 5>;

// Calls sign(a, b, c, d), the orientation of four of the points, until the answer is known: 1 yes,
// 0 no, -1 when an orientation of the given precision is not certain. A sign is 2 when uncertain.
template <class Orientation>
int pierces(const Orientation& sign) {
  constexpr int uncertain = 2;
  constexpr int e0 = 0, e1 = 1, f0 = 2, f1 = 3, f2 = 4;
  const int side_0 = sign(f0, f1, f2, e0), side_1 = sign(f0, f1, f2, e1);
  if (side_0 == uncertain || side_1 == uncertain) return -1;
  if (side_0 * side_1 >= 0) return 0;
  const int s01 = sign(e0, e1, f0, f1), s12 = sign(e0, e1, f1, f2);
  if (s01 == uncertain || s12 == uncertain) return -1;
  if (s01 == 0 || s01 != s12) return 0;
  const int s20 = sign(e0, e1, f2, f0);
  if (s20 == uncertain) return -1;
  return s20 == s01 ? 1 : 0;
}

// Not inlined, because it rounds upward while it runs.
[[gnu::noinline]] int pierces_by_intervals(const Configuration& c) {
  const Interval::Protector round_upward;
  return pierces([&](int o, int a, int b, int d) {
    auto edge = [&](int i) {
      Vector3<Interval> v;
      for (int k = 0; k < 3; ++k) v[k] = Interval(c[i].t0[k]) - Interval(c[o].t0[k]);
      return v;
    };
    const Interval value = dot(edge(a), cross(edge(b), edge(d)));
    const int s = sure_sign(value);
    if (s != 0) return s;
    return value.inf() == 0 && value.sup() == 0 ? 0 : 2;
  });
}

int pierces_by_integers(const Configuration& c) {
  const IntegerScale scale(c);
  return pierces([&](int o, int a, int b, int d) {
    auto edge = [&](int i) {
      Vector3<Integer> v;
      for (int k = 0; k < 3; ++k) v[k] = scale(c[i].t0[k]) - scale(c[o].t0[k]);
      return v;
    };
    return sgn(dot(edge(a), cross(edge(b), edge(d))));
  });
}

}  // namespace

bool segment_pierces_triangle(const Point& e0, const Point& e1, const std::array<Point, 3>& face) {
  require_exact_processor_state();
  const Configuration c = {
      {{e0, e0}, {e1, e1}, {face[0], face[0]}, {face[1], face[1]}, {face[2], face[2]}}};
  constexpr double safe_from_overflow = 0x1p300;  // products of three differences stay below 2^910
  const int quick = all_coordinates_below(c, safe_from_overflow) ? pierces_by_intervals(c) : -1;
  return (quick >= 0 ? quick : pierces_by_integers(c)) == 1;
}

namespace {

using detector::TimeEnclosure;

// Returns true when F has a root of multiplicity 2 or more and its derivative a zero in the
// enclosure. Such a root is a rational number, because F is a cubic with rational coefficients.
bool has_double_root_at(const IntegerPolynomial& f, const TimeEnclosure& first) {
  if (discriminant(f) != 0) return false;
  const IntegerPolynomial slope = derivative(f);
  return sign_at(slope, first.lo) * sign_at(slope, first.hi) <= 0;
}

bool are_parallel(const std::array<MovingPoint, 4>& x) {
  const IntegerScale scale(x);
  const auto normal =
      cross(moving_difference(scale, x[0], x[1]), moving_difference(scale, x[2], x[3]));
  return normal[0].is_zero() && normal[1].is_zero() && normal[2].is_zero();
}

bool is_at_end_of_feature(const FourPoints& q, const TimeEnclosure& first) {
  struct PointAndEdge {
    int p, a, b;
  };
  constexpr PointAndEdge of_face[] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}},
                         of_edges[] = {{0, 2, 3}, {1, 2, 3}, {2, 0, 1}, {3, 0, 1}};
  const auto meets = [&](const PointAndEdge& of) {
    const auto& x = q.points;
    const auto answer =
        contact_of({{x[of.p], x[of.a], x[of.b], x[of.b]}, 1}, detector::Want::first_time);
    return answer.contact && answer.first == first;
  };
  return q.first_group == 1 ? std::ranges::any_of(of_face, meets)
                            : std::ranges::any_of(of_edges, meets);
}

}  // namespace

ContactShape shape_of(const FourPoints& q, const TimeEnclosure& first) {
  if (q.first_group == 2 && are_parallel(q.points)) return ContactShape::parallel_edges;
  ContactPolynomials polynomials(q);
  const IntegerPolynomial& f = polynomials.coplanarity();
  if (f.is_zero()) return ContactShape::coplanar_throughout;
  if (has_double_root_at(f, first)) return ContactShape::double_root;
  return is_at_end_of_feature(q, first) ? ContactShape::at_end_of_feature : ContactShape::generic;
}

}  // namespace assay::oracle
