#include "oracle/instant/embedding.h"

#include "oracle/instant/instant_contacts.h"
#include "oracle/mesh/mesh_features.h"
#include "oracle/processor_state.h"
#include "oracle/query/contact.h"

namespace assay::oracle {

namespace {

using detector::MovingPoint;
using detector::PositionsView;
using detector::SteppedMesh;
using detector::TrianglesView;

}  // namespace

bool embedded(const PositionsView& x, const TrianglesView& triangles, int jobs) {
  return !any_contact_at(Instant(x), triangles, jobs);
}

bool embedded_at(const SteppedMesh& motion, const TrianglesView& triangles, const RationalTime& t,
                 int jobs) {
  return !any_contact_at(Instant(motion, t), triangles, jobs);
}

// Uses no tree, because the axis rung of contact.h ends a query as fast as a tree would find it.
bool meets_primitive(const SteppedMesh& motion, const TrianglesView& triangles,
                     const detector::ViewPrimitive& primitive) {
  require_exact_processor_state();
  const MeshFeatures features = mesh_features(triangles);
  auto path = [&](std::int32_t v) { return motion.path(v); };
  const bool is_point = primitive.is_point();
  for (const Face& f : features.faces) {
    const std::array<MovingPoint, 3> face = {path(f[0]), path(f[1]), path(f[2])};
    if (vertex_face_contact({primitive.q0, face}, detector::Want::yes_no).contact) return true;
    if (is_point) continue;
    if (vertex_face_contact({primitive.q1, face}, detector::Want::yes_no).contact) return true;
    if (segment_pierces_triangle(primitive.q0.t0, primitive.q1.t0,
                                 {face[0].t0, face[1].t0, face[2].t0})) {
      return true;
    }
  }
  if (is_point) return false;
  for (const Edge& e : features.edges) {
    if (edge_edge_contact({{primitive.q0, primitive.q1}, {path(e[0]), path(e[1])}},
                          detector::Want::yes_no)
            .contact) {
      return true;
    }
  }
  return false;
}

}  // namespace assay::oracle
