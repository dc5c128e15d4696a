// What a user of the detector chooses.
#pragma once

#include <cstdint>

#include "detector/mesh/arithmetic.h"

namespace assay::detector {

enum class Culling : std::uint8_t {
  view_auto,    // a point or a segment, whichever sees more; bvh where that does not pay
  view_point,   // each closed component seen from a point
  view_line,    // each closed component seen from a segment
  normal_cone,  // the tree, less patches with a normal cone and a simple contour [VMT94]
  bvh,          // the tree alone
  none,         // every pair, no boxes: for small meshes and for comparison
  automatic,    // view_auto and normal_cone in one descent, each only where it is expected to pay
};

// Whether each step decides by itself if its views are used.
constexpr bool chooses_views(Culling culling) {
  return culling == Culling::view_auto || culling == Culling::automatic;
}

// Whether steps may be seen from view primitives.
constexpr bool uses_views(Culling culling) {
  return chooses_views(culling) || culling == Culling::view_point || culling == Culling::view_line;
}

enum class Start : std::uint8_t {
  verified,  // at the first step: static contacts and layers by piece (L9); L5 where it applies
  clean,     // the caller vouches that nothing is in contact and layers are common
  unknown,   // everything is dirty
};

enum class Pairs : std::uint8_t {
  all,    // the complete pair set of the step (K with closure, L7)
  first,  // contacts found through K: the first contact time is right, the set is not complete (L6)
};

// How dirty triangles become clean again within a sequence.
enum class Release : std::uint8_t {
  pieces,  // piece by piece (L9)
  model,   // a component at once, when L9 releases all of it
  view,    // a component at once, when all of it is positive and has winding number 1 (L5)
};

// When a ghost counts as touching a triangle.
enum class GhostTest : std::uint8_t {
  exact,  // their closed faces meet
  boxes,  // their moving boxes are not apart: a superset, as sound, and dirty for longer
};

struct Options {
  Culling culling = Culling::automatic;
  Start start = Start::verified;
  Pairs pairs = Pairs::all;
  Arithmetic arithmetic = Arithmetic::exact;
  Release release = Release::pieces;
  GhostTest ghost_test = GhostTest::exact;
  // How many threads a step and create() may use; 0: as many as the machine has. What comes out is
  // the same, counts too. Where the library was built without oneTBB it is one.
  std::uint32_t threads = 1;
};

}  // namespace assay::detector
