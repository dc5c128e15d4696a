#include <fmt/format.h>

#include <array>
#include <bit>
#include <boost/outcome/try.hpp>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "corpus/formats/mesh_builder.h"
#include "corpus/formats/mesh_reader.h"
#include "corpus/formats/ply_header.h"
#include "corpus/formats/text_lines.h"
#include "corpus/problem.h"

namespace assay::corpus {
namespace {

// Reads the values of a PLY body one after another, whatever their encoding.
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
  // Where the next value begins.
  Place next_place() {
    if (is_ascii()) skip_blanks();
    return place();
  }

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

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

// Two's complement of the low `size` bytes.
std::int64_t sign_extended(std::uint64_t bits, std::size_t size) {
  const int unused = static_cast<int>(64 - 8 * size);
  return static_cast<std::int64_t>(bits << unused) >> unused;
}

bool is_signed(PlyType type) {
  return type == PlyType::int8 || type == PlyType::int16 || type == PlyType::int32 ||
         type == PlyType::int64;
}

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

// What becomes of a property: a coordinate, the corners of a face, or nothing.
enum class Role { x = 0, y = 1, z = 2, corners, skipped };

Role role_of(const PlyElement& element, const PlyProperty& property) {
  if (element.name == "vertex" && !property.count_type && property.name.size() == 1 &&
      property.name[0] >= 'x' && property.name[0] <= 'z') {
    return static_cast<Role>(property.name[0] - 'x');
  }
  if (element.name == "face" && property.count_type && is_integer(property.type) &&
      (property.name == "vertex_indices" || property.name == "vertex_index")) {
    return Role::corners;
  }
  return Role::skipped;
}

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const PlyHeader& header, const std::filesystem::path& file)
      : header_(header), body_(bytes, header, file), builder_(file), file_(file) {}

  Expected<Mesh> read() {
    for (const PlyElement& element : header_.elements) {
      BOOST_OUTCOME_TRY(read_element(element));
    }
    if (!body_.at_end()) {
      return builder_.problem(body_.place(), "data after the last element of the header");
    }
    return builder_.finish();
  }

 private:
  Expected<void> read_element(const PlyElement& element) {
    if (element.properties.empty()) return boost::outcome_v2::success();
    std::vector<Role> roles;
    std::array<int, 5> found{};
    std::uint64_t least_size = 0;
    for (const PlyProperty& property : element.properties) {
      roles.push_back(role_of(element, property));
      ++found[static_cast<std::size_t>(roles.back())];
      least_size += size_of(property.count_type.value_or(property.type));
    }
    const bool vertices = element.name == "vertex";
    if (!vertices && element.name != "face" && element.count > 0)
      builder_.skip("row of element " + element.name, element.count);
    if (vertices && (found[0] != 1 || found[1] != 1 || found[2] != 1)) {
      return problem_in(file_, "element vertex has no x, y, z");
    }
    if (element.name == "face" && found[static_cast<std::size_t>(Role::corners)] != 1) {
      return problem_in(file_,
                        "element face has no list vertex_indices or vertex_index of integers");
    }
    if (!body_.has_room(element.count, least_size)) {
      return builder_.problem(body_.place(),
                              fmt::format("{} times element {} do not fit into the rest of the "
                                          "file",
                                          element.count, element.name));
    }
    for (std::uint64_t row = 0; row < element.count; ++row) {
      BOOST_OUTCOME_TRY(read_row(element, roles, vertices));
    }
    return boost::outcome_v2::success();
  }

  Expected<void> read_row(const PlyElement& element, const std::vector<Role>& roles,
                          bool vertices) {
    const Place place = body_.next_place();
    std::array<double, 3> x{};
    for (std::size_t i = 0; i < roles.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (property.count_type) {
        BOOST_OUTCOME_TRY(read_list(property, roles[i], place));
      } else if (roles[i] == Role::skipped) {
        BOOST_OUTCOME_TRY(body_.skip(property.type, 1));
      } else {
        BOOST_OUTCOME_TRY(value, body_.number(property.type));
        x[static_cast<std::size_t>(roles[i])] = value;
      }
    }
    if (vertices) return builder_.add_vertex(x[0], x[1], x[2], place);
    return boost::outcome_v2::success();
  }

  Expected<void> read_list(const PlyProperty& property, Role role, const Place& place) {
    BOOST_OUTCOME_TRY(count, body_.integer(*property.count_type));
    if (count < 0) return builder_.problem(place, "a list of negative size");
    const auto items = static_cast<std::uint64_t>(count);
    if (!body_.has_room(items, size_of(property.type))) {
      return builder_.problem(
          place, fmt::format("a list of {} items does not fit into the rest of the file", items));
    }
    if (role != Role::corners) return body_.skip(property.type, items);
    corners_.clear();
    for (std::uint64_t i = 0; i < items; ++i) {
      BOOST_OUTCOME_TRY(vertex, body_.integer(property.type));
      corners_.push_back(vertex);
    }
    return builder_.add_polygon(corners_, place);
  }

  const PlyHeader& header_;
  PlyBody body_;
  MeshBuilder builder_;
  const std::filesystem::path& file_;
  std::vector<std::int64_t> corners_;
};

}  // namespace

Expected<Mesh> read_ply(std::string_view bytes, const std::filesystem::path& file) {
  BOOST_OUTCOME_TRY(header, read_ply_header(bytes, file));
  return PlyReader(bytes, header, file).read();
}

}  // namespace assay::corpus
