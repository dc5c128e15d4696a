// Whether a mesh is embedded at an instant, and whether it meets a moving view primitive.
#pragma once

#include "detector/mesh/step_types.h"
#include "oracle/instant/instant.h"

namespace assay::oracle {

// True when no two triangles are in contact, as detector/README.md, The laws, defines it: pairs
// that share a vertex or an edge meet nowhere beyond it, and no two triangles have the same three
// vertices. REQUIRES indices in range, finite positions. 0.1 to 0.4 s for 20,000 triangles.
bool embedded(const detector::PositionsView& x, const detector::TrianglesView& triangles,
              int jobs = 1);

// The same question at time t of the step.
bool embedded_at(const detector::SteppedMesh& motion, const detector::TrianglesView& triangles,
                 const RationalTime& t, int jobs = 1);

// True when some triangle meets the view primitive at some t in [0,1]; touching counts. A
// view-point is tested against the triangles. Of a segment the two ends are tested against the
// triangles, the segment itself against the edges, and at t=0 also whether it pierces a triangle.
// That is enough, because a segment that passes through the inside of a triangle at some time did
// so at t=0 already or came in by one of the other contacts.
bool meets_primitive(const detector::SteppedMesh& motion, const detector::TrianglesView& triangles,
                     const detector::ViewPrimitive& primitive);

}  // namespace assay::oracle
