// Canonical numbering: see passes.h.
#include <algorithm>

#include "properties/reducer/case_edits.h"
#include "properties/reducer/passes.h"

namespace assay::properties {
namespace {

using Corners = std::array<std::int32_t, 3>;

Corners lowest_first(Corners corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

}  // namespace

void canonical_order(ReductionSearch& search) {
  const corpus::Case& c = search.best();
  if (c.ghosts) return;  // their indices and apexes follow the mesh's own order
  std::vector<std::int32_t> number(static_cast<std::size_t>(c.frames.front().rows()), -1);
  std::int32_t used = 0;
  auto triangles = triangles_of(c);
  for (auto& corners : triangles) {
    for (auto& v : corners) {
      auto& n = number[static_cast<std::size_t>(v)];
      if (n < 0) n = used++;
      v = n;
    }
    corners = lowest_first(corners);
  }
  std::sort(triangles.begin(), triangles.end());
  corpus::Case ordered = c;
  for (std::size_t f = 0; f < c.frames.size(); ++f) {
    for (std::size_t v = 0; v < number.size(); ++v) {
      if (number[v] < 0) return;
      ordered.frames[f].row(number[v]) = c.frames[f].row(static_cast<Eigen::Index>(v));
    }
  }
  search.replace(with_triangles(ordered, triangles));
}

}  // namespace assay::properties
