// Small worlds of tetrahedra, proved motion by motion: the detector, and the laws of closed
// meshes, are held against the oracle on every motion on a tiny grid, seen from every view-point
// of that grid.
//
// For each class of motions and view-points (tetrahedron_motions.h), with the faces outward and
// with them turned round, this is checked:
// - the detector with culling view-point from there, start verified and all pairs, has the
//   oracle's pairs and times; if the start is clean, so it has with start clean and first pairs;
// - L3: with a clean start the first contact is in K;
// - L4: with a clean start, all positive or all negative: no contact;
// - L5: all positive over the step and winding number 1 at t=0: no contact, whatever the start.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "corpus/cases/case_file.h"
#include "properties/worlds/tetrahedron_motions.h"

namespace assay::properties {

struct TetrahedronWorld {
  const char* name;
  const char* about;
  TetrahedronGrid grid;
};

// All worlds, the smaller ones first: each takes longer than the one before it.
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
  // The first case, in the order of the enumeration, that does not hold, and what does not hold in
  // it.
  std::optional<corpus::Case> counterexample;
  std::string explanation;
};

// Takes 0.1 to 0.5 ms for each class.
TetrahedronWorldResult prove(const TetrahedronWorld& world, const TetrahedronWorldOptions& options);

// The check of one class of a tetrahedron's motions: detector and laws against the oracle.

struct TetrahedronFailure {
  corpus::Case c;
  std::string explanation;
};

// Checks all view-points of the motion, in both orientations, and adds to the counts. Returns the
// first failure, or nothing.
std::optional<TetrahedronFailure> check_tetrahedron(const TetrahedronMotion& motion,
                                                    TetrahedronWorldResult& counts);

}  // namespace assay::properties
