// The contour test over a step: does the projection of a patch's contour stay simple?
//
// **L13** *A set P of triangles, a direction d with N(t).d > 0 for all of them at every t of the
// step, and P's boundary one closed walk whose projection along d is a simple polygon at every t:
// no two triangles of P are in contact during the step.* At a time t project P along d. All
// triangles keep their orientation, so almost every point y of the plane lies in as many projected
// triangles as the projected boundary winds around y (the boundary of the sum of P's triangles is
// P's boundary, edges inside cancel). A simple polygon winds around a point once or not at all (and
// not -1 times, counts are not negative): the projected triangles do not overlap. Let p and q be
// different points of P, as a set of triangles joined at their common vertices, with one projection
// y. Where p is not on the boundary, the triangles around p cover all of a neighbourhood of y: what
// ends at an edge or at a vertex would change the count there, and only the boundary does. q's
// triangle covers some of it too, and is not one of those around p, for a triangle is projected one
// to one: an overlap. So p and q are both on the boundary, and that is projected one to one. Hence
// no such p, q. But two faces without a common vertex that meet would hold such a pair.
//
// P need not be connected or a manifold: what is not has no such boundary (patch_contours.h).
//
// What doubles cannot tell is taken for a crossing.
#pragma once

#include <vector>

#include "detector/traditional/facing.h"
#include "detector/traditional/patch_contours.h"

namespace assay::detector {

class MovingContour {
 public:
  MovingContour(const PositionsView& x_t0, const PositionsView& x_t1) : x_t0_(x_t0), x_t1_(x_t1) {}

  // Whether the contour, projected along the direction of this bit, is a simple polygon at every t.
  // True is proved. O(length) where the contour is nearly convex, at worst O(length^2).
  bool stays_simple(Contour contour, int direction_bit);

  // Of the area that it encloses at t=0.5, as computed: only the choice of a direction rests on it.
  Vector area(Contour contour) const;

  // Asks it during long contours; what was stopped is not proved simple.
  void ask(PacedStop* pace) { pace_ = pace; }

 private:
  // Bounds along the two axes of the plane, at t=0 and at t=1.
  struct Box {
    std::array<double, 4> lo, hi;
  };
  // Edges first, ..., first + count - 1; their boxes are those from `box` on: its own, those of its
  // first half, those of its second.
  struct Chain {
    std::size_t first, count, box;
    Chain first_half() const { return {first, count / 2, box + 1}; }
    Chain second_half() const {
      return {first + count / 2, count - count / 2, box + 2 * (count / 2)};
    }
  };
  struct Flat {  // in the plane, a difference of two vertices
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

  const PositionsView &x_t0_, &x_t1_;
  PacedStop* pace_ = nullptr;
  // Of the call at hand.
  Contour contour_;
  Direction d_ = {0, 0, 0};
  std::array<Eigen::Index, 3> axis_ = {0, 0, 0};
  std::vector<Box> boxes_, points_;
};

}  // namespace assay::detector
