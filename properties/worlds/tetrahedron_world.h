// Proves that the detector is right, and that the laws of closed meshes hold, in small worlds. A
// world has every motion of a tetrahedron on a tiny grid, seen from every view-point of that grid.
// For each motion and view-point the oracle checks the detector and the laws.
//
// The checks of one motion and one view-point, in both orientations of the faces, are:
// - The detector with Culling::view_point, Start::verified and Pairs::all has the oracle's pairs
//   and times. If the start is clean, the detector with Start::clean and Pairs::first has the
//   oracle's first time and first pairs.
// - L3: if the start is clean, the set of candidates K (detector/LAWS.md) holds the first contact.
// - L4: if the start is clean, and all triangles are positive or all are negative, there is no
//   contact.
// - L5: if all triangles are positive over the step, and the winding number at t=0 is 1, there is
//   no contact, even if the start is not clean.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "properties/words.h"

namespace assay::properties {

// TetrahedronMotions lists the motions of a tetrahedron's four vertices on a tiny grid. It lists
// only one of several motions that differ only by a symmetry.
//
// The vertices are at 0, 2, .., 2 (side - 1) on each axis, at t=0 and at t=1. Vertices may
// coincide. The coordinates of view-points are all integers from 0 to 2 (side - 1), so that some
// view-points lie strictly inside of the tetrahedron.
//
// Two motions are of one class if a permutation of the vertices together with a symmetry of the
// grid turns one into the other. The same features then touch at the same times. An odd permutation
// of the vertices, like a mirror, reverses the faces, so each class is checked with both
// orientations. A motion reversed in time is of another class, because its first contact is another
// contact.

struct TetrahedronGrid {
  int side = 2;        // vertex places on an axis
  int dimensions = 3;  // coordinates on the other axes are 0
  int movers = 4;      // the greatest number of vertices that move
};

// One motion of a class. Two view-points are equivalent if a symmetry maps the motion onto itself
// and one view-point onto the other. `views` has one of each set of equivalent view-points.
struct TetrahedronMotion {
  std::array<MovingPoint, 4> vertices;
  // The number of motions in this class, where motions that differ in the order of vertices count
  // separately.
  std::uint64_t stands_for = 0;
  struct View {
    Point q;
    std::uint64_t stands_for = 0;  // the number of view-points equivalent to q, with q
  };
  std::vector<View> views;
};

class TetrahedronMotions {
 public:
  explicit TetrahedronMotions(const TetrahedronGrid& grid);

  // Returns the number of blocks. A thread works on one block of classes after another. The blocks
  // are shuffled, always in the same way, so that the blocks that a time limit allows are a fair
  // sample.
  std::size_t blocks() const { return blocks_.size(); }
  // Calls `visit` on the classes of a block in a fixed order, until `visit` returns false.
  void for_each(std::size_t block,
                const std::function<bool(const TetrahedronMotion&)>& visit) const;

  // Returns the number of motions, multiplied by the number of view-points. Motions that differ in
  // the order of vertices count separately.
  std::uint64_t all() const;

 private:
  using Paths = std::array<int, 4>;  // path: start * places + end; ascending
  struct Block {
    // The places of the vertices at rest, ascending. Only the first 4 - moving entries are used.
    std::array<int, 4> resting = {};
    int moving = 0;
    int first_path = 0;  // the first path of the moving vertices: an index into moving_paths_
  };
  struct Symmetry {
    std::vector<int> place, path, view;  // element i is the index of the image of item i
  };

  Paths image(const Paths& paths, const Symmetry& symmetry) const;
  bool visit_class(const Paths& paths,
                   const std::function<bool(const TetrahedronMotion&)>& visit) const;

  TetrahedronGrid grid_;
  int places_ = 0, views_ = 0;
  std::vector<int> moving_paths_;  // all paths that end at another place than their start
  std::vector<Symmetry> symmetries_;
  std::vector<Block> blocks_;
};

struct TetrahedronWorld {
  const char* name;
  const char* about;
  TetrahedronGrid grid;
};

// Returns all worlds, in the order of the time that their proofs take, the shortest first.
std::span<const TetrahedronWorld> tetrahedron_worlds();

struct TetrahedronWorldOptions {
  int jobs = 1;        // threads; the counts of a completed world do not depend on their number
  double seconds = 0;  // time limit; 0: no limit
  // Returns whether to stop. Is called between motions, from any thread. If empty, nothing stops.
  std::function<bool()> stop;
};

struct TetrahedronWorldResult {
  bool complete = false;      // every class was checked and holds
  std::uint64_t classes = 0;  // pairs of a class and one of its `views` that were proved
  std::uint64_t motions = 0;  // the part of `all` that these pairs stand for
  std::uint64_t all = 0;      // TetrahedronMotions::all() of the world
  // How many of the pairs have a property. Each of the two orientations counts by itself.
  std::uint64_t collisions = 0, clean_starts = 0;
  std::uint64_t first_in_k = 0;    // for L3: clean start and a contact
  std::uint64_t one_sign = 0;      // for L4: clean start, all positive or all negative
  std::uint64_t all_positive = 0;  // for L5: all positive and winding number 1
  double seconds = 0;
  // The first case that does not hold, in the order of the enumeration, and the check that fails.
  std::optional<Case> counterexample;
  std::string explanation;
};

// Proves a world. Takes 0.1 to 0.5 ms for each class.
TetrahedronWorldResult prove(const TetrahedronWorld& world, const TetrahedronWorldOptions& options);

struct TetrahedronFailure {
  Case c;
  std::string explanation;
};

// Checks the detector and the laws by the oracle, for all view-points of one motion and in both
// orientations. Adds to the counts. Returns the first failure; nothing if all checks hold.
std::optional<TetrahedronFailure> check_tetrahedron(const TetrahedronMotion& motion,
                                                    TetrahedronWorldResult& counts);

}  // namespace assay::properties
