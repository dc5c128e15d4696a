// Reads PLY: ascii, binary little-endian and big-endian.
#pragma once

#include <filesystem>
#include <string_view>

#include "corpus/formats/mesh_reader.h"

namespace assay::corpus {

// Reads x, y, z of any type from element `vertex`, and from element `face` a list vertex_indices
// or vertex_index of an integer type. All other elements and properties are skipped.
Expected<Mesh> read_ply(std::string_view bytes, const std::filesystem::path& file);

}  // namespace assay::corpus
