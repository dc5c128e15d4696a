// Puts a mesh together vertex by vertex.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "corpus/formats/mesh_reader.h"

namespace assay::corpus {

class MeshMaker {
 public:
  std::int32_t vertex(const detector::Point& x) {
    coordinates_.insert(coordinates_.end(), x.begin(), x.end());
    return static_cast<std::int32_t>(coordinates_.size() / 3) - 1;
  }

  void triangle(std::int32_t a, std::int32_t b, std::int32_t c) {
    corners_.insert(corners_.end(), {a, b, c});
  }

  // Takes corners counter-clockwise, and splits the quad along ac.
  void quad(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }

  Mesh mesh() const {
    Mesh mesh;
    mesh.positions.resize(static_cast<Eigen::Index>(coordinates_.size() / 3), 3);
    std::copy(coordinates_.begin(), coordinates_.end(), mesh.positions.data());
    mesh.triangles.resize(static_cast<Eigen::Index>(corners_.size() / 3), 3);
    std::copy(corners_.begin(), corners_.end(), mesh.triangles.data());
    return mesh;
  }

 private:
  std::vector<double> coordinates_;
  std::vector<std::int32_t> corners_;
};

}  // namespace assay::corpus
