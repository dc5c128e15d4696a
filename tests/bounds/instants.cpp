// Claims about the signs at one instant: orientation, projections, and the way in which a ray
// crosses a triangle.
#include "detector/geometry/orientation.cpp"
#include "detector/geometry/winding.cpp"
#include "tests/bounds/claims.h"
#include "tests/bounds/moving_points.h"

namespace assay::bounds {
namespace {

using namespace detector;

Point point(const std::string& name, int number) { return moving_point(name, number).t0; }

Point point_at(int number, double x, double y, double z) {
  return {coordinate("x", number, 0, x), coordinate("x", number, 1, y),
          coordinate("x", number, 2, z)};
}

// Shadows along a ray. Of the margin around a triangle's box one part is for its corners, one for
// the ray's origin; what is left is for the rounding of the box less the margin.
void claim_shadows(Claims& claims) {
  Positions x(1, 3);
  for (int k = 0; k < 3; ++k) x(0, k) = coordinate("p", 0, k, k + 1) - coordinate("q", 0, k, 0);
  for (int k = 0; k < 3; ++k) record.errors["pq" + std::to_string(k)] = 0;
  Topology mesh;
  mesh.triangles.push_back({0, 0, 0});
  const std::vector<std::int32_t> triangles = {0};
  const Crossings surface(mesh, triangles, x, Arithmetic::exact, nullptr);
  const Plane plane({reach, reach, reach});
  const Point p = point_of(x, 0);
  const Shadow corner = plane.of(p), origin = plane.of(RayOrigin{p, p, p});
  record.obligations.clear();
  const Node& margin = at(surface.margin_.node);
  Recorded main;  // without what is added for underflows
  main.node = margin.a;
  main.kind = Kind::bound;
  for (const Recorded& c : {corner.u, corner.v}) believe(c, main * 0.28125);
  for (const Recorded& c : {origin.u, origin.v}) believe(c, main * 0.53125);
  claims.write_obligations("shadows");
}

void claim_instants(Claims& claims) {
  filtered_orientation<ProvedBounds>(point("x", 0), point("x", 1), point("x", 2), point("x", 3));
  claims.write_obligations("orientation");
  // Both ends are above the triangle, so that both are looked at.
  surely_on_one_side(
      point_at(3, 0.125, 0.25, 1), point_at(4, 0.25, 0.375, 1.125),
      {point_at(0, 0, 0, 0), point_at(1, 1, 0.125, 0.25), point_at(2, 0.125, 1, 0.25)});
  if (record.obligations.size() != 2) throw std::runtime_error("two sides are compared");
  claims.write_obligations("orientation");
  for (const std::size_t axis : {0u, 1u, 2u}) {
    sure_side(point("x", 0), point("x", 1), point("x", 2), axis);
    claims.write_obligations("side");
  }
  std::array<int, 3> sides;
  normal_and_sides(point("x", 0), point("x", 1), point("x", 2), sides);
  claims.write_obligations("side");
  // No component of the direction is a power of two: products with it are rounded.
  filtered_signs<ProvedBounds>({point("c", 1), point("c", 2), point("c", 3)},
                               {point("o", 4), point("o", 5), point("o", 6)}, {3, 5, 7});
  claims.write_obligations("crossing");
  claim_shadows(claims);
}

const Filter filter("instants", claim_instants);

}  // namespace
}  // namespace assay::bounds
