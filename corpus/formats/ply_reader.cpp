#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <boost/outcome/try.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

#include "corpus/formats/mesh_reader.h"
#include "corpus/formats/text_lines.h"

namespace assay::corpus {
namespace {

// The header: which elements follow, and how their properties are laid out.

enum class PlyEncoding { ascii, little_endian, big_endian };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

// Returns the size of a value in a binary file, in bytes.
std::size_t size_of(PlyType type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

bool is_integer(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

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

std::optional<PlyType> type_named(std::string_view word) {
  if (word == "char" || word == "int8") return PlyType::int8;
  if (word == "uchar" || word == "uint8") return PlyType::uint8;
  if (word == "short" || word == "int16") return PlyType::int16;
  if (word == "ushort" || word == "uint16") return PlyType::uint16;
  if (word == "int" || word == "int32") return PlyType::int32;
  if (word == "uint" || word == "uint32") return PlyType::uint32;
  if (word == "int64") return PlyType::int64;  // of meshio
  if (word == "uint64") return PlyType::uint64;
  if (word == "float" || word == "float32") return PlyType::float32;
  if (word == "double" || word == "float64") return PlyType::float64;
  return std::nullopt;
}

// A problem names the line.
class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::filesystem::path& file)
      : bytes_(bytes),
        line_end_(bytes.starts_with("ply\r") && !bytes.starts_with("ply\r\n") ? '\r' : '\n'),
        file_(file) {}

  Expected<PlyHeader> read() {
    bool format_seen = false;
    while (true) {
      const std::size_t end = bytes_.find(line_end_, header_.size);
      if (end == std::string_view::npos) {
        return wrong("the header has no end_header");
      }
      split_words(bytes_.substr(header_.size, end - header_.size), words_);
      header_.size = end + 1;
      ++header_.lines;
      if (words_.empty()) continue;
      if (words_[0] == "end_header") break;
      if (words_[0] == "format") format_seen = true;
      BOOST_OUTCOME_TRY(statement());
    }
    if (!format_seen) return wrong("the header names no format");
    return std::move(header_);
  }

 private:
  Problem wrong(std::string_view detail) const {
    return problem_in(file_, fmt::format("line {}: {}", header_.lines, detail));
  }

  Expected<void> statement() {
    if (words_[0] == "format") return format();
    if (words_[0] == "element") return element();
    if (words_[0] == "property") return property();
    const bool passed_over = words_[0] == "comment" || words_[0] == "obj_info" ||
                             (words_[0] == "ply" && header_.lines == 1);
    if (!passed_over) return wrong(excerpt(words_[0]) + " is no statement of a PLY header");
    return boost::outcome_v2::success();
  }

  Expected<void> format() {
    const std::string_view name = words_.size() == 3 && words_[2] == "1.0" ? words_[1] : "";
    if (name == "ascii") {
      header_.encoding = PlyEncoding::ascii;
    } else if (name == "binary_little_endian") {
      header_.encoding = PlyEncoding::little_endian;
    } else if (name == "binary_big_endian") {
      header_.encoding = PlyEncoding::big_endian;
    } else {
      return wrong("unknown PLY format");
    }
    return boost::outcome_v2::success();
  }

  Expected<void> element() {
    const auto count = words_.size() == 3 ? parse_integer(words_[2]) : std::nullopt;
    if (!count || *count < 0) return wrong("\"element NAME COUNT\" expected");
    const auto same = [&](const PlyElement& other) { return other.name == words_[1]; };
    if (std::any_of(header_.elements.begin(), header_.elements.end(), same)) {
      return wrong(fmt::format("element {} is declared twice", excerpt(words_[1])));
    }
    header_.elements.push_back({std::string(words_[1]), static_cast<std::uint64_t>(*count), {}});
    return boost::outcome_v2::success();
  }

  Expected<void> property() {
    if (header_.elements.empty()) return wrong("a property stands before the first element");
    PlyProperty property;
    const bool list = words_.size() == 5 && words_[1] == "list";
    if (!list && words_.size() != 3) return wrong("\"property TYPE NAME\" expected");
    property.name = std::string(words_.back());
    const auto type = type_named(words_[words_.size() - 2]);
    if (!type) return wrong(excerpt(words_[words_.size() - 2]) + " is no PLY type");
    property.type = *type;
    if (list) {
      property.count_type = type_named(words_[2]);
      if (!property.count_type || !is_integer(*property.count_type)) {
        return wrong(excerpt(words_[2]) + " is no integer type for a list's count");
      }
    }
    std::vector<PlyProperty>& properties = header_.elements.back().properties;
    const auto same = [&](const PlyProperty& other) { return other.name == property.name; };
    if (std::any_of(properties.begin(), properties.end(), same)) {
      return wrong(fmt::format("property {} is declared twice", excerpt(property.name)));
    }
    properties.push_back(std::move(property));
    return boost::outcome_v2::success();
  }

  std::string_view bytes_;
  char line_end_;
  const std::filesystem::path& file_;
  PlyHeader header_;
  std::vector<std::string_view> words_;
};

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

// Returns the number whose two's complement is the low `size` bytes.
std::int64_t sign_extended(std::uint64_t bits, std::size_t size) {
  const int unused = static_cast<int>(64 - 8 * size);
  return static_cast<std::int64_t>(bits << unused) >> unused;
}

bool is_signed(PlyType type) {
  return type == PlyType::int8 || type == PlyType::int16 || type == PlyType::int32 ||
         type == PlyType::int64;
}

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

  // Returns the next value; `parse` reads it where it is a word. Fails at the end of the file, and
  // when a word is no number of that kind. REQUIRES an integer type where the number is an integer.
  template <class Number>
  Expected<Number> read(PlyType type, std::optional<Number> (*parse)(std::string_view)) {
    if (is_ascii()) {
      const std::string_view text = word();
      if (text.empty()) return truncated();
      const auto value = parse(text);
      if (!value) return malformed(text);
      return *value;
    }
    if (!has_room(1, size_of(type))) return truncated();
    const std::uint64_t raw = bits(size_of(type));
    if (type == PlyType::float64) return static_cast<Number>(std::bit_cast<double>(raw));
    if (type == PlyType::float32) {
      return static_cast<Number>(std::bit_cast<float>(static_cast<std::uint32_t>(raw)));
    }
    if (is_signed(type)) return static_cast<Number>(sign_extended(raw, size_of(type)));
    return static_cast<Number>(raw);
  }
  Expected<void> skip(PlyType type, std::uint64_t count) {
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

  // Returns whether `count` more items may follow, each of `least_size` bytes in a binary body, or
  // of a word in an ascii one. Asked before anything is sized by a number that the file claims.
  bool has_room(std::uint64_t count, std::uint64_t least_size) const {
    // A word takes one character at least.
    const std::uint64_t size = is_ascii() ? 1 : least_size;
    return size == 0 || count <= (bytes_.size() - offset_) / size;
  }

  // Returns true when nothing is left, in an ascii body nothing but blanks.
  bool at_end() {
    if (is_ascii()) skip_blanks();
    return offset_ == bytes_.size();
  }

  Place place() const { return is_ascii() ? Place{"line", line_} : Place{"byte", offset_}; }
  // Returns where the next value begins.
  Place next_place() {
    if (is_ascii()) skip_blanks();
    return place();
  }

 private:
  bool is_ascii() const { return encoding_ == PlyEncoding::ascii; }
  void skip_blanks() {
    while (offset_ < bytes_.size() && is_blank(bytes_[offset_])) {
      if (bytes_[offset_] == '\n') ++line_;
      ++offset_;
    }
  }
  std::string_view word() {
    skip_blanks();
    const std::size_t begin = offset_;
    while (offset_ < bytes_.size() && !is_blank(bytes_[offset_])) ++offset_;
    return bytes_.substr(begin, offset_ - begin);
  }
  // Returns the next value as the low bytes of an integer. REQUIRES that it is there.
  std::uint64_t bits(std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t byte = encoding_ == PlyEncoding::big_endian ? size - 1 - i : i;
      value |= std::uint64_t{static_cast<unsigned char>(bytes_[offset_ + i])} << (8 * byte);
    }
    offset_ += size;
    return value;
  }
  Problem truncated() const {
    return problem_in(
        file_, fmt::format("{}: the file ends, but its header states more values", shown(place())));
  }
  Problem malformed(std::string_view word) const {
    return problem_in(file_, fmt::format("{}: {} is not of the type in the header", shown(place()),
                                         excerpt(word)));
  }

  std::string_view bytes_;
  const std::filesystem::path& file_;
  PlyEncoding encoding_;
  std::size_t offset_;
  std::size_t line_;
};

// The use of a property: a coordinate, the corners of a face, or nothing.
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
      return problem_in(file_, "element vertex lacks a property x, y or z");
    }
    if (element.name == "face" && found[static_cast<std::size_t>(Role::corners)] != 1) {
      return problem_in(
          file_, "element face has no list of integers named vertex_indices or vertex_index");
    }
    if (!body_.has_room(element.count, least_size)) {
      return builder_.problem(body_.place(),
                              fmt::format("{} rows of element {} do not fit into the rest of the "
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
        BOOST_OUTCOME_TRY(value, body_.read(property.type, parse_double));
        x[static_cast<std::size_t>(roles[i])] = value;
      }
    }
    if (vertices) return builder_.add_vertex(x[0], x[1], x[2], place);
    return boost::outcome_v2::success();
  }

  Expected<void> read_list(const PlyProperty& property, Role role, const Place& place) {
    BOOST_OUTCOME_TRY(count, body_.read(*property.count_type, parse_integer));
    if (count < 0) return builder_.problem(place, "a list of negative size");
    const auto items = static_cast<std::uint64_t>(count);
    if (!body_.has_room(items, size_of(property.type))) {
      return builder_.problem(
          place, fmt::format("a list of {} items does not fit into the rest of the file", items));
    }
    if (role != Role::corners) return body_.skip(property.type, items);
    corners_.clear();
    for (std::uint64_t i = 0; i < items; ++i) {
      BOOST_OUTCOME_TRY(vertex, body_.read(property.type, parse_integer));
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

bool looks_like_ply(std::string_view bytes) {
  return bytes.starts_with("ply") && bytes.find_first_of("\r\n") == bytes.find_first_not_of(" ", 3);
}

Expected<Mesh> read_ply(std::string_view bytes, const std::filesystem::path& file) {
  BOOST_OUTCOME_TRY(header, HeaderReader(bytes, file).read());
  return PlyReader(bytes, header, file).read();
}

}  // namespace assay::corpus
