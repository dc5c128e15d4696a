// The passes of the reducer, in the order in which they run. Each proposes cases to the search and
// leaves the best one there; whether it made progress shows in the search's size.
//
// To add one: a function here, a row in passes.cpp, a test in
// tests/properties/reducer/reducer_passes_test.
#pragma once

#include <span>

#include "properties/reducer/search.h"

namespace assay::properties {

// step_passes.cpp: the sequence.
void drop_later_steps(ReductionSearch& search);  // those behind the one that shows the failure
void drop_steps(ReductionSearch& search);        // halves, then one by one
void merge_steps(ReductionSearch& search);       // a step from the start of one to the end of next

// face_passes.cpp: any mesh; a closed one does not stay closed.
void drop_components(ReductionSearch& search);  // halves, then one by one; these do stay closed
void keep_rings(ReductionSearch& search);       // the reported pair and 0, 1, 2 .. rings around it
void drop_faces(ReductionSearch& search);       // halves, then one by one, far ones first
void drop_unused_vertices(ReductionSearch& search);
void drop_ghosts(ReductionSearch& search);  // those that the case states

// closed_passes.cpp: a cycle stays a cycle.
void cone_outside(ReductionSearch& search);   // all vertices outside a ring become one
void cut_and_close(ReductionSearch& search);  // rings around the pair, their loops closed by fans
void merge_balls(ReductionSearch& search);    // groups of neighbours become one vertex each
void collapse_to_parents(ReductionSearch& search);  // many edges at once, towards the pair
void collapse_edges(ReductionSearch& search);       // one at a time, either way
void merge_twice(ReductionSearch& search);          // two collapses at once, of small meshes
void remove_and_close(ReductionSearch& search);     // single faces or vertex stars, closed by a fan

// small_meshes.cpp: triangulated spheres over some of the case's own vertices.
void try_spheres_of_pair(ReductionSearch& search);  // over vertices of the reported pair: few
void try_small_spheres(ReductionSearch& search);    // and of those around it: thousands

// motion_passes.cpp: vertices that rest.
void freeze_vertices(ReductionSearch& search);  // halves, then one by one; at either end's place

// view_passes.cpp: the view primitive that the case gives.
void simplify_view(ReductionSearch& search);  // fixed, a point, at the origin
void drop_view(ReductionSearch& search);      // at the end: the detector's own serves as well

// number_passes.cpp: simpler coordinates.
void translate(ReductionSearch& search);          // along each axis, so that many become 0
void round_all(ReductionSearch& search);          // all to a grid of few integers
void round_vertices(ReductionSearch& search);     // one vertex at a time, fewer digits
void simplify_numbers(ReductionSearch& search);   // one coordinate at a time, towards 0
void simplify_together(ReductionSearch& search);  // a few coordinates at once, at random

// escape.cpp: random changes (the same ones for the same case) from which a smaller mesh is
// reached; when all other passes are stuck.
void escape(ReductionSearch& search);

// order_pass.cpp: vertices and triangles numbered by first use. The size stays.
void canonical_order(ReductionSearch& search);

struct Pass {
  const char* name;
  void (*run)(ReductionSearch& search);
};

// Those that make the mesh and the sequence shorter; those that make the whole simpler, and single
// numbers; the last resort.
std::span<const Pass> shortening_passes();
std::span<const Pass> simplifying_passes();
std::span<const Pass> number_passes();
std::span<const Pass> escaping_passes();

}  // namespace assay::properties
