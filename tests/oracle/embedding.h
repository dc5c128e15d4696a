// Which triangles of a mesh meet at an instant, whether it is embedded, and whether it meets a
// moving view primitive.
#pragma once

#include <algorithm>

#include "detector/mesh/step_types.h"
#include "oracle/instant/instant.h"
#include "oracle/mesh/mesh_features.h"
#include "oracle/query/contact.h"

namespace assay::oracle {

// Returns all pairs in contact at the instant, ascending. detector/LAWS.md defines contact: two
// closed faces of the two triangles meet, and these faces share no vertex. So triangles that share
// a vertex or an edge are in contact if they also meet elsewhere, and triangles with the same three
// vertices are always in contact. REQUIRES indices in range.
inline std::vector<detector::TrianglePair> contacts_at(const Instant& instant,
                                                       const detector::TrianglesView& triangles,
                                                       int jobs = 1) {
  const auto meet = [&](const detector::Feature& feature) {
    return features_meet(instant.points(), feature);
  };
  const MeshFeatures features = mesh_features(triangles);
  const FeatureIndex mesh(
      features, [&](std::span<const std::int32_t> vertices) { return instant.box_of(vertices); });
  std::vector<std::vector<detector::TrianglePair>> found(std::max(jobs, 1));
  for_each_contact(mesh, mesh, meet, {jobs},
                   {[](std::int32_t s, std::int32_t t) { return s != t; },
                    [&](std::int32_t s, std::int32_t t, int worker) {
                      found[worker].push_back({std::min(s, t), std::max(s, t)});
                    }});
  std::vector<detector::TrianglePair> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

// Returns whether no two triangles are in contact, as detector/LAWS.md defines contact. So
// triangles that share a vertex or an edge meet nowhere else, and no two triangles have the same
// three vertices. REQUIRES indices in range, finite positions. Takes 0.1 to 0.4 s for 20,000
// triangles.
inline bool embedded(const detector::PositionsView& x, const detector::TrianglesView& triangles,
                     int jobs = 1) {
  return contacts_at(Instant(x), triangles, jobs).empty();
}

// Returns whether the mesh is embedded at time t of the step.
inline bool embedded_at(const detector::SteppedMesh& motion,
                        const detector::TrianglesView& triangles, const RationalTime& t,
                        int jobs = 1) {
  return contacts_at(Instant(motion, t), triangles, jobs).empty();
}

// Returns whether some triangle meets the view primitive at some t in [0,1]; touching counts. A
// view-point is tested against the triangles. If the primitive is a segment, its two ends are
// tested against the triangles, the segment is tested against the edges, and at t=0 it is tested
// whether the segment pierces a triangle. This is enough: if a segment passes through the inside of
// a triangle at some time, it did so at t=0, or began to do so with one of the other contacts.
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
