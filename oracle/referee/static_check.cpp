#include "oracle/referee/static_check.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Intersections_3/Point_3_Segment_3.h>
#include <CGAL/Intersections_3/Point_3_Triangle_3.h>
#include <CGAL/Intersections_3/Segment_3_Segment_3.h>
#include <CGAL/Intersections_3/Segment_3_Triangle_3.h>
#include <CGAL/Intersections_3/Triangle_3_Triangle_3.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "oracle/processor_state.h"

namespace assay::oracle {

namespace {

using Rational = CGAL::Gmpq;
using Kernel = CGAL::Simple_cartesian<Rational>;
using Point = Kernel::Point_3;
using Segment = Kernel::Segment_3;
using Triangle = Kernel::Triangle_3;
using Vertices = std::vector<std::int32_t>;  // distinct, ascending

// The shape that a face has become: never degenerate, as do_intersect requires.
using Shape = std::variant<Point, Segment, Triangle>;

Rational value_of(const StaticTime& time) {
  if (const auto* fraction = std::get_if<RationalTime>(&time)) {
    assert(fraction->denominator > 0);
    return Rational(static_cast<long>(fraction->numerator)) /
           Rational(static_cast<long>(fraction->denominator));
  }
  return Rational(std::get<double>(time));
}

bool meet(const Point& a, const Point& b) { return a == b; }
bool meet(const Point& a, const Segment& b) { return b.has_on(a); }
bool meet(const Segment& a, const Point& b) { return a.has_on(b); }
template <class A, class B>
bool meet(const A& a, const B& b) {
  return CGAL::do_intersect(a, b);
}

// Returns the hull of points on one line: from the least to the greatest.
Shape hull_on_a_line(const std::vector<Point>& points) {
  const auto [least, greatest] = std::minmax_element(points.begin(), points.end());
  if (*least == *greatest) return *least;
  return Segment(*least, *greatest);
}

Shape hull(const std::vector<Point>& points) {
  if (points.size() == 3 && !CGAL::collinear(points[0], points[1], points[2])) {
    return Triangle(points[0], points[1], points[2]);
  }
  return hull_on_a_line(points);
}

// Positions as intervals of doubles. They give a quick, certain "apart" for most pairs, and are
// used for nothing else.
//
// Bound, u = 2^-53: the time as a double is wrong by at most 3 u (numerator, denominator,
// quotient), 1 - t by one more rounding, so the weights by 4 u and 3 u; two products and a sum add
// 3 u more. In all that is below 11 u M, where M is the greater magnitude of the coordinate at the
// two ends. The code takes 16 u M, plus a bound of underflow.
class QuickPositions {
 public:
  QuickPositions(const detector::SteppedMesh& motion, const StaticTime& time) : motion_(motion) {
    if (const auto* fraction = std::get_if<RationalTime>(&time)) {
      t_ = static_cast<double>(fraction->numerator) / static_cast<double>(fraction->denominator);
    } else {
      t_ = std::get<double>(time);
    }
  }

  bool surely_apart(const Vertices& a, const Vertices& b) const {
    for (int k = 0; k < 3; ++k) {
      const auto [a_least, a_greatest] = range(a, k);
      const auto [b_least, b_greatest] = range(b, k);
      if (a_greatest < b_least || b_greatest < a_least) return true;
    }
    return false;
  }

 private:
  std::pair<double, double> range(const Vertices& vertices, int k) const {
    constexpr double too_large = 0x1p1000;  // sums might overflow
    double least = HUGE_VAL, greatest = -HUGE_VAL;
    for (const std::int32_t v : vertices) {
      const double begin = motion_.vertices_t0(v, k), end = motion_.vertices_t1(v, k);
      const double size = std::max(std::fabs(begin), std::fabs(end));
      if (size > too_large) return {-HUGE_VAL, HUGE_VAL};
      const double middle = begin * (1 - t_) + end * t_;
      const double error = 16 * 0x1p-53 * size + 0x1p-1060;
      least = std::min(least, middle - 2 * error);  // twice, for the rounding of the difference
      greatest = std::max(greatest, middle + 2 * error);
    }
    return {least, greatest};
  }

  const detector::SteppedMesh& motion_;
  double t_ = 0;
};

Vertices vertices_of(const detector::TrianglesView& triangles, std::int32_t t) {
  Vertices v = {triangles(t, 0), triangles(t, 1), triangles(t, 2)};
  std::sort(v.begin(), v.end());
  v.erase(std::unique(v.begin(), v.end()), v.end());
  return v;
}

bool same_corners(const detector::TrianglesView& triangles, detector::TrianglePair pair) {
  const std::array<std::int32_t, 3> b = {triangles(pair.b, 0), triangles(pair.b, 1),
                                         triangles(pair.b, 2)};
  const std::array<std::int32_t, 3> a = {triangles(pair.a, 0), triangles(pair.a, 1),
                                         triangles(pair.a, 2)};
  return std::is_permutation(a.begin(), a.end(), b.begin());
}

Vertices without(const Vertices& from, const Vertices& others) {
  Vertices rest;
  std::set_difference(from.begin(), from.end(), others.begin(), others.end(),
                      std::back_inserter(rest));
  return rest;
}

}  // namespace

int compare(const StaticTime& time, double t) {
  const Rational difference = value_of(time) - Rational(t);
  return static_cast<int>(CGAL::sign(difference));
}

bool triangles_meet(const detector::SteppedMesh& motion, const detector::TrianglesView& triangles,
                    detector::TrianglePair pair, const StaticTime& time) {
  require_exact_processor_state();
  const Rational t = value_of(time);
  auto position = [&](std::int32_t v) {
    auto coordinate = [&](int k) {
      const Rational begin(motion.vertices_t0(v, k)), end(motion.vertices_t1(v, k));
      return Rational(begin + t * (end - begin));
    };
    return Point(coordinate(0), coordinate(1), coordinate(2));
  };
  auto shape = [&](const Vertices& vertices) {
    std::vector<Point> points;
    for (const std::int32_t v : vertices) points.push_back(position(v));
    return hull(points);
  };
  const QuickPositions quick(motion, time);
  if (t == 0 && same_corners(triangles, pair)) return true;
  const Vertices a = vertices_of(triangles, pair.a), b = vertices_of(triangles, pair.b);
  Vertices common;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));

  // Two faces without a common vertex: each common vertex of the triangles is in one of them at
  // most. It is enough to test the largest such pairs, in which every common vertex is in one of
  // the two, because they hold all smaller pairs.
  for (unsigned choice = 0; choice < (1U << common.size()); ++choice) {
    Vertices to_a, to_b;
    for (unsigned i = 0; i < common.size(); ++i) {
      ((choice >> i & 1U) ? to_a : to_b).push_back(common[i]);
    }
    const Vertices face_a = without(a, to_b), face_b = without(b, to_a);
    if (face_a.empty() || face_b.empty()) continue;
    if (quick.surely_apart(face_a, face_b)) continue;
    const bool is_contact = std::visit([](const auto& f, const auto& g) { return meet(f, g); },
                                       shape(face_a), shape(face_b));
    if (is_contact) return true;
  }
  return false;
}

}  // namespace assay::oracle

extern "C" int assay_triangles_meet_now(const double* a, const double* b) {
  using Doubles = CGAL::Exact_predicates_inexact_constructions_kernel;
  const auto triangle_of = [](const double* p) {
    return Doubles::Triangle_3({p[0], p[1], p[2]}, {p[3], p[4], p[5]}, {p[6], p[7], p[8]});
  };
  const auto s = triangle_of(a), t = triangle_of(b);
  return !s.is_degenerate() && !t.is_degenerate() && CGAL::do_intersect(s, t) ? 1 : 0;
}
