// Scenes of the kinds that fill a collision detector with work: many layers, many bodies, a body
// wound about itself, many thin strips. Each is a mesh for every s in [0,1], the scene's own time.
// At s = 0 nothing touches. How far anything moves, and how thick and close it is, does not depend
// on `size`, which is the wanted number of triangles; where a shape has a number of parts, a larger
// size has more of them.
#pragma once

#include "corpus/formats/mesh_reader.h"

namespace assay::corpus {

// Square sheets one over the other, in the same folds, and nearer than they are moved: each slides
// and bulges in its own way. 50 of them from 1,600 triangles on, else fewer.
Mesh layered_cloth(int size, double s);

// Spheres of 80 triangles and several radii on a cubic grid, which draws together while they turn.
// 1,000 of them at 80,000 triangles.
Mesh pile_of_bodies(int size, double s);

// A closed tube along a trefoil knot. The knot is drawn together while the tube stays as thick as
// it is. It is twelve times as many pieces long as around.
Mesh tightening_knot(int size, double s);

// Strips of 48 triangles that hang down side by side, all bent alike, and are combed: the columns
// lean to one side and to the other in turn. 5,000 of them at 240,000 triangles.
Mesh combed_hair(int size, double s);

}  // namespace assay::corpus
