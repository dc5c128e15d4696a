// Reads triangle meshes: OBJ, PLY (ascii and binary), OFF, each also compressed with gzip.
//
// Guarantee: a decimal number becomes the double nearest to it (ties to even); float32 and integer
// values convert exactly; nothing is merged, moved or reordered: vertex i of the file is row i,
// and triangles keep the file's order. A polygon is fanned from its first vertex.
// Refused, in words: an index out of range, an index repeated in a triangle, a coordinate that is
// not finite, and all that MeshBuilder refuses. NOT refused, because the detector
// judges them: two triangles with the same three vertices, unused or duplicate vertices, zero-area
// triangles.
#pragma once

#include <filesystem>

#include "corpus/problem.h"
#include "detector/mesh/types.h"

namespace assay::corpus {

struct Mesh {
  detector::Positions positions;
  detector::Triangles triangles;
};

// The content tells the format if it has a signature (PLY, OFF, gzip), otherwise the extension
// does (.obj, .obj.gz).
Expected<Mesh> read_mesh(const std::filesystem::path& path);

// Refuses what is known of a file without reading all of it: that it is not there, may not be
// read, is empty or of no format. The problem is that of read_mesh.
Expected<void> look_at_mesh(const std::filesystem::path& path);

}  // namespace assay::corpus
