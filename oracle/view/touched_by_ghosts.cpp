#include "oracle/view/touched_by_ghosts.h"

#include <algorithm>
#include <cassert>

#include "oracle/instant/instant.h"
#include "oracle/mesh/feature_pairs.h"
#include "oracle/processor_state.h"
#include "oracle/query/contact.h"

namespace assay::oracle {

detector::Positions with_apexes(const detector::PositionsView& x,
                                const detector::PositionsView& apexes) {
  detector::Positions all(x.rows() + apexes.rows(), 3);
  all << x, apexes;
  return all;
}

std::vector<std::uint8_t> touched_by_ghosts(const detector::SteppedMesh& motion,
                                            const detector::TrianglesView& triangles,
                                            const detector::PositionsView& apexes_t0,
                                            const detector::PositionsView& apexes_t1,
                                            const detector::TrianglesView& ghosts,
                                            bool static_at_start) {
  require_exact_processor_state();
  assert(motion.vertices_t0.rows() == motion.vertices_t1.rows() &&
         apexes_t0.rows() == apexes_t1.rows());
  const detector::Positions all_t0 = with_apexes(motion.vertices_t0, apexes_t0);
  const detector::Positions all_t1 = with_apexes(motion.vertices_t1, apexes_t1);
  const detector::SteppedMesh all = {all_t0, all_t1};
  const BoxOfVertices box_of = swept_boxes(all);
  const MeshFeatures mesh_parts = mesh_features(triangles), fan_parts = mesh_features(ghosts);
  const FeatureIndex mesh(mesh_parts, box_of), fans(fan_parts, box_of);
  const Instant start(all_t0);
  const auto moves = [&](std::int32_t v) { return v >= 0 && all_t0.row(v) != all_t1.row(v); };
  // The exact test over the step. Features that do not move go to the integer tests, because flat
  // sheets at rest have many coplanar ones, and finding times for these is slow.
  const auto meet = [&](const detector::Feature& feature) {
    return feature.kind == detector::FeatureKind::piercing ||
                   std::ranges::none_of(feature.vertices, moves)
               ? features_meet(start.points(), feature)
               : contact_of(points_of(all, feature), detector::Want::yes_no).contact;
  };
  std::vector<std::uint8_t> touched(static_cast<std::size_t>(triangles.rows()));
  for_each_contact(mesh, fans, meet, {},
                   {[&](std::int32_t t, std::int32_t) { return !touched[t]; },
                    [&](std::int32_t t, std::int32_t, int) { touched[t] = 1; }},
                   static_at_start);
  return touched;
}

}  // namespace assay::oracle
