// Writes meshes as binary little-endian PLY with double coordinates, which read back bit by bit.
//
// Every file is written beside its place and then renamed, so a reader sees the old file or the
// whole new one.
#pragma once

#include <filesystem>
#include <vector>

#include "corpus/formats/sequence_reader.h"
#include "corpus/problem.h"

namespace assay::corpus {

// Fails, with the reason, when the file system refuses, and when memory does not suffice. `marked`:
// null, or by triangle 0 for grey, 1 for red, 2 for amber.
Expected<void> write_mesh(const std::filesystem::path& path,
                          const detector::PositionsView& positions,
                          const detector::TrianglesView& triangles,
                          const std::vector<std::uint8_t>* marked = nullptr);

// Writes frame_0000.ply, frame_0001.ply, ... into `folder`, which is made if it is missing.
// Returns the paths, in frame order.
Expected<std::vector<std::filesystem::path>> write_sequence(const std::filesystem::path& folder,
                                                            const Sequence& sequence);

}  // namespace assay::corpus
