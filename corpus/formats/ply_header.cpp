#include "corpus/formats/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/outcome/try.hpp>

#include "corpus/formats/text_lines.h"

namespace assay::corpus {
namespace {

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
    if (!count || *count < 0) return wrong("element, a name and a count expected");
    const auto same = [&](const PlyElement& other) { return other.name == words_[1]; };
    if (std::any_of(header_.elements.begin(), header_.elements.end(), same)) {
      return wrong(fmt::format("element {} is declared twice", excerpt(words_[1])));
    }
    header_.elements.push_back({std::string(words_[1]), static_cast<std::uint64_t>(*count), {}});
    return boost::outcome_v2::success();
  }

  Expected<void> property() {
    if (header_.elements.empty()) return wrong("a property before any element");
    PlyProperty property;
    const bool list = words_.size() == 5 && words_[1] == "list";
    if (!list && words_.size() != 3) return wrong("property, a type and a name expected");
    property.name = std::string(words_.back());
    const auto type = type_named(words_[words_.size() - 2]);
    if (!type) return wrong(excerpt(words_[words_.size() - 2]) + " is no PLY type");
    property.type = *type;
    if (list) {
      property.count_type = type_named(words_[2]);
      if (!property.count_type || !is_integer(*property.count_type)) {
        return wrong(excerpt(words_[2]) + " is no integer type to count a list");
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

}  // namespace

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      return 4;
    case PlyType::int64:
    case PlyType::uint64:
    case PlyType::float64:
      return 8;
  }
  return 8;
}

bool is_integer(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

bool looks_like_ply(std::string_view bytes) {
  return bytes.starts_with("ply") && bytes.find_first_of("\r\n") == bytes.find_first_not_of(" ", 3);
}

Expected<PlyHeader> read_ply_header(std::string_view bytes, const std::filesystem::path& file) {
  return HeaderReader(bytes, file).read();
}

}  // namespace assay::corpus
