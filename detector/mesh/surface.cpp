#include "detector/mesh/surface.h"

#include <cassert>

namespace assay::detector {

Surface make_surface(const TrianglesView& triangles, Eigen::Index vertex_count) {
  PacedStop pace(never_stops);
  return make_surface(triangles, vertex_count, pace);
}

Surface make_surface(const TrianglesView& triangles, Eigen::Index vertex_count, PacedStop& pace) {
  constexpr std::uint64_t work_of_ghost = 4;
  Surface surface;
  surface.mesh = make_topology(triangles, vertex_count, pace);
  if (pace.stopped()) return surface;
  surface.loops = boundary_loops(surface.mesh, pace);
  surface.first_apex = static_cast<std::int32_t>(vertex_count);
  if (pace.stopped() || surface.is_closed()) return surface;
  std::size_t ghosts = 0;
  for (const auto& loop : surface.loops) ghosts += loop.size();
  Triangles all(triangles.rows() + static_cast<Eigen::Index>(ghosts), 3);
  all.topRows(triangles.rows()) = triangles;
  Eigen::Index row = triangles.rows();
  for (std::size_t l = 0; l < surface.loops.size(); ++l) {
    const auto& loop = surface.loops[l];
    const auto apex = surface.first_apex + static_cast<std::int32_t>(l);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      all.row(row++) << loop[(i + 1) % loop.size()], loop[i], apex;
    }
    if (pace.after(work_of_ghost * loop.size())) return surface;
  }
  surface.with_ghosts =
      make_topology(all, vertex_count + static_cast<Eigen::Index>(surface.loops.size()), pace);
  // A loop stays within one component, so its ghosts join no two components. Apexes have higher
  // indices than all vertices, so no component changes its place.
  assert(pace.stopped() || surface.with_ghosts.components.size() == surface.mesh.components.size());
  return surface;
}

}  // namespace assay::detector
