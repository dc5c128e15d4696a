// The header of a PLY file: which elements follow, and how their properties are laid out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/problem.h"

namespace assay::corpus {

enum class PlyEncoding { ascii, little_endian, big_endian };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

// The size of a value in a binary file, in bytes.
std::size_t size_of(PlyType type);
bool is_integer(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;    // of each item, for a list
  std::optional<PlyType> count_type;  // set for a list; an integer type
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;  // as claimed; not yet compared with the size of the file
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  std::size_t size = 0;   // bytes; the body begins here
  std::size_t lines = 0;  // lines taken by the header
};

bool looks_like_ply(std::string_view bytes);

// A problem names the line.
Expected<PlyHeader> read_ply_header(std::string_view bytes, const std::filesystem::path& file);

}  // namespace assay::corpus
