// The pass that gives the mesh its canonical numbering (passes.h).
#include <algorithm>

#include "properties/reducer/case_edits.h"
#include "properties/reducer/passes/passes.h"

namespace assay::properties {
namespace {

using corpus::Case;

// Numbers the vertices in the order in which the triangles name them.
Case with_vertices_by_use(const Case& c) {
  std::vector<std::int32_t> number(static_cast<std::size_t>(c.frames.front().rows()), -1);
  std::int32_t used = 0;
  Case ordered = c;
  for (Eigen::Index t = 0; t < c.triangles.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const auto old = c.triangles(t, i);
      auto& n = number[static_cast<std::size_t>(old)];
      if (n < 0) {
        n = used++;
        for (std::size_t f = 0; f < c.frames.size(); ++f) {
          ordered.frames[f].row(n) = c.frames[f].row(old);
        }
      }
      ordered.triangles(t, i) = n;
    }
  }
  return ordered;
}

Case with_lowest_corners_first(const Case& c) {
  auto triangles = triangles_of(c);
  for (auto& corners : triangles) {
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  }
  return with_triangles(c, triangles);
}

Case with_sorted_triangles(const Case& c) {
  auto triangles = triangles_of(c);
  std::sort(triangles.begin(), triangles.end());
  return with_triangles(c, triangles);
}

}  // namespace

void canonical_order(ReductionSearch& search) {
  if (search.best().ghosts) return;  // their indices and apexes follow the mesh's own order
  const auto all = [](const Case& c) {
    return with_sorted_triangles(with_lowest_corners_first(with_vertices_by_use(c)));
  };
  // If the failure depends on the order, as much of the canonical order is taken as it allows.
  if (search.replace(all(search.best()))) return;
  search.replace(with_vertices_by_use(search.best()));
  search.replace(with_lowest_corners_first(search.best()));
  search.replace(with_sorted_triangles(search.best()));
}

}  // namespace assay::properties
