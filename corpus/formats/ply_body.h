// Reads the values of a PLY body one after another, whatever their encoding.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "corpus/formats/mesh_builder.h"
#include "corpus/formats/ply_header.h"
#include "corpus/problem.h"

namespace assay::corpus {

// In an ascii body a decimal becomes the nearest double whatever float type the header declares:
// rounding it to float32 first would lose digits that the file has.
class PlyBody {
 public:
  PlyBody(std::string_view bytes, const PlyHeader& header, const std::filesystem::path& file)
      : bytes_(bytes),
        file_(file),
        encoding_(header.encoding),
        offset_(header.size),
        line_(header.lines + 1) {}

  // The next value. Fails at the end of the file, and when a word is no number of that kind.
  Expected<double> number(PlyType type);
  // REQUIRES: is_integer(type).
  Expected<std::int64_t> integer(PlyType type);
  Expected<void> skip(PlyType type, std::uint64_t count);

  // Whether `count` items may still follow, of `least_size` bytes each in a binary body, of a word
  // each in an ascii one. Asked before anything is sized by a number that the file claims.
  bool has_room(std::uint64_t count, std::uint64_t least_size) const;

  // True when nothing is left, in an ascii body nothing but blanks.
  bool at_end();

  Place place() const;

 private:
  bool is_ascii() const { return encoding_ == PlyEncoding::ascii; }
  void skip_blanks();
  std::string_view word();
  // The next value as the low bytes of an integer. REQUIRES: it is there.
  std::uint64_t bits(std::size_t size);
  Problem truncated() const;
  Problem malformed(std::string_view word) const;

  std::string_view bytes_;
  const std::filesystem::path& file_;
  PlyEncoding encoding_;
  std::size_t offset_;
  std::size_t line_;
};

}  // namespace assay::corpus
