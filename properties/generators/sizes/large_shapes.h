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

// What they are made of.

// Each coordinate between -most and most.
Point any_point(Random& random, double most);

// A grid of (columns + 1) x (rows + 1) vertices, two triangles a cell; `place` says where each is.
template <class Place>
void add_sheet(Draft& draft, int columns, int rows, const Place& place) {
  const auto first = draft.vertices();
  for (int i = 0; i <= rows; ++i) {
    for (int k = 0; k <= columns; ++k) draft.vertex(place(k, i));
  }
  const auto at_cell = [&](int k, int i) { return first + i * (columns + 1) + k; };
  for (int i = 0; i < rows; ++i) {
    for (int k = 0; k < columns; ++k)
      draft.quad(at_cell(k, i), at_cell(k + 1, i), at_cell(k + 1, i + 1), at_cell(k, i + 1));
  }
}

// A tetrahedron whose corners are `size` from `middle` along each axis, before it is tilted.
void add_tetrahedron(Draft& draft, const Point& middle, double size, const Point& tilt);

// The cells of a cubic grid that has room for so many bodies.
class Grid {
 public:
  Grid(int bodies, double pitch);
  Point cell(int body) const;

 private:
  int side_;
  double pitch_;
};

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
