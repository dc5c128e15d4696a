// Large shapes with one motion each, for the families of sizes. Lengths of edges are of the order
// of 1, but where a shape says otherwise. Each starts without contact, so that every contract with
// a start takes it.
#pragma once

#include "properties/generators/draft.h"

namespace assay::properties {

// A shape has about `triangles` triangles, at least 100, and two frames: where it starts, and
// where its motion ends.
struct LargeShape {
  const char* name;
  Draft (*make)(Random& random, int triangles);
};

// What they are made of, beside the sheets and grids of corpus/scenes/shapes.h.

// Each coordinate between -most and most.
Point any_point(Random& random, double most);

// A tetrahedron whose corners are `size` from `middle` along each axis, before it is tilted.
void add_tetrahedron(Draft& draft, const Point& middle, double size, const Point& tilt);

// dense_shapes.cpp: many contacts, which fill buffers, or many boxes that meet. How many there are
// for each triangle does not grow with the size, so that the oracle judges a case in seconds.

Draft layered_cloth(Random& random, int triangles);    // sheets that bulge through each other
Draft crumpled_sheet(Random& random, int triangles);   // one sheet in pleats, pressed together
Draft bundle_of_tubes(Random& random, int triangles);  // closed tubes side by side, squeezed
Draft soup_of_bodies(Random& random, int triangles);   // tetrahedra that fly into each other
// Stacks of triangles so thin that all of a stack lie in the same place: no tree can part them. A
// stack is half of the mesh at 1,000 triangles; at larger sizes it is a smaller part of it.
Draft stacks_in_one_place(Random& random, int triangles);

// sparse_shapes.cpp: few contacts, at places where they are easily lost.

// A sheet, and one body that falls on its far corner: its triangles are the last of the mesh.
Draft contact_in_a_far_corner(Random& random, int triangles);
// Bodies on a grid, of which every fiftieth meets its neighbour.
Draft many_components(Random& random, int triangles);
// Pairs of bodies that meet, each half as large and half as far from one point as the pair before,
// 44 to 60 times: a tree that halves space is as deep. The rest of the mesh is a sheet.
Draft bodies_to_one_point(Random& random, int triangles);
// A vertex of 1,000 triangles, of which some slide through each other; the rest is a sheet.
Draft vertex_of_high_valence(Random& random, int triangles);
// A closed sphere that breathes, and meets nothing.
Draft breathing_sphere(Random& random, int triangles);

}  // namespace assay::properties
