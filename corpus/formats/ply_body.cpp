#include "corpus/formats/ply_body.h"

#include <fmt/format.h>

#include <bit>

#include "corpus/formats/numbers.h"
#include "corpus/formats/text_lines.h"

namespace assay::corpus {
namespace {

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

// Two's complement of the low `size` bytes.
std::int64_t sign_extended(std::uint64_t bits, std::size_t size) {
  const int unused = static_cast<int>(64 - 8 * size);
  return static_cast<std::int64_t>(bits << unused) >> unused;
}

bool is_signed(PlyType type) {
  return type == PlyType::int8 || type == PlyType::int16 || type == PlyType::int32;
}

}  // namespace

Place PlyBody::place() const { return is_ascii() ? Place{"line", line_} : Place{"byte", offset_}; }

Problem PlyBody::truncated() const {
  return problem_in(file_,
                    fmt::format("{}: the file ends before its header's counts", shown(place())));
}

Problem PlyBody::malformed(std::string_view word) const {
  return problem_in(
      file_, fmt::format("{}: {} is not of the type in the header", shown(place()), excerpt(word)));
}

void PlyBody::skip_blanks() {
  while (offset_ < bytes_.size() && is_blank(bytes_[offset_])) {
    if (bytes_[offset_] == '\n') ++line_;
    ++offset_;
  }
}

std::string_view PlyBody::word() {
  skip_blanks();
  const std::size_t begin = offset_;
  while (offset_ < bytes_.size() && !is_blank(bytes_[offset_])) ++offset_;
  return bytes_.substr(begin, offset_ - begin);
}

std::uint64_t PlyBody::bits(std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t byte = encoding_ == PlyEncoding::big_endian ? size - 1 - i : i;
    value |= std::uint64_t{static_cast<unsigned char>(bytes_[offset_ + i])} << (8 * byte);
  }
  offset_ += size;
  return value;
}

bool PlyBody::has_room(std::uint64_t count, std::uint64_t least_size) const {
  // A word takes one character at least.
  const std::uint64_t size = is_ascii() ? 1 : least_size;
  return size == 0 || count <= (bytes_.size() - offset_) / size;
}

bool PlyBody::at_end() {
  if (is_ascii()) skip_blanks();
  return offset_ == bytes_.size();
}

Expected<double> PlyBody::number(PlyType type) {
  if (is_ascii()) {
    const std::string_view text = word();
    if (text.empty()) return truncated();
    const auto value = parse_double(text);
    if (!value) return malformed(text);
    return *value;
  }
  if (!has_room(1, size_of(type))) return truncated();
  const std::uint64_t raw = bits(size_of(type));
  if (type == PlyType::float64) return std::bit_cast<double>(raw);
  if (type == PlyType::float32) {
    return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(raw)));
  }
  if (is_signed(type)) return static_cast<double>(sign_extended(raw, size_of(type)));
  return static_cast<double>(raw);
}

Expected<std::int64_t> PlyBody::integer(PlyType type) {
  if (is_ascii()) {
    const std::string_view text = word();
    if (text.empty()) return truncated();
    const auto value = parse_integer(text);
    if (!value) return malformed(text);
    return *value;
  }
  if (!has_room(1, size_of(type))) return truncated();
  const std::uint64_t raw = bits(size_of(type));
  if (is_signed(type)) return sign_extended(raw, size_of(type));
  return static_cast<std::int64_t>(raw);
}

Expected<void> PlyBody::skip(PlyType type, std::uint64_t count) {
  if (!has_room(count, size_of(type))) return truncated();
  if (is_ascii()) {
    for (std::uint64_t i = 0; i < count; ++i) {
      if (word().empty()) return truncated();
    }
  } else {
    offset_ += count * size_of(type);
  }
  return boost::outcome_v2::success();
}

}  // namespace assay::corpus
