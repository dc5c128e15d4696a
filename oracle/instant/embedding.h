// Whether a mesh is embedded at an instant, and whether it meets a moving view primitive.
#pragma once

#include "detector/mesh/step_types.h"
#include "oracle/instant/instant.h"

namespace assay::oracle {

// No two triangles in contact (detector/README.md, The laws): pairs that share a vertex or an edge
// meet nowhere beyond it, and no two triangles have the same three vertices. REQUIRES indices in
// range, finite positions. 0.1 to 0.4 s for 20,000 triangles.
bool embedded(const detector::PositionsView& x, const detector::TrianglesView& triangles,
              int jobs = 1);

// At any rational time of a step.
bool embedded_at(const detector::PositionsView& x_t0, const detector::PositionsView& x_t1,
                 const detector::TrianglesView& triangles, const RationalTime& t, int jobs = 1);

// Whether some triangle meets the primitive at some t in [0,1]; touching counts. A point is tested
// against the triangles; a segment by its ends against the triangles, by itself against the edges,
// and for piercing at t=0: a segment that is in the inside of a triangle at some time was there at
// the start, or came in through one of these.
bool meets_primitive(const detector::PositionsView& x_t0, const detector::PositionsView& x_t1,
                     const detector::TrianglesView& triangles,
                     const detector::ViewPrimitive& primitive);

}  // namespace assay::oracle
