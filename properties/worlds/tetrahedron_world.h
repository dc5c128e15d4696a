// Proves small worlds of tetrahedra, motion by motion: compares the detector, and the laws of
// closed meshes, with the oracle on every motion on a tiny grid, from every view-point there.
//
// For each class of motions and view-points (TetrahedronMotions), in both orientations, checks
// that:
// - the detector with Culling::view_point from there, Start::verified and Pairs::all has the
//   oracle's pairs and times; if the start is clean, also with Start::clean and Pairs::first;
// - L3: with a clean start the first contact is in K;
// - L4: with a clean start, all positive or all negative: no contact;
// - L5: all positive over the step and winding number 1 at t=0: no contact, whatever the start.
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

// Lists the motions of a tetrahedron's four vertices on a tiny grid, one for all motions that
// differ only by a symmetry.
//
// The vertices are at 0, 2, .., 2 (side - 1) on each axis, at t=0 and at t=1; they may coincide.
// View-points are at all integers from 0 to 2 (side - 1), so that some lie strictly inside of the
// tetrahedron.
//
// Motions are of one class if they are equal up to the order of the vertices and the grid's
// mirrors and permutations of axes. Neither changes which features touch, nor when. But an odd
// permutation of the vertices, like a mirror, turns the faces round, so each class is checked with
// both orientations. A motion reversed in time is of another class, because its first contact is a
// different one.

struct TetrahedronGrid {
  int side = 2;        // vertex places on an axis
  int dimensions = 3;  // coordinates on the other axes are 0
  int movers = 4;      // how many vertices move at most
};

// One motion of a class, with one view-point of each set of view-points that the motion's own
// symmetries map onto each other.
struct TetrahedronMotion {
  std::array<MovingPoint, 4> vertices;
  // The number of motions of the grid, with their vertices in order, in this class.
  std::uint64_t stands_for = 0;
  struct View {
    Point q;
    std::uint64_t stands_for = 0;  // view-points that its symmetries map to q
  };
  std::vector<View> views;
};

class TetrahedronMotions {
 public:
  explicit TetrahedronMotions(const TetrahedronGrid& grid);

  // Returns the number of blocks. A block of classes is the unit of work of a thread. The order of
  // blocks is fixed, and shuffled, so that those that fit into a time limit are a fair sample.
  std::size_t blocks() const { return blocks_.size(); }
  // Calls `visit` on the classes of a block in a fixed order, until it returns false.
  void for_each(std::size_t block,
                const std::function<bool(const TetrahedronMotion&)>& visit) const;

  // Returns the number of motions, with their vertices in order, times view-points: the sum of
  // `stands_for` over all classes.
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

struct TetrahedronWorld {
  const char* name;
  const char* about;
  TetrahedronGrid grid;
};

// Returns all worlds, the smaller ones first: each takes longer than the one before it.
std::span<const TetrahedronWorld> tetrahedron_worlds();

struct TetrahedronWorldOptions {
  int jobs = 1;                // threads; the counts of a completed world do not depend on it
  double seconds = 0;          // time limit; 0 for none
  std::function<bool()> stop;  // asked between motions, from any thread; may be empty
};

struct TetrahedronWorldResult {
  bool complete = false;      // every class was checked and holds
  std::uint64_t classes = 0;  // classes of a motion with a view-point that were proved
  std::uint64_t motions = 0;  // motions that these classes stand for, of `all`
  std::uint64_t all = 0;      // motions of the world, times view-points
  // Counts among the classes. Each of the two orientations of a class counts by itself.
  std::uint64_t collisions = 0, clean_starts = 0;
  std::uint64_t first_in_k = 0;    // for L3: clean start and a contact
  std::uint64_t one_sign = 0;      // for L4: clean start, all positive or all negative
  std::uint64_t all_positive = 0;  // for L5: all positive and winding number 1
  double seconds = 0;
  // The first case, in the order of the enumeration, that does not hold, and why it does not.
  std::optional<Case> counterexample;
  std::string explanation;
};

// Proves a world. Takes 0.1 to 0.5 ms for each class.
TetrahedronWorldResult prove(const TetrahedronWorld& world, const TetrahedronWorldOptions& options);

// Checks one class of a tetrahedron's motions: compares detector and laws with the oracle.

struct TetrahedronFailure {
  Case c;
  std::string explanation;
};

// Checks all view-points of the motion, in both orientations, and adds to the counts. Returns the
// first failure, or nothing.
std::optional<TetrahedronFailure> check_tetrahedron(const TetrahedronMotion& motion,
                                                    TetrahedronWorldResult& counts);

}  // namespace assay::properties
