#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/outcome/try.hpp>
#include <cctype>
#include <iterator>

#include "corpus/formats/mesh_reader.h"
#include "corpus/formats/text_lines.h"

namespace assay::corpus {
namespace {

using Words = std::vector<std::string_view>;

// Statements of the format that have no bearing on vertices and faces.
constexpr std::array<std::string_view, 34> passed_over = {
    "vt",         "vn",        "vp",     "g",     "o",    "s",    "mg",    "usemtl",   "mtllib",
    "usemap",     "maplib",    "cstype", "deg",   "bmat", "step", "curv2", "parm",     "trim",
    "hole",       "scrv",      "sp",     "end",   "con",  "lod",  "bevel", "c_interp", "d_interp",
    "shadow_obj", "trace_obj", "ctech",  "stech", "cdc",  "cdp",  "res"};

// A statement that the mesh leaves out: other geometry, or a file or command that can make some.
struct Skipped {
  std::string_view keyword;
  const char* what;
};
constexpr Skipped skipped_statements[] = {{"l", "line (l)"},        {"p", "point (p)"},
                                          {"curv", "curve (curv)"}, {"surf", "surface (surf)"},
                                          {"bsp", "surface (bsp)"}, {"bzp", "surface (bzp)"},
                                          {"call", "file (call)"},  {"csh", "command (csh)"}};

// Reads a vertex. `weighted` counts the vertices whose fourth number is a weight other than 1.
Expected<void> read_vertex(const Words& words, const Place& place, MeshBuilder& builder,
                           std::size_t& weighted) {
  std::array<double, 3> x{};
  if (words.size() < 4) {
    return builder.problem(place, "a vertex has fewer than 3 coordinates");
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const auto value = parse_double(words[k + 1]);
    if (!value) {
      const bool has_comma = words[k + 1].find(',') != std::string_view::npos;
      return builder.problem(place, excerpt(words[k + 1]) + " is no number" +
                                        (has_comma ? ": write decimals with a point" : ""));
    }
    x[k] = *value;
  }
  if (words.size() == 5 && parse_double(words[4]) != 1) ++weighted;
  return builder.add_vertex(x[0], x[1], x[2], place);
}

// Returns the vertex of a corner v, v/vt, v//vn or v/vt/vn; nothing when it is none of these.
std::optional<std::int64_t> corner_vertex(std::string_view corner) {
  std::array<std::string_view, 3> parts;
  std::size_t count = 0;
  while (true) {
    const std::size_t slash = std::min(corner.find('/'), corner.size());
    if (count == 3) return std::nullopt;
    parts[count++] = corner.substr(0, slash);
    if (slash == corner.size()) break;
    corner.remove_prefix(slash + 1);
  }
  for (std::size_t i = 1; i < count; ++i) {
    if (!parts[i].empty() && !parse_integer(parts[i])) return std::nullopt;
  }
  return parse_integer(parts[0]);
}

Expected<void> read_face(const Words& words, const Place& place, MeshBuilder& builder,
                         std::vector<std::int64_t>& vertices) {
  vertices.clear();
  const auto count = static_cast<std::int64_t>(builder.vertex_count());
  for (std::size_t i = 1; i < words.size(); ++i) {
    const auto vertex = corner_vertex(words[i]);
    if (!vertex) {
      return builder.problem(place, excerpt(words[i]) + " is no corner of a face");
    }
    if (*vertex == 0 || *vertex < -count) {
      return builder.problem(
          place,
          fmt::format("vertex index {} is out of range ({} vertices so far)", *vertex, count));
    }
    vertices.push_back(*vertex > 0 ? *vertex - 1 : count + *vertex);
  }
  return builder.add_polygon(vertices, place);
}

}  // namespace

Expected<Mesh> read_obj(std::string_view text, const std::filesystem::path& file) {
  constexpr int first_number = 1;
  MeshBuilder builder(file, first_number);
  Lines lines(text, '#', true);
  Words words;
  std::vector<std::int64_t> vertices;
  std::string lower;
  std::size_t weighted = 0;
  while (const auto line = lines.next()) {
    split_words(*line, words);
    const Place place = {"line", lines.number()};
    lower = words[0];
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const auto* other = std::ranges::find(skipped_statements, lower, &Skipped::keyword);
    if (lower == "v") {
      BOOST_OUTCOME_TRY(read_vertex(words, place, builder, weighted));
    } else if (lower == "f" || lower == "fo") {  // fo is its name in old files
      BOOST_OUTCOME_TRY(read_face(words, place, builder, vertices));
    } else if (other != std::end(skipped_statements)) {
      builder.skip(other->what);
    } else if (std::ranges::find(passed_over, lower) == passed_over.end()) {
      return builder.problem(place, excerpt(words[0]) + " is no statement of an OBJ file");
    }
  }
  if (weighted > 0) {
    builder.remark(fmt::format(
        "{} of {} vertices have a weight (a fourth number) other than 1; weights are not looked at",
        weighted, builder.vertex_count()));
  }
  return builder.finish();
}

}  // namespace assay::corpus
