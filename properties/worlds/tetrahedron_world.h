// Small worlds of tetrahedra, proved motion by motion: the detector and the laws of closed meshes
// against the oracle on every motion of a tiny grid, seen from every view-point of it.
//
// For each class of motions and view-points (tetrahedron_motions.h), with the faces outward and
// turned round:
// - the detector with culling view-point from there, start verified and all pairs, has the oracle's
//   pairs and times; where the start is clean also with start clean and first pairs;
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

// The smaller first, each for some more time than the one before it.
std::span<const TetrahedronWorld> tetrahedron_worlds();

struct TetrahedronWorldOptions {
  int jobs = 1;                // threads; the counts of a completed world do not depend on it
  double seconds = 0;          // time limit; 0 for none
  std::function<bool()> stop;  // asked between motions, from any thread; may be empty
};

struct TetrahedronWorldResult {
  bool complete = false;      // every class was checked and holds
  std::uint64_t classes = 0;  // of motions with a view-point: proved
  std::uint64_t motions = 0;  // what these stand for, of `all`
  std::uint64_t all = 0;      // motions of the world, times view-points
  // Among the classes, each orientation counted by itself.
  std::uint64_t collisions = 0, clean_starts = 0;
  std::uint64_t first_in_k = 0;    // L3: clean start and a contact
  std::uint64_t one_sign = 0;      // L4: clean start, all positive or all negative
  std::uint64_t all_positive = 0;  // L5: all positive and winding number 1
  double seconds = 0;
  // The first in the order of the enumeration, and what does not hold.
  std::optional<corpus::Case> counterexample;
  std::string what;
};

// 0.1 to 0.5 ms a class.
TetrahedronWorldResult prove(const TetrahedronWorld& world, const TetrahedronWorldOptions& options);

}  // namespace assay::properties
