// Reads triangle meshes: OBJ, PLY (ascii and binary), OFF, each also compressed with gzip.
//
// Guarantee: a decimal number becomes the double nearest to it (ties to even); float32 and integer
// values convert exactly; nothing is merged, moved or reordered: vertex i of the file is row i, and
// triangles keep the file's order. A polygon is fanned from its first vertex. Refused, in words: an
// index out of range, an index repeated in a triangle, a coordinate that is not finite, and all
// that MeshBuilder refuses. NOT refused, because the detector judges them: two triangles with the
// same three vertices, unused or duplicate vertices, zero-area triangles.
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

// Where each triangle's face stands in its file.
struct FacePlaces {
  const char* unit = "line";
  std::vector<std::uint32_t> numbers;
};

struct Mesh {
  detector::Positions positions;
  detector::Triangles triangles;
  // One line for each kind of content that was split, is ignored, or is suspect.
  std::vector<std::string> remarks = {};
  FacePlaces places = {};
};

// Reads a mesh. The content tells the format if it has a signature (PLY, OFF, gzip), otherwise the
// extension does (.obj, .obj.gz).
Expected<Mesh> read_mesh(const std::filesystem::path& path);

// Refuses a file for faults that show without reading all of it: the file is missing, may not be
// read, is empty or has no known format. The problem is that of read_mesh.
Expected<void> look_at_mesh(const std::filesystem::path& path);

// Returns where in the file two faces have the same three vertices: "lines 12 and 16"; empty if
// none have, or the file cannot be read.
std::string places_of_same_faces(const std::filesystem::path& file);

// The readers of the formats. Each takes the bytes of a file; `file` stands for it in messages.

// Reads OBJ. `v` and `f` (v, v/vt, v//vn, v/vt/vn, negative indices, polygons) make the mesh;
// texture coordinates, normals, groups and materials are passed over; lines, points, curves and
// surfaces too, with a remark. A line with any other keyword is refused, so that noise is not taken
// for a mesh.
Expected<Mesh> read_obj(std::string_view text, const std::filesystem::path& file);

// Returns whether the text begins as an OFF file: OFF after the optional letters ST, C, N, 4, n,
// capital or not. A file named *.off may lack the word.
bool looks_like_off(std::string_view text);
// Reads OFF in text form: a header word, the counts, one vertex a line and one polygon a line; `#`
// starts a comment. Normals, colours and texture coordinates are passed over, faces of one or two
// corners too, with a remark; 4-dimensional and binary files are refused.
Expected<Mesh> read_off(std::string_view text, const std::filesystem::path& file);

bool looks_like_ply(std::string_view bytes);
// Reads PLY, ascii, binary little-endian and big-endian: x, y, z of any type from element `vertex`,
// and from element `face` a list vertex_indices or vertex_index of an integer type. All other
// elements (with a remark) and properties are skipped.
Expected<Mesh> read_ply(std::string_view bytes, const std::filesystem::path& file);

// Collects the vertices and polygons of one mesh file and refuses content that no mesh may hold.

std::string shown(const Place& place);

// REQUIRES: every call gets the place that a reader of the message should look at.
class MeshBuilder {
 public:
  // first_number: the number of the first vertex, as the file counts; messages count in the same
  // way.
  explicit MeshBuilder(const std::filesystem::path& file, int first_number = 0)
      : file_(file), first_number_(first_number) {}

  // Refuses a coordinate that is not finite, and more vertices than indices can name.
  Expected<void> add_vertex(double x, double y, double z, const Place& place);

  // Adds a polygon as a fan of triangles from its first vertex. Vertices are counted from 0. They
  // may be added later, because finish() checks their range. Refuses fewer than three, an index out
  // of any range, and a triangle that names one vertex twice.
  Expected<void> add_polygon(std::span<const std::int64_t> vertices, const Place& place);

  // Counts content that is no part of the mesh. `what` names it in the singular: "line (l)".
  void skip(const std::string& what, std::size_t count = 1);
  // Adds a remark on something in the file that its author should know of.
  void remark(std::string line) { remarks_.push_back(std::move(line)); }

  std::size_t vertex_count() const { return coordinates_.size() / 3; }

  Problem problem(const Place& place, std::string_view detail) const;

  // Returns the mesh, with remarks on content that was split or skipped. Refuses a mesh without a
  // triangle, and an index beyond its vertices.
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
  // The highest index so far, and its place: with these, finish() names an index without a vertex.
  std::int64_t highest_ = -1;
  Place highest_place_ = {"line", 0};
};

}  // namespace assay::corpus
