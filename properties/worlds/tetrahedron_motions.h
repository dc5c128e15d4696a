// The motions of a tetrahedron's four vertices on a tiny grid. Of motions that differ only by a
// symmetry one stands for all.
//
// The vertices are at 0, 2, .., 2 (side - 1) on each axis, at t=0 and at t=1; they may coincide.
// View-points are at all integers from 0 to 2 (side - 1), so that some lie strictly inside of the
// tetrahedron.
//
// Motions are of one class if they are equal up to the order of the vertices and the grid's
// mirrors and permutations of axes. Neither changes which features touch, nor when. But an odd
// permutation of the vertices, like a mirror, turns the faces round, so whoever checks a class
// checks it with both orientations. A motion reversed in time is of another class, because its
// first contact is another one.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "detector/mesh/types.h"

namespace assay::properties {

struct TetrahedronGrid {
  int side = 2;        // vertex places on an axis
  int dimensions = 3;  // coordinates on the other axes are 0
  int movers = 4;      // how many vertices move at most
};

// One motion of a class, with one view-point of each set that its own symmetries map onto each
// other.
struct TetrahedronMotion {
  std::array<detector::MovingPoint, 4> vertices;
  // How many motions of the grid, with their vertices in order, are of this class.
  std::uint64_t stands_for = 0;
  struct View {
    detector::Point q;
    std::uint64_t stands_for = 0;  // view-points that its symmetries map to q
  };
  std::vector<View> views;
};

class TetrahedronMotions {
 public:
  explicit TetrahedronMotions(const TetrahedronGrid& grid);

  // The classes are split into blocks, the unit of work of a thread. Their order is fixed, and
  // shuffled, so that what fits into a time limit is a fair sample.
  std::size_t blocks() const { return blocks_.size(); }
  // Calls `visit` on the classes of a block in a fixed order, until it returns false.
  void for_each(std::size_t block,
                const std::function<bool(const TetrahedronMotion&)>& visit) const;

  // Motions, with their vertices in order, times view-points: the sum of `stands_for` of all
  // classes.
  std::uint64_t all() const;

 private:
  using Paths = std::array<int, 4>;  // path: start * places + end; ascending
  struct Block {
    // The places of the vertices at rest, ascending. Only the first 4 - moving entries count.
    std::array<int, 4> resting = {};
    int moving = 0;
    int first_path = 0;  // the first path of those that move
  };
  struct Symmetry {
    std::vector<int> place, path, view;  // each index to that of its image
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
