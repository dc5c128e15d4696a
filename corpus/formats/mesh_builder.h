// Collects the vertices and polygons of one mesh file and refuses what no mesh may hold.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "corpus/formats/mesh_reader.h"
#include "corpus/problem.h"

namespace assay::corpus {

std::string shown(const Place& place);

// REQUIRES: every call gets the place that a reader of the message should look at.
class MeshBuilder {
 public:
  // first_number: of a vertex, as the file counts; messages count so too.
  explicit MeshBuilder(const std::filesystem::path& file, int first_number = 0)
      : file_(file), first_number_(first_number) {}

  // Refuses a coordinate that is not finite, and more vertices than indices can name.
  Expected<void> add_vertex(double x, double y, double z, const Place& place);

  // Adds a polygon as a fan of triangles from its first vertex. Vertices are counted from 0. They
  // may be added later, because finish() checks their range. Refuses fewer than three, an index out
  // of any range, and a triangle that names one vertex twice.
  Expected<void> add_polygon(std::span<const std::int64_t> vertices, const Place& place);

  // Counts what is no part of the mesh, in the singular: "line (l)".
  void skip(const std::string& what, std::size_t count = 1);
  // Something in the file that its author should know of, in words.
  void remark(std::string line) { remarks_.push_back(std::move(line)); }

  std::size_t vertex_count() const { return coordinates_.size() / 3; }

  Problem problem(const Place& place, std::string_view detail) const;

  // The mesh, with remarks on what was split or skipped. Refuses one without a triangle, and an
  // index beyond its vertices.
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
  // The highest index so far and its place: finish() needs no more to name an index without a
  // vertex.
  std::int64_t highest_ = -1;
  Place highest_place_ = {"line", 0};
};

}  // namespace assay::corpus
