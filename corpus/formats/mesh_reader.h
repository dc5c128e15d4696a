// Reads triangle meshes: OBJ, PLY (ascii and binary), OFF, each also compressed with gzip.
//
// Guarantee: a decimal number becomes the double nearest to it (ties to even); float32 and integer
// values convert exactly; nothing is merged, moved or reordered: vertex i of the file is row i,
// and triangles keep the file's order. A polygon is fanned from its first vertex.
// Refused by name: what FileProblem lists for meshes, such as an index out of range, an index
// repeated in a triangle, a coordinate that is not finite. NOT refused, because the detector
// judges them: two triangles with the same three vertices, unused or duplicate vertices, zero-area
// triangles.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

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

// One mesh that deforms: consecutive frames are the ends of a step.
struct Sequence {
  detector::Triangles triangles;
  std::vector<detector::Positions> frames;
};

// Reads one frame from each file. All files must hold the same triangles and the same number of
// vertices; otherwise the problem names both files. no_frames when `paths` is empty.
Expected<Sequence> read_sequence(std::span<const std::filesystem::path> paths);

}  // namespace assay::corpus
