#include "properties/generators/sizes/large_shapes.h"

namespace assay::properties {

Point any_point(Random& random, double most) {
  const double x = random.signed_unit(), y = random.signed_unit(), z = random.signed_unit();
  return {most * x, most * y, most * z};
}

void add_tetrahedron(Draft& draft, const Point& middle, double size, const Point& tilt) {
  const Point corners[] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  const auto v = draft.vertices();
  for (const auto& c : corners) draft.vertex(middle + size * (c + cross(tilt, c)));
  for (const Face& f : {Face{0, 1, 2}, Face{0, 3, 1}, Face{0, 2, 3}, Face{1, 3, 2}})
    draft.faces.push_back({v + f[0], v + f[1], v + f[2]});
}

}  // namespace assay::properties
