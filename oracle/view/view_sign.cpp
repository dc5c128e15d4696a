#include "oracle/view/view_sign.h"

#include <cassert>

#include "oracle/parallel_chunks.h"
#include "oracle/processor_state.h"
#include "oracle/view/exact_view.h"
#include "oracle/view/interval_view.h"

namespace assay::oracle {

detector::ViewSign view_sign(const std::array<detector::MovingPoint, 3>& triangle,
                             const detector::ViewPrimitive& primitive) {
  require_exact_processor_state();
  if (const auto quick = interval_view_sign(triangle, primitive)) return *quick;
  return exact_view_sign(triangle, primitive);
}

std::vector<detector::ViewSign> view_signs(const detector::SteppedMesh& motion,
                                           const detector::TrianglesView& triangles,
                                           std::span<const detector::ViewPrimitive> primitives,
                                           int jobs) {
  const auto count = static_cast<std::size_t>(triangles.rows());
  assert(motion.vertices_t0.rows() == motion.vertices_t1.rows());
  assert(primitives.size() == 1 || primitives.size() == count);
  std::vector<detector::ViewSign> signs(count);
  constexpr std::size_t triangles_at_once = 256;
  StopGate never({});
  for_each_chunk(count, triangles_at_once, jobs, never,
                 [&](std::size_t begin, std::size_t end, int) {
                   for (std::size_t t = begin; t < end; ++t) {
                     auto corner = [&](int i) {
                       return motion.path(triangles(static_cast<Eigen::Index>(t), i));
                     };
                     signs[t] = view_sign({corner(0), corner(1), corner(2)},
                                          primitives[primitives.size() == 1 ? 0 : t]);
                   }
                 });
  return signs;
}

}  // namespace assay::oracle
