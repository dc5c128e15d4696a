// Reads OFF files in text form.
#pragma once

#include <filesystem>
#include <string_view>

#include "corpus/formats/mesh_reader.h"

namespace assay::corpus {

// Whether the text begins as an OFF file: OFF after the optional letters ST, C, N, 4, n.
bool looks_like_off(std::string_view text);

// Reads a header word, the counts, one vertex a line and one polygon a line; `#` starts a comment.
// Normals, colours and texture coordinates are passed over; 4-dimensional and binary files are
// refused.
Expected<Mesh> read_off(std::string_view text, const std::filesystem::path& file);

}  // namespace assay::corpus
