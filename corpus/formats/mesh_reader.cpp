#include "corpus/formats/mesh_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/outcome/try.hpp>
#include <cctype>
#include <cmath>
#include <limits>
#include <new>

#include "corpus/files.h"
#include "corpus/formats/text_lines.h"

namespace assay::corpus {

namespace {

// Returns the extension without .gz, in lower case: ".obj" for SHELL.OBJ.gz.
std::string mesh_extension(std::filesystem::path path) {
  const auto lower = [](std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
  };
  if (lower(path.extension().string()) == ".gz") path.replace_extension();
  return lower(path.extension().string());
}

enum class Format { ply, off, obj };

// This many bytes at the start, and the name, tell the format.
constexpr std::size_t format_bytes = 4096;

// Formats that are not read, by the ends of names.
struct OtherFormat {
  std::string_view ends, name;
  // The format in which meshio writes it without loss; empty if meshio does not read it.
  std::string_view by_meshio = {};
};
constexpr OtherFormat other_formats[] = {{".stl", "an STL", ".ply"},
                                         {".vtk", "a VTK", ".obj"},
                                         {".vtu", "a VTK", ".ply"},
                                         {".vtp", "a VTK"},
                                         {".msh", "a Gmsh", ".ply"},
                                         {".inp", "an Abaqus", ".ply"},
                                         {".xdmf.xmf", "an XDMF", ".ply"},
                                         {".mesh.meshb", "a Medit", ".ply"},
                                         {".usd.usda.usdc.usdz", "a USD"},
                                         {".abc", "an Alembic"},
                                         {".gltf.glb", "a glTF"},
                                         {".fbx", "an FBX"},
                                         {".dae", "a COLLADA"},
                                         {".blend", "a Blender"},
                                         {".ma.mb", "a Maya"},
                                         {".3dm", "a Rhino"},
                                         {".bgeo.geo", "a Houdini"},
                                         {".3ds.3mf.x3d.wrl", "a 3D"},
                                         {".step.stp.igs.iges", "a CAD"}};

Problem unknown_format(const std::filesystem::path& path, std::string_view bytes) {
  const auto end = mesh_extension(path);
  const std::string read = "only OBJ, PLY and OFF are read: ";
  if (end == ".npz" || end == ".npy")
    return problem_in(path, "a NumPy file; " + read + "use assay.check in Python");
  for (const auto& [ends, name, by_meshio] : other_formats) {
    if (end.empty() || (std::string(ends) + ".").find(end + ".") == std::string::npos) continue;
    if (by_meshio.empty())
      return problem_in(path, fmt::format("{} file; {}export it as one of these", name, read));
    // A name that a shell or Python would misread is left for the user to fill in.
    const bool is_plain = std::ranges::all_of(path.string(), [](unsigned char c) {
      return c >= 0x80 || std::isalnum(c) ||
             std::string_view("._-+/ ").find(c) != std::string_view::npos;
    });
    const auto file = is_plain ? path : std::filesystem::path("FILE" + end);
    const auto converted = std::filesystem::path(file).replace_extension(by_meshio);
    return problem_in(
        path, fmt::format("{} file; {}use python3 -c \"import meshio; meshio.read('{}')"
                          ".write('{}')\" (python3-meshio of Debian, or pip install meshio)",
                          name, read, file.string(), converted.string()));
  }
  const auto line = bytes.substr(0, bytes.find_first_of("\r\n"));
  const bool is_text = std::ranges::all_of(line, [](char c) { return c >= ' ' && c <= '~'; });
  return problem_in(
      path,
      fmt::format("{}: this is neither PLY nor OFF, its name does not end with .obj, and it is no "
                  "case file, log or query file (assay check --help)",
                  is_text ? "it begins with " + excerpt(line) : "it is no text"));
}

Expected<Format> format_of(std::string_view bytes, const std::filesystem::path& path) {
  if (looks_like_ply(bytes)) return Format::ply;
  if (looks_like_off(bytes)) return Format::off;
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF"))
    return problem_in(path, "text of two bytes a letter (UTF-16): save it as UTF-8");
  if (mesh_extension(path) == ".obj") return Format::obj;
  if (mesh_extension(path) == ".off") return Format::off;
  return unknown_format(path, bytes);
}

// Refuses a folder with a word on its contents.
Expected<void> refuse_folder(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(path, ignored)) return boost::outcome_v2::success();
  std::map<std::string, std::size_t> counts = {{".obj", 0}, {".off", 0}, {".ply", 0}};
  for (const auto& entry : std::filesystem::directory_iterator(path, ignored)) {
    const auto count = counts.find(mesh_extension(entry.path()));
    if (count != counts.end()) ++count->second;
  }
  const auto most = std::ranges::max_element(counts, {}, [](const auto& c) { return c.second; });
  const auto where = path.has_filename() ? path : path.parent_path();
  return problem_in(path, "cannot be read: Is a directory" +
                              (most->second == 0 ? ", and it holds no OBJ, PLY or OFF file"
                                                 : fmt::format(": give its files, {}/*{}",
                                                               where.string(), most->first)));
}

Expected<Mesh> parse_mesh(std::string_view bytes, const std::filesystem::path& path) {
  bytes = without_mark(bytes);
  BOOST_OUTCOME_TRY(format, format_of(bytes.substr(0, format_bytes), path));
  switch (format) {
    case Format::ply:
      return read_ply(bytes, path);
    case Format::off:
      return read_off(bytes, path);
    case Format::obj:
      break;
  }
  return read_obj(bytes, path);
}

}  // namespace

Expected<Mesh> read_mesh(const std::filesystem::path& path) try {
  BOOST_OUTCOME_TRYV(refuse_folder(path));
  BOOST_OUTCOME_TRY(bytes, read_bytes(path));
  return parse_mesh(bytes, path);
} catch (const std::bad_alloc&) {
  return problem_in(path, "larger than the memory at hand");
}

Expected<void> look_at_mesh(const std::filesystem::path& path) {
  BOOST_OUTCOME_TRYV(refuse_folder(path));
  BOOST_OUTCOME_TRY(start, read_start(path, format_bytes));
  if (start.empty()) return boost::outcome_v2::success();
  BOOST_OUTCOME_TRYV(format_of(without_mark(start), path));
  return boost::outcome_v2::success();
}

std::string places_of_same_faces(const std::filesystem::path& file) {
  const auto mesh = read_mesh(file);
  if (!mesh) return "";
  const auto& [unit, numbers] = mesh.value().places;
  std::map<std::array<std::int32_t, 3>, std::size_t> places_by_corners;
  for (std::size_t t = 0; t < numbers.size(); ++t) {
    const auto row = mesh.value().triangles.row(static_cast<Eigen::Index>(t));
    std::array<std::int32_t, 3> corners = {row[0], row[1], row[2]};
    std::ranges::sort(corners);
    const auto [first, is_new] = places_by_corners.emplace(corners, t);
    if (!is_new) return fmt::format("{}s {} and {}", unit, numbers[first->second], numbers[t]);
  }
  return "";
}

namespace {

constexpr std::int64_t most_vertices = std::numeric_limits<std::int32_t>::max();

}  // namespace

std::string shown(const Place& place) { return fmt::format("{} {}", place.unit, place.number); }

Problem MeshBuilder::problem(const Place& place, std::string_view detail) const {
  return problem_in(file_, fmt::format("{}: {}", shown(place), detail));
}

Expected<void> MeshBuilder::add_vertex(double x, double y, double z, const Place& place) {
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) {
    return problem(place,
                   fmt::format("vertex {} ({}, {}, {}) is not finite", vertex_count(), x, y, z));
  }
  if (static_cast<std::int64_t>(vertex_count()) >= most_vertices) {
    return problem(place, "more vertices than 32-bit indices can name");
  }
  coordinates_.insert(coordinates_.end(), {x, y, z});
  return boost::outcome_v2::success();
}

Expected<void> MeshBuilder::add_polygon(std::span<const std::int64_t> vertices,
                                        const Place& place) {
  if (vertices.size() < 3) {
    return problem(place, fmt::format("a face has only {} vertices", vertices.size()));
  }
  for (const std::int64_t vertex : vertices) {
    if (vertex < 0 || vertex >= most_vertices) {
      return problem(place, fmt::format("vertex index {} (counted from {}) is out of range",
                                        vertex + first_number_, first_number_));
    }
    if (vertex > highest_) {
      highest_ = vertex;
      highest_place_ = place;
    }
  }
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
    const std::int64_t a = vertices[0], b = vertices[i], c = vertices[i + 1];
    if (a == b || b == c || a == c) {
      return problem(
          place,
          fmt::format("triangle ({}, {}, {}) (counted from {}) names a vertex twice",
                      a + first_number_, b + first_number_, c + first_number_, first_number_));
    }
    corners_.insert(corners_.end(), {static_cast<std::int32_t>(a), static_cast<std::int32_t>(b),
                                     static_cast<std::int32_t>(c)});
    places_.numbers.push_back(static_cast<std::uint32_t>(place.number));
  }
  places_.unit = place.unit;
  if (vertices.size() > 3) ++split_;
  return boost::outcome_v2::success();
}

void MeshBuilder::skip(const std::string& what, std::size_t count) { skipped_[what] += count; }

Expected<Mesh> MeshBuilder::finish() {
  if (split_ > 0) {
    remark(split_ == 1 ? "1 face of more than 3 corners is split into triangles at its first corner"
                       : fmt::format("{} faces of more than 3 corners are split into triangles at "
                                     "their first corners",
                                     split_));
  }
  std::string skipped;
  for (const auto& [what, count] : skipped_) {
    const auto noun = std::min(what.find(' '), what.size());
    skipped += fmt::format("{} {} {}{}{}", skipped.empty() ? "not looked at:" : ",", count,
                           what.substr(0, noun), count == 1 ? "" : "s", what.substr(noun));
  }
  if (!skipped.empty()) remark(skipped);
  if (corners_.empty()) {
    return problem_in(file_, fmt::format("{} vertices and no triangle{}{}", vertex_count(),
                                         skipped.empty() ? "" : "; ", skipped));
  }
  if (highest_ >= static_cast<std::int64_t>(vertex_count())) {
    return problem(highest_place_,
                   fmt::format("vertex index {} (counted from {}) is too large for {} vertices",
                               highest_ + first_number_, first_number_, vertex_count()));
  }
  Mesh mesh;
  mesh.positions.resize(static_cast<Eigen::Index>(vertex_count()), 3);
  std::copy(coordinates_.begin(), coordinates_.end(), mesh.positions.data());
  mesh.triangles.resize(static_cast<Eigen::Index>(corners_.size() / 3), 3);
  std::copy(corners_.begin(), corners_.end(), mesh.triangles.data());
  mesh.places = std::move(places_);
  mesh.remarks = std::move(remarks_);
  return mesh;
}

}  // namespace assay::corpus
