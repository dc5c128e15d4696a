// Writes meshes as binary little-endian PLY with double coordinates: read back bit by bit.
//
// Every file is written beside its place and renamed, so a reader sees the old file or the whole
// new one.
#pragma once

#include <filesystem>
#include <vector>

#include "corpus/formats/mesh_reader.h"
#include "corpus/problem.h"

namespace assay::corpus {

// cannot_write, with the reason, when the file system refuses.
Expected<void> write_mesh(const std::filesystem::path& path,
                          const detector::PositionsView& positions,
                          const detector::TrianglesView& triangles);

// frame_0000.ply, frame_0001.ply, ... in `folder`, which is made if it is missing; the paths
// written, in frame order.
Expected<std::vector<std::filesystem::path>> write_sequence(const std::filesystem::path& folder,
                                                            const Sequence& sequence);

}  // namespace assay::corpus
