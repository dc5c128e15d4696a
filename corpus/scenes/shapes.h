// Rest shapes of the scenes. `size` is the wanted number of triangles, and each shape takes the
// nearest number that it can have. Closed shapes are cycles with outward normals. What they and the
// motions of scenes compute with stands last: sine and cosine.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "corpus/formats/mesh_reader.h"

namespace assay::corpus {

// The unit sphere: an icosahedron with each face split into f^2 triangles, 20 f^2 in all.
Mesh sphere_shape(int size);

// A tube along z, radius 0.5, length 6, centre at the origin. With m vertices around it has 4 m^2
// triangles and, with flat caps, 2 m more.
Mesh tube_shape(int size, bool capped);

// A torus around the z axis, radii 1 and 0.4: 4 m^2 triangles with m vertices around the thin way.
Mesh torus_shape(int size);

// The square [-1,1]^2 in the plane z = 0, normal +z: 2 k^2 triangles.
Mesh sheet_shape(int size);

// The rectangle [0,1] x [0,0.5] in the plane z = 0, normal +z, 8 k by k squares: 16 k^2 triangles.
Mesh ribbon_shape(int size);

// Both meshes as one; b is moved by `offset` along x. Triangles of a come first.
Mesh side_by_side(const Mesh& a, const Mesh& b, double offset);

// The n >= least whose count(n) is nearest to size. REQUIRES that count rises with n.
template <class Count>
int nearest_resolution(int size, int least, Count count) {
  int n = least;
  while (count(n + 1) <= size) ++n;
  return size - count(n) <= count(n + 1) - size ? n : n + 1;
}

// Adds a grid of (columns + 1) x (rows + 1) vertices, two triangles a cell, to a MeshMaker or
// anything else with `vertex` and `quad`; place(k, i) says where the vertex of column k and row i
// is. Returns the first vertex.
template <class Maker, class Place>
std::int32_t add_sheet(Maker& maker, int columns, int rows, const Place& place) {
  std::int32_t first = 0;
  for (int i = 0; i <= rows; ++i) {
    for (int k = 0; k <= columns; ++k) {
      const std::int32_t vertex = maker.vertex(place(k, i));
      if (i == 0 && k == 0) first = vertex;
    }
  }
  const auto at = [&](int k, int i) { return first + i * (columns + 1) + k; };
  for (int i = 0; i < rows; ++i) {
    for (int k = 0; k < columns; ++k)
      maker.quad(at(k, i), at(k + 1, i), at(k + 1, i + 1), at(k, i + 1));
  }
  return first;
}

// The cells of a cubic grid that has room for so many bodies.
class CubicGrid {
 public:
  CubicGrid(int bodies, double pitch)
      : side_(nearest_resolution(bodies, 1, [](int k) { return k * k * k; }) + 1), pitch_(pitch) {}
  detector::Point cell(int body) const {
    return {pitch_ * (body % side_), pitch_ * (body / side_ % side_),
            pitch_ * (body / side_ / side_)};
  }

 private:
  int side_;
  double pitch_;
};

// Puts a mesh together vertex by vertex.

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

// Sine and cosine of a part of a turn, from + - * / and floor only. Libraries differ in the last
// bit of std::sin, and a scene must be the same mesh everywhere.

inline constexpr double pi = 3.14159265358979323846;

// sin(2 pi x) and cos(2 pi x) for |x| < 2^40, within 4e-16; exact at multiples of a quarter turn.
double sin_turn(double x);
double cos_turn(double x);

}  // namespace assay::corpus
