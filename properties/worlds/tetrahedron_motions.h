// All motions of a tetrahedron's four vertices on a tiny grid, one of each class.
//
// Vertices are at 0, 2, .., 2 (side - 1) on each axis at t=0 and at t=1; view-points at all
// integers between, so that there are some strictly inside. A class: motions that are equal up to
// the order of the vertices and the grid's mirrors and exchanges of axes. Neither changes when what
// touches what; an odd order, as a mirror, turns the faces round, so whoever checks a class checks
// it with both orientations. Time reversed is another class: the first contact is not that of the
// reverse.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "detector/mesh/types.h"

namespace assay::properties {

struct TetrahedronGrid {
  int side = 2;        // vertex places an axis
  int dimensions = 3;  // the other axes are 0
  int movers = 4;      // vertices that move, at most
};

// One motion of a class, with the view-points that its own symmetries leave.
struct TetrahedronMotion {
  std::array<detector::MovingPoint, 4> vertices;
  // Ordered motions of the grid that are of this class.
  std::uint64_t stands_for = 0;
  struct View {
    detector::Point q;
    std::uint64_t stands_for = 0;  // view-points that are q up to the motion's own symmetries
  };
  std::vector<View> views;
};

class TetrahedronMotions {
 public:
  explicit TetrahedronMotions(const TetrahedronGrid& grid);

  // The classes are split into blocks, the unit of work of a thread, in a fixed order: shuffled, so
  // that what fits into a time limit is a fair sample.
  std::size_t blocks() const { return blocks_.size(); }
  // Calls visit on the classes of a block in a fixed order until it returns false.
  void for_each(std::size_t block,
                const std::function<bool(const TetrahedronMotion&)>& visit) const;

  // Ordered motions times view-points: what the classes' `stands_for` sum up to.
  std::uint64_t all() const;

 private:
  using Paths = std::array<int, 4>;  // path: start * places + end; ascending
  struct Block {
    // Places of those at rest, ascending: the first 4 - moving of these count.
    std::array<int, 4> resting = {};
    int moving = 0;
    int first_path = 0;  // of those that move
  };
  struct Symmetry {
    std::vector<int> place, path, view;  // to their images
  };

  Paths image(const Paths& paths, const Symmetry& symmetry) const;
  bool visit_class(const Paths& paths,
                   const std::function<bool(const TetrahedronMotion&)>& visit) const;

  TetrahedronGrid grid_;
  int places_ = 0, views_ = 0;
  std::vector<int> moving_paths_;  // paths whose end is not their start
  std::vector<Symmetry> symmetries_;
  std::vector<Block> blocks_;
};

}  // namespace assay::properties
