#include "oracle/mesh/contact_shape.h"

#include <array>

#include "oracle/query/contact.h"
#include "oracle/query/contact_events.h"

namespace assay::oracle {

namespace {

using detector::MovingPoint;
using detector::TimeEnclosure;

// Zero exactly when the polynomial, of degree at most 3, has a root of multiplicity 2 or more.
Integer discriminant(const IntegerPolynomial& f) {
  if (f.degree() < 2) return 1;
  const Integer &d = f.c[0], &c = f.c[1], &b = f.c[2];
  if (f.degree() == 2) return c * c - 4 * b * d;
  const Integer& a = f.c[3];
  return b * b * c * c - 4 * a * c * c * c - 4 * b * b * b * d - 27 * a * a * d * d +
         18 * a * b * c * d;
}

// True when F has a root of multiplicity 2 or more and its derivative a zero in the enclosure.
// Such a root is a rational number, because F is a cubic with rational coefficients.
bool has_double_root_at(const IntegerPolynomial& f, const TimeEnclosure& first) {
  if (discriminant(f) != 0) return false;
  const IntegerPolynomial slope = derivative(f);
  return sign_at(slope, first.lo) * sign_at(slope, first.hi) <= 0;
}

bool meets_edge_at(const MovingPoint& p, const MovingPoint& a, const MovingPoint& b,
                   const TimeEnclosure& first) {
  const auto answer = vertex_face_contact({p, {a, b, b}}, detector::Want::first_time);
  return answer.contact && answer.first == first;
}

// The shape of a contact whose edges are not parallel. at_end() says whether the contact is at the
// end of a feature.
template <class AtEnd>
ContactShape shape_by(const FourPoints& points, const TimeEnclosure& first, const AtEnd& at_end) {
  ContactPolynomials polynomials(points);
  const IntegerPolynomial& f = polynomials.coplanarity();
  if (f.is_zero()) return ContactShape::coplanar_throughout;
  if (has_double_root_at(f, first)) return ContactShape::double_root;
  return at_end() ? ContactShape::at_end_of_feature : ContactShape::generic;
}

bool are_parallel(const detector::EdgeEdge& q) {
  const std::array<MovingPoint, 4> points = {q.a[0], q.a[1], q.b[0], q.b[1]};
  const IntegerScale scale(points);
  const auto normal =
      cross(moving_difference(scale, q.a[0], q.a[1]), moving_difference(scale, q.b[0], q.b[1]));
  return normal[0].is_zero() && normal[1].is_zero() && normal[2].is_zero();
}

}  // namespace

ContactShape shape_of(const detector::VertexFace& q, const TimeEnclosure& first) {
  return shape_by(four_points(q), first, [&] {
    return meets_edge_at(q.vertex, q.face[0], q.face[1], first) ||
           meets_edge_at(q.vertex, q.face[1], q.face[2], first) ||
           meets_edge_at(q.vertex, q.face[2], q.face[0], first);
  });
}

ContactShape shape_of(const detector::EdgeEdge& q, const TimeEnclosure& first) {
  if (are_parallel(q)) return ContactShape::parallel_edges;
  return shape_by(four_points(q), first, [&] {
    return meets_edge_at(q.a[0], q.b[0], q.b[1], first) ||
           meets_edge_at(q.a[1], q.b[0], q.b[1], first) ||
           meets_edge_at(q.b[0], q.a[0], q.a[1], first) ||
           meets_edge_at(q.b[1], q.a[0], q.a[1], first);
  });
}

}  // namespace assay::oracle
