// The contour test over a step: does the projection of a patch's contour stay simple?
//
// **L13** *Let P be a set of triangles and d a direction with N(t).d > 0 for all of them at every
// t of the step. Let P's boundary be one closed walk whose projection along d is a simple polygon
// at every t. Then no two triangles of P are in contact during the step.*
//
// Proof. At a time t project P along d. All triangles keep their orientation, so almost every
// point y of the plane lies in as many projected triangles as the projected boundary winds around
// y (the boundary of the sum of P's triangles is P's boundary, because edges inside cancel). A
// simple polygon winds around a point once or not at all (and not -1 times, because counts are not
// negative). So the projected triangles do not overlap.
//
// Take P as a set of triangles joined at their common vertices. Suppose that two different points
// p and q of P have the same projection y. If p is not on the boundary, the triangles around p
// cover all of a neighbourhood of y: if they ended at an edge or at a vertex the count would
// change there, but it changes only at the boundary. The triangle of q covers some of that
// neighbourhood too. It is not one of those around p, because a triangle is projected one to one.
// So there is an overlap, which was excluded. Hence p is on the boundary, and for the same reason
// q is. But the boundary is projected one to one. So there are no such p and q. Two faces without
// a common vertex that meet would hold such points.
//
// L13 need not require that P is connected or a manifold, because a set that is not has no such
// boundary (patch_contours.h).
//
// If doubles cannot tell whether the contour crosses itself, it is taken to do so.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "detector/exact/bernstein.h"
#include "detector/traditional/patch_contours.h"

namespace assay::detector {

// Which of a fixed set of directions a triangle faces over a whole step: N(t).d > 0 at every t.
//
// A normal cone of [VMT94] serves one purpose: to show that there is a direction d with N.d > 0
// for all triangles of a patch. Instead of a cone, this file keeps the set of such directions d
// themselves, out of 50 fixed ones. Two patches are merged by the intersection of their sets. That
// is exact, it needs no normalizations as the thesis does, and a merged set is never looser than
// its triangles. A patch has a normal cone if its set is not empty.
//
// Bit 2i stands for axis i, bit 2i+1 for its opposite.
using DirectionSet = std::uint64_t;

inline constexpr int facing_axes = 25;
inline constexpr int facing_directions = 2 * facing_axes;

// Coordinates are 0, 1, -1, 2 or -2: products with them are exact.
using Direction = std::array<double, 3>;
Direction direction(int bit);

// The directions that a triangle faces at every t of the step. A direction of which doubles cannot
// tell this is left out. Empty for a triangle that has no area at some time. 0.1 us.
DirectionSet faced_directions(const std::array<MovingPoint, 3>& triangle);

// The bit of the direction in `set` that is nearest to `vector`. REQUIRES that `set` is not empty.
int nearest_direction(DirectionSet set, const Vector& vector);

class MovingContour {
 public:
  explicit MovingContour(const SteppedMesh& motion) : motion_(motion) {}
  const SteppedMesh& motion() const { return motion_; }

  // True only if it is proved that the contour, projected along the direction of this bit, is a
  // simple polygon at every t. O(length) if the contour is nearly convex, at worst O(length^2).
  bool stays_simple(Contour contour, int direction_bit);

  // The vector of the area that the contour encloses at t=0.5, up to rounding errors. It serves
  // only to choose a direction.
  Vector area(Contour contour) const;

  // From now on `pace` is asked during long contours. If it stops, stays_simple() returns false.
  void ask(PacedStop* pace) { pace_ = pace; }

 private:
  // Bounds along the two axes of the plane, at t=0 (places 0, 1) and at t=1 (places 2, 3).
  struct Box {
    std::array<double, 4> lo, hi;
  };
  // The edges first, ..., first + count - 1 of the contour. Its boxes stand in boxes_ from place
  // `box` on: first its own, then those of its first half, then those of its second half.
  struct Chain {
    std::size_t first, count, box;
    Chain first_half() const { return {first, count / 2, box + 1}; }
    Chain second_half() const {
      return {first + count / 2, count - count / 2, box + 2 * (count / 2)};
    }
  };
  struct Flat {  // the difference of two vertices in the plane, at both ends of the step
    std::array<double, 2> t0, t1;
  };
  static bool apart(const Box& a, const Box& b);
  void make_boxes(const Chain& chain);
  bool is_simple(const Chain& chain) const;
  bool keeps_apart(const Chain& a, const Chain& b) const;
  bool edges_keep_apart(std::size_t i, std::size_t j) const;
  bool corner_stays_open(std::size_t i) const;  // the two edges at vertex i
  Flat flat(std::int32_t p, std::int32_t q, std::array<double, 2>& magnitude) const;
  std::size_t next(std::size_t i) const { return i + 1 == contour_.size() ? 0 : i + 1; }

  const SteppedMesh motion_;
  PacedStop* pace_ = nullptr;
  // Of the present call of stays_simple().
  Contour contour_;
  Direction d_ = {0, 0, 0};
  std::array<Eigen::Index, 3> axis_ = {0, 0, 0};
  std::vector<Box> boxes_, points_;
};

}  // namespace assay::detector
