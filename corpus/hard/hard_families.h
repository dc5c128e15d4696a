// Families of hard cases: each case is a small mesh with one step, is made from a strength and a
// variant, and has an exact answer that is known by construction.
//
// The strength sets one parameter, the knob, and a greater strength makes a harder case. At
// strength s the knob is 2^(exponent_at_0 + slope * s). Its meaning depends on the family: a gap in
// units of the grid, an offset divided by the size, a scale, a number. One unit of the grid is an
// ulp of a coordinate of 2^52 units; coordinates are below 2^53. If meshes of a family can touch,
// there is one more strength after the strongest: exact touching, a gap of 0. The parts of a case
// come first in this file.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "corpus/cases/case_file.h"

namespace assay::corpus {

// Hard cases are made on a grid of integers, and then turned away from the axes without rounding.
//
// Each family is first built in a place where its answer is easy to see: for example a face in the
// plane z = 0, and a vertex that comes down on the face. In such a place plain double arithmetic
// would be right, because most products are 0. So an integer map of determinant 1 (three shears, a
// cyclic change of axes, a shift) is applied afterwards. An affine map changes neither contacts nor
// their times nor the view signs of a view-point. The coordinates stay integers below 2^53, so they
// are exact doubles that fill the mantissa. Finally each axis is scaled by a power of two.

// The free choices of a hard case: integers that depend only on the family, the strength and the
// variant. They are the same on every platform if no two draws are arguments or operands of one
// expression, because C++ evaluates these in any order. (It evaluates the items of a braced list
// from left to right.)
//
// SplitMix64, seeded by FNV-1a of the family's name.
class Variation {
 public:
  Variation(std::string_view family, int strength, int variant) {
    for (const char c : family) {
      state_ = (state_ ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    }
    // These factors put the states of neighbouring strengths and variants far apart.
    constexpr std::uint64_t strength_stride = 0xd1342543de82ef95u,
                            variant_stride = 0x2545f4914f6cdd1d;
    state_ ^= static_cast<std::uint64_t>(strength + 1) * strength_stride;
    state_ ^= static_cast<std::uint64_t>(variant + 1) * variant_stride;
    next();
  }
  // Returns a number in lo .. hi. The bias that the remainder (%) causes does no harm here.
  std::int64_t between(std::int64_t lo, std::int64_t hi) {
    const auto n = static_cast<std::uint64_t>(hi - lo) + 1;
    return lo + static_cast<std::int64_t>(next() % n);
  }
  std::int64_t sign() { return next() & 1 ? 1 : -1; }

 private:
  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

// A point in units of the grid.
struct GridPoint {
  std::int64_t x = 0, y = 0, z = 0;
  friend GridPoint operator+(const GridPoint& a, const GridPoint& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
};

struct GridVertex {
  GridPoint t0, t1;
};
inline GridVertex at_rest(const GridPoint& p) { return {p, p}; }
// Returns a vertex that moves along with `tip`, at a constant offset from it.
inline GridVertex carried(const GridVertex& tip, const GridPoint& offset) {
  return {tip.t0 + offset, tip.t1 + offset};
}

struct GridMesh {
  std::vector<GridVertex> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<GridVertex> view;  // empty, a view-point, or the two end points of a view-line

  std::int32_t add(const GridVertex& vertex);
  // Adds a triangle with three new vertices, in the order of `corners`.
  void add_triangle(const std::array<GridVertex, 3>& corners);
  // Adds a tetrahedron with four new vertices, whose triangles face outward at t=0. The i-th
  // triangle is opposite corner i.
  void add_tetrahedron(const std::array<GridVertex, 4>& corners);
};

// x -> shift + C S3 S2 S1 x, with shears S and a cyclic change of axes C. Before the shift no
// coordinate grows by more than the factor `growth`.
struct GridMap {
  static constexpr std::int64_t growth = 37;

  std::array<std::array<std::int64_t, 2>, 3> shears{};  // each in -2 .. 2
  int turns = 0;                                        // how often C moves the axes on by one
  GridPoint shift;

  // Returns a map whose shears have no coefficient 0.
  static GridMap any(Variation& vary);
  // Returns a map that only changes axes. View-lines need it, because a shear changes which point
  // of the line is nearest.
  static GridMap of_axes(Variation& vary);
  GridPoint operator()(GridPoint p) const;
};

// The facts that the construction of a case tells. It may leave out first_time and view_signs.
using KnownFacts = ExpectedStep;

// Returns one step of the mapped mesh, with coordinate i multiplied by 2^exponents[i]. If a product
// is not exact, the process ends; the tests make every case, so that no user sees this.
Case grid_case(const GridMesh& mesh, const GridMap& map, const std::array<int, 3>& exponents,
               KnownFacts facts);

// These exponents scale coordinates of usual_size to about 1.
inline constexpr std::array<int, 3> to_size_one = {-46, -46, -46};

// Returns grid_case with a map of GridMap::any, and with coordinates of about 1.
Case sheared_case(const GridMesh& mesh, Variation& vary, KnownFacts facts);

// The two solids of most hard cases: a block with a face in the plane z = 0, and a spike above it.
//
// Their answers are easy to see: the block lies in z <= 0, and all of the spike lies above its tip
// (or above its lower edge), so the two do not meet before the tip or edge reaches z = 0. In cases
// where the spike passes beside the block, a plane of constant x or y separates the two throughout
// the step.

// Returns 2^exponent units.
inline std::int64_t two_to(int exponent) { return std::int64_t{1} << exponent; }

// The usual size of a solid. With the factor GridMap::growth (37), and heights up to 2 usual_size,
// coordinates are below 2^52.
inline constexpr int usual_exponent = 45;
inline constexpr std::int64_t usual_size = std::int64_t{1} << usual_exponent;

// Returns a triangle in z = 0 whose interior has all points of that plane within reach / 8 of the
// origin. Its corners are at most `reach` away along each axis. REQUIRES reach >= 32.
std::array<GridPoint, 3> wide_face(Variation& vary, std::int64_t reach);

// Adds the block under a wide face; its fourth corner is `depth` deep, near the axis.
void add_block(GridMesh& mesh, Variation& vary, std::int64_t reach, std::int64_t depth);

// The side to which a spike extends from its tip.
enum class Side { all_around, positive_y, negative_y };

// Adds a tetrahedron that moves along with its tip. The other corners are up to `reach` away from
// the tip along x and y, only on the side `side`, and between `height` and 3 `height` above the
// tip.
void add_spike(GridMesh& mesh, Variation& vary, const GridVertex& tip, std::int64_t reach,
               std::int64_t height, Side side);

// Returns a place at height z that is straight above or below an interior point of every wide_face
// of this reach.
GridPoint under_the_face(Variation& vary, std::int64_t reach, std::int64_t z);

// Returns a vertex at (p.x, p.y) that goes from height z_t0 to z_t1.
GridVertex falling(const GridPoint& p, std::int64_t z_t0, std::int64_t z_t1);

KnownFacts known_free();
// Returns the facts of a collision; the first time is `first` exactly. Without an argument, no
// first time is stated.
KnownFacts known_collision(double first);
KnownFacts known_collision();

struct HardFamily {
  std::string_view name;
  std::string_view about;  // one line
  std::string_view knob;   // the quantity that is 2^exponent(s)
  std::string_view unit;   // the unit of the knob; may be empty
  int exponent_at_0;
  int slope;
  int strongest;  // strengths with a knob are 0 .. strongest
  int kinds;      // variants v and v + kinds are of the same kind, with other numbers
  int touching;   // the number of kinds of exact touching; 0: the meshes cannot touch
  // Makes a case without its id. The kinds of exact touching are numbered from `kinds` on.
  Case (*make)(Variation& vary, int exponent, int kind);

  int exponent(int strength) const { return exponent_at_0 + slope * strength; }
  bool touches(int strength) const { return strength > strongest; }
  int last_strength() const { return touching > 0 ? strongest + 1 : strongest; }
  int kinds_at(int strength) const { return touches(strength) ? touching : kinds; }
};

std::span<const HardFamily> hard_families();

// Makes a case of one step with its id (such as "grazing-s12-v3"), its line `about` and its
// expected answer. The case states the first time and the view signs if the construction tells
// them. REQUIRES 0 <= strength <= last_strength(), variant >= 0. Cases are small: at most 4,100
// triangles, mostly 8.
Case hard_case(const HardFamily& family, int strength, int variant);

// Each of these functions returns the families that one source file defines; hard_families()
// returns all of them.

std::vector<HardFamily> feature_families();  // near-coplanar, near-parallel, slivers, ...
std::vector<HardFamily> time_families();     // t=0 and t=1, multiple roots, lengths
std::vector<HardFamily> view_families();     // view tests near zero
std::vector<HardFamily> number_families();   // offsets, scales, denormals
std::vector<HardFamily> crowd_families();    // duplicates, coplanar sheets, many at once

}  // namespace assay::corpus
