// Shapes of the scenes: at rest, and as moving meshes. For a rest shape, `size` is the wanted
// number of triangles; the shape has the nearest number that is possible. Closed shapes are cycles
// with outward normals. Sine and cosine, which shapes and motions use, come last.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "corpus/formats/mesh_reader.h"

namespace assay::corpus {

// Returns the unit sphere: an icosahedron with each face split into f^2 triangles, 20 f^2 in all.
Mesh sphere_shape(int size);

// Returns a tube along z, radius 0.5, length 6, centre at the origin. With m vertices around it,
// the tube has 4 m^2 triangles; flat caps add 2 m triangles.
Mesh tube_shape(int size, bool capped);

// Returns a torus around the z axis, radii 1 and 0.4. With m vertices around the tube of radius
// 0.4, it has 4 m^2 triangles.
Mesh torus_shape(int size);

// Returns the square [-1,1]^2 in the plane z = 0, normal +z: 2 k^2 triangles.
Mesh sheet_shape(int size);

// Returns the rectangle [0,1] x [0,0.5] in the plane z = 0, normal +z. It is cut into 8 k by k
// squares, and has 16 k^2 triangles.
Mesh ribbon_shape(int size);

// Returns both meshes as one mesh; b is moved by `offset` along x. Triangles of a come first.
Mesh side_by_side(const Mesh& a, const Mesh& b, double offset);

// Returns the n >= least whose count(n) is nearest to size. REQUIRES that count rises with n.
template <class Count>
int nearest_resolution(int size, int least, Count count) {
  int n = least;
  while (count(n + 1) <= size) ++n;
  return size - count(n) <= count(n + 1) - size ? n : n + 1;
}

// A grid of `columns` by `rows` cells; each cell has two triangles.
struct Sheet {
  int columns, rows;
  bool is_round = false;   // the last column joins the first column
  bool is_ring = false;    // the last row joins the first row
  bool is_turned = false;  // the orientation of all triangles is reversed
};

// Adds a sheet to `maker`, and returns its first vertex. `maker` is a MeshMaker, or another class
// with `vertex` and `quad`; place(k, i) returns the place of the vertex in column k and row i.
template <class Maker, class Place>
std::int32_t add_sheet(Maker& maker, const Sheet& sheet, const Place& place) {
  const int across = sheet.columns + (sheet.is_round ? 0 : 1);
  const int along = sheet.rows + (sheet.is_ring ? 0 : 1);
  std::int32_t first = 0;
  for (int i = 0; i < along; ++i) {
    for (int k = 0; k < across; ++k) {
      const std::int32_t vertex = maker.vertex(place(k, i));
      if (i == 0 && k == 0) first = vertex;
    }
  }
  const auto at = [&](int k, int i) { return first + i % along * across + k % across; };
  for (int i = 0; i < sheet.rows; ++i) {
    for (int k = 0; k < sheet.columns; ++k) {
      const std::int32_t beside = at(k + 1, i), above = at(k, i + 1);
      maker.quad(at(k, i), sheet.is_turned ? above : beside, at(k + 1, i + 1),
                 sheet.is_turned ? beside : above);
    }
  }
  return first;
}

// The cells of a cubic grid that has room for a number of bodies.
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

  // Adds the quad with corners a, b, c, d, counter-clockwise, split along ac.
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

// Functions that give the mesh of a scene for every time s in [0,1] of the scene, or (BoxWithArm)
// for every height of a tip.
//
// The functions of s give a collision detector much work: many layers, many bodies, a body wound
// about itself, many thin strips. At s = 0 nothing touches. `size` is the wanted number of
// triangles. Distances, thicknesses and lengths of motion do not depend on `size`; if a shape has
// several parts, a larger size means more parts. Fields, which move the vertices of a given mesh,
// follow further below.

// Returns square sheets, one over the other, all folded alike. They move farther than the distance
// between them, and each slides and bulges in its own way. There are 50 sheets from 1,600 triangles
// on, and fewer below that.
Mesh layered_cloth(int size, double s);

// Returns spheres of 80 triangles each, of several radii, on a cubic grid. The grid shrinks while
// the spheres turn. 80,000 triangles make 1,000 spheres.
Mesh pile_of_bodies(int size, double s);

// Returns a closed tube along a trefoil knot. The knot tightens while the thickness of the tube
// stays the same. The tube has twelve times as many pieces along its length as around it.
Mesh tightening_knot(int size, double s);

// Returns strips of 48 triangles that hang down side by side, all bent alike, and are combed to one
// side: every second column farther than its neighbours. 240,000 triangles make 5,000 strips.
Mesh combed_hair(int size, double s);

// A box with a square hole in its lid and an arm that grows out of a side wall, over the lid, and
// reaches through the hole: one connected, unclosed surface (its only boundary is the hole's rim).
//
// The box is [-1,1]^3, the hole |x|, |y| < 1/3 at z = 1; the arm is 0.2 wide. All edges are about 2
// / (3 b) long for a resolution b >= 1, and each of the four sides of the arm is k = max(1, b / 3)
// edges wide. There are 106 b^2 + 80 b k - 2 k^2 + 12 k triangles. When the arm is deepest, at most
// 16 b k + 12 k of the triangles are inside the box: below 5 % if b is 3 or more (1,204 triangles).
struct BoxWithArm {
  explicit BoxWithArm(int size);

  Mesh mesh;  // with the tip of the arm at height tip_outside

  // Returns the positions when the tip of the arm is at height z over the hole's middle. The arm
  // touches nothing for deepest_tip <= z <= tip_outside.
  detector::Positions with_tip(double z) const;

  static constexpr double tip_outside = 1.25;
  static constexpr double deepest_tip = -0.45;

 private:
  int resolution_;
  std::int32_t first_sliding_ = 0;  // the vertices from this one on follow the tip
};

// Fields: each maps a vertex at rest to its place at time s. Unless a comment says otherwise, a
// field is the identity at s = 0.
//
// s in [0,1] is the scene's own time. `extent` scales the field to the mesh.

struct Extent {
  detector::Point centre = {0, 0, 0};
  double radius = 1;     // half the longest side of the box around the mesh
  std::size_t axis = 2;  // the axis of the longest side
};

// Returns the middle, half-length and axis of the box around a mesh. A mesh without extent gets
// radius 1.
Extent extent_of(const detector::PositionsView& positions);

using Field = detector::Point (*)(const detector::Point& x, double s, const Extent& extent);

// Moves each vertex along its ray from the centre, by about 25 % and unevenly: out, back, and
// inward. If all triangles are positive for a view-point at the centre at s = 0, they stay positive
// at all times, between the frames too.
detector::Point breathe(const detector::Point& x, double s, const Extent& extent);

// Bends the long axis into an arc. At s = 1 the arc is 1.02 turns of a circle, so the two ends of a
// tube meet.
detector::Point bend(const detector::Point& x, double s, const Extent& extent);

// Turns each place about the long axis in proportion to its place along that axis: at s = 1 the two
// ends of the axis differ by one turn.
detector::Point twist(const detector::Point& x, double s, const Extent& extent);

// Shrinks the surface, and adds waves that fold it over itself.
detector::Point crumple(const detector::Point& x, double s, const Extent& extent);

// Pushes the cap around +z down through the sphere and out at the other side. This field and the
// fields below are for the shapes of this file, in the shapes' own coordinates; they do not use
// `extent`.
detector::Point dent(const detector::Point& x, double s, const Extent& extent);
// Presses the torus's hole shut at x = 0.
detector::Point pinch(const detector::Point& x, double s, const Extent& extent);
// Rolls the sheet up about the line x = 0.15 until its free edge comes down on the sheet.
detector::Point fold(const detector::Point& x, double s, const Extent& extent);
// Narrows the tube to a waist around z = 0; at s = 1 the waist is 40 % as wide as the tube.
detector::Point narrow(const detector::Point& x, double s, const Extent& extent);

// Fields that move unclosed surfaces through their own holes or around themselves, and back again.
//
// These fields are periodic: the places at s = 1 equal the places at s = 0, bit by bit, so a
// sequence can be repeated without end. The fields are for shapes of this file, in the shapes' own
// coordinates: tubes are tube_shape (radius 0.5, z from -3 to 3). There is no contact if a step is
// at most a fortieth of the period.

// Rolls the tube's upper end outward and down over the tube until the whole tube is inside out. The
// identity at s = 0.
detector::Point turn_inside_out(const detector::Point& x, double s, const Extent& extent);

// Tapers the tube to the upper end, cuts it obliquely there, and bends it to an arc: of 0.85 turns
// at s = 0, and of 1.1 turns at s = 1/2, when the narrow end is inside the wide end. While the
// narrow end goes in, the fans that close the two ends cross.
detector::Point bite_tail(const detector::Point& x, double s, const Extent& extent);

// Winds ribbon_shape into a spiral, of 1.25 turns at s = 0 and of 2.75 turns at s = 1/2. The fan
// that closes the ribbon lies right across the spiral.
detector::Point wind(const detector::Point& x, double s, const Extent& extent);

// Returns the height of a ball over the tube's middle: it goes along the axis from -4.5 to 4.5 and
// back.
double ball_height(double s);

// Sine and cosine of a fraction of a turn, computed with + - * / and floor only. Libraries differ
// in the last bit of std::sin, and a scene must be the same mesh everywhere.

inline constexpr double pi = 3.14159265358979323846;

// Return sin(2 pi x) and cos(2 pi x) for |x| < 2^40, within 4e-16; exact at multiples of a quarter
// turn.
double sin_turn(double x);
double cos_turn(double x);

}  // namespace assay::corpus
