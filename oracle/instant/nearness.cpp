#include "oracle/instant/nearness.h"

#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/instant/instant.h"
#include "oracle/instant/static_contact.h"
#include "oracle/mesh/feature_contacts.h"

namespace assay::oracle {

namespace {

using Kernel = CGAL::Simple_cartesian<CGAL::Gmpq>;
using Number = Kernel::FT;
using Point = Kernel::Point_3;
using Segment = Kernel::Segment_3;

// From here on features that have shrunk to less are taken for what they have become, for CGAL
// asks for whole ones.

Number squared_distance_to(const Point& p, const Point& a, const Point& b) {
  return a == b ? CGAL::squared_distance(p, a) : CGAL::squared_distance(p, Segment(a, b));
}

Number squared_distance_of_edges(const Point& a, const Point& b, const Point& c, const Point& d) {
  if (a == b) return squared_distance_to(a, c, d);
  if (c == d) return squared_distance_to(c, a, b);
  return CGAL::squared_distance(Segment(a, b), Segment(c, d));
}

Number squared_distance_to_face(const Point& p, const Point& a, const Point& b, const Point& c) {
  if (CGAL::collinear(a, b, c))
    return std::min(
        {squared_distance_to(p, a, b), squared_distance_to(p, b, c), squared_distance_to(p, c, a)});
  return CGAL::squared_distance(p, Kernel::Triangle_3(a, b, c));
}

// The box, wider by the distance: the boxes of two features that are nearer meet.
Box widened(Box box, double distance) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    box.min[k] = std::nextafter(box.min[k] - distance, -infinity);
    box.max[k] = std::nextafter(box.max[k] + distance, infinity);
  }
  return box;
}

}  // namespace

bool any_nearer_than(const detector::PositionsView& x, const detector::TrianglesView& triangles,
                     double distance, const WantedPair& counts) {
  const Instant instant(x);
  const StaticPoints points = instant.points();
  const Number limit = Number(distance) * Number(distance);
  const auto at = [&](std::int32_t v) { return Point(x(v, 0), x(v, 1), x(v, 2)); };
  const FeatureTests tests = {
      [&](std::int32_t v, const Face& f) {
        return vertex_meets_face(points, v, f) ||
               (distance > 0 &&
                squared_distance_to_face(at(v), at(f[0]), at(f[1]), at(f[2])) < limit);
      },
      [&](const Edge& a, const Edge& b) {
        return edges_meet(points, a, b) ||
               (distance > 0 &&
                squared_distance_of_edges(at(a[0]), at(a[1]), at(b[0]), at(b[1])) < limit);
      },
      [&](const Edge& e, const Face& f) { return edge_pierces_face(points, e, f); }};
  const MeshFeatures features = mesh_features(triangles);
  const FeatureIndex mesh(features, [&](std::span<const std::int32_t> vertices) {
    const Box box = instant.box_of(vertices);
    return distance > 0 ? widened(box, distance) : box;
  });
  bool found = false;
  StopGate gate([&] { return found; });
  for_each_contact(mesh, mesh, tests, {1, &gate},
                   {[&](std::int32_t s, std::int32_t t) {
                      return !found && s != t && counts(std::min(s, t), std::max(s, t));
                    },
                    [&](std::int32_t, std::int32_t, int) { found = true; }});
  return found;
}

}  // namespace assay::oracle
