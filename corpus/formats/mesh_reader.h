// Reads triangle meshes: OBJ, PLY (ascii and binary), OFF, each also compressed with gzip.
//
// Guarantee: a decimal number becomes the double nearest to it (ties to even); float32 and integer
// values convert exactly; nothing is merged, moved or reordered: vertex i of the file is row i, and
// triangles keep the file's order. A polygon is split into a fan of triangles from its first
// vertex. The readers refuse an index out of range, an index repeated in a triangle, a coordinate
// that is not finite, and all else that MeshBuilder refuses; a message says why. They do NOT refuse
// two triangles with the same three vertices, unused or duplicate vertices, and zero-area
// triangles, because the detector judges these.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/problem.h"
#include "detector/mesh/types.h"

namespace assay::corpus {

// A place in a file, for messages: `line 12`, `byte 345`.
struct Place {
  const char* unit;
  std::size_t number;
};

// For each triangle, the line or byte of its file at which its face begins.
struct FacePlaces {
  const char* unit = "line";
  std::vector<std::uint32_t> numbers;
};

struct Mesh {
  detector::Positions positions;
  detector::Triangles triangles;
  // One line for each kind of content that the reader split or ignored, or that is suspect.
  std::vector<std::string> remarks = {};
  FacePlaces places = {};
};

// Reads a mesh. A signature in the content tells the format (PLY, OFF, gzip); without a signature,
// the extension tells it (.obj, .obj.gz).
Expected<Mesh> read_mesh(const std::filesystem::path& path);

// Refuses a file for a fault that shows without reading all of the file: the file is missing,
// cannot be read, is empty or has no known format. Returns the same problem as read_mesh.
Expected<void> look_at_mesh(const std::filesystem::path& path);

// Returns where in the file two faces have the same three vertices: "lines 12 and 16"; empty if no
// two faces have the same vertices, or if the file cannot be read.
std::string places_of_same_faces(const std::filesystem::path& file);

// The readers of the formats. Each takes the bytes of a file; messages begin with `file`.

// Reads OBJ. `v` and `f` (v, v/vt, v//vn, v/vt/vn, negative indices, polygons) make the mesh;
// texture coordinates, normals, groups and materials are ignored; lines, points, curves and
// surfaces are ignored with a remark. A line with any other keyword is refused, so that noise is
// not taken for a mesh.
Expected<Mesh> read_obj(std::string_view text, const std::filesystem::path& file);

// Returns whether the text begins with the word of an OFF file: OFF after the optional letters ST,
// C, N, 4, n, in capitals or not. A file named *.off may lack this word.
bool looks_like_off(std::string_view text);
// Reads OFF in text form: a header word, the counts, one vertex a line and one polygon a line; `#`
// starts a comment. Normals, colours and texture coordinates are ignored; faces of one or two
// corners are ignored with a remark; 4-dimensional and binary files are refused.
Expected<Mesh> read_off(std::string_view text, const std::filesystem::path& file);

bool looks_like_ply(std::string_view bytes);
// Reads PLY, ascii, binary little-endian and big-endian: x, y, z of any type from element `vertex`,
// and from element `face` a list vertex_indices or vertex_index of an integer type. All other
// properties are ignored; all other elements are ignored with a remark.
Expected<Mesh> read_ply(std::string_view bytes, const std::filesystem::path& file);

// Returns the place as messages show it: "line 12".
std::string shown(const Place& place);

// Collects the vertices and polygons of one mesh file, and refuses content that no mesh can hold.
// Messages name the `place` in the file that a call gives for its vertex or polygon.
class MeshBuilder {
 public:
  // first_number: the number that the file's format gives to its first vertex; messages number
  // vertices in the same way.
  explicit MeshBuilder(const std::filesystem::path& file, int first_number = 0)
      : file_(file), first_number_(first_number) {}

  // Refuses a coordinate that is not finite, and more vertices than indices can name.
  Expected<void> add_vertex(double x, double y, double z, const Place& place);

  // Adds a polygon as a fan of triangles from its first vertex. Vertices are numbered from 0. They
  // may be added later, because finish() checks the range of the indices. Refuses fewer than three
  // vertices, an index that no mesh can have, and a triangle that names one vertex twice.
  Expected<void> add_polygon(std::span<const std::int64_t> vertices, const Place& place);

  // Counts ignored content of the file. `what` names the content in the singular: "line (l)".
  void skip(const std::string& what, std::size_t count = 1);
  // Adds a remark on content of the file that the user should know of.
  void remark(std::string line) { remarks_.push_back(std::move(line)); }

  std::size_t vertex_count() const { return coordinates_.size() / 3; }

  Problem problem(const Place& place, std::string_view detail) const;

  // Returns the mesh, with remarks on content that was split or skipped. Refuses a mesh without a
  // triangle, and an index that names no vertex.
  Expected<Mesh> finish();

 private:
  std::filesystem::path file_;
  std::int64_t first_number_;
  std::vector<double> coordinates_;
  std::vector<std::int32_t> corners_;
  FacePlaces places_;
  std::size_t split_ = 0;  // polygons of more than three corners
  std::map<std::string, std::size_t> skipped_;
  std::vector<std::string> remarks_;
  // The highest index so far, and its place: finish() names them if there is no such vertex.
  std::int64_t highest_ = -1;
  Place highest_place_ = {"line", 0};
};

}  // namespace assay::corpus
