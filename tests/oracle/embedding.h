// Whether a mesh is embedded at an instant, and whether it meets a moving view primitive.
#pragma once

#include "detector/mesh/step_types.h"
#include "oracle/instant/instant.h"
#include "oracle/mesh/mesh_features.h"
#include "oracle/query/contact.h"

namespace assay::oracle {

// True when no two triangles are in contact, as detector/LAWS.md defines it: pairs that share a
// vertex or an edge meet nowhere beyond it, and no two triangles have the same three vertices.
// REQUIRES indices in range, finite positions. 0.1 to 0.4 s for 20,000 triangles.
inline bool embedded(const detector::PositionsView& x, const detector::TrianglesView& triangles,
                     int jobs = 1) {
  return !any_contact_at(Instant(x), triangles, jobs);
}

// The same question at time t of the step.
inline bool embedded_at(const detector::SteppedMesh& motion,
                        const detector::TrianglesView& triangles, const RationalTime& t,
                        int jobs = 1) {
  return !any_contact_at(Instant(motion, t), triangles, jobs);
}

// True when some triangle meets the view primitive at some t in [0,1]; touching counts. A
// view-point is tested against the triangles. Of a segment the two ends are tested against the
// triangles, the segment itself against the edges, and at t=0 also whether it pierces a triangle.
// That is enough, because a segment that passes through the inside of a triangle at some time did
// so at t=0 already or came in by one of the other contacts.
// Uses no tree, because the axis rung of contact.h ends a query as fast as a tree would find it.
inline bool meets_primitive(const detector::SteppedMesh& motion,
                            const detector::TrianglesView& triangles,
                            const detector::ViewPrimitive& primitive) {
  const MeshFeatures features = mesh_features(triangles);
  auto path = [&](std::int32_t v) { return motion.path(v); };
  const bool is_point = primitive.is_point();
  for (const Face& f : features.faces) {
    const std::array<detector::MovingPoint, 3> face = {path(f[0]), path(f[1]), path(f[2])};
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
