// What a user of the detector chooses.
#pragma once

#include <cstdint>

#include "detector/mesh/arithmetic.h"

namespace assay::detector {

enum class Culling : std::uint8_t {
  view_auto,    // a point or a segment, whichever sees more; bvh in steps where that does not pay
  view_point,   // each component, closed by its ghosts, seen from a point
  view_line,    // each component, closed by its ghosts, seen from a segment
  normal_cone,  // the tree without patches that have a normal cone and a simple contour [VMT94]
  bvh,          // the tree alone
  none,         // every pair, no boxes: for small meshes and for comparison
  automatic,    // view_auto and normal_cone in one descent, each if it is expected to pay
};

// Whether each step decides for itself if it uses views.
constexpr bool chooses_views(Culling culling) {
  return culling == Culling::view_auto || culling == Culling::automatic;
}

// Whether steps may use view primitives at all.
constexpr bool uses_views(Culling culling) {
  return chooses_views(culling) || culling == Culling::view_point || culling == Culling::view_line;
}

// What is known to be clean at a new start: at the first step, and after a jump of positions. Of a
// verified start, automatic and view_auto leave out the layers, and steps without views look at
// nothing: their pairs tell the next step what is clean (L15).
enum class Start : std::uint8_t {
  verified,  // what L5 shows to be clean; elsewhere what static contacts and layers show (L9)
  clean,     // the caller vouches that nothing is in contact and that layers are common
  unknown,   // everything is dirty
};

// Which pairs in contact a step reports.
enum class Pairs : std::uint8_t {
  all,    // the complete pair set of the step (K with closure, L7)
  first,  // those found through K: the first contact time is right, the set is not complete (L6)
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
  boxes,  // their moving boxes are not apart: a superset, as sound, with more dirty triangles
};

struct Options {
  Culling culling = Culling::automatic;
  Start start = Start::verified;
  Pairs pairs = Pairs::all;
  Arithmetic arithmetic = Arithmetic::exact;
  Release release = Release::pieces;
  GhostTest ghost_test = GhostTest::exact;
  // How many threads a step and create() may use; 0 means as many as the machine has. Results are
  // the same for any number, counts included. A library built without oneTBB uses one thread.
  std::uint32_t threads = 1;
};

}  // namespace assay::detector
