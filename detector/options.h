// What a user of the detector chooses, and what a step reports.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "detector/boundary/ghost_sweep.h"
#include "detector/contact/elementary.h"
#include "detector/mesh/arithmetic.h"
#include "detector/mesh/problem.h"
#include "detector/mesh/step_types.h"
#include "detector/search/feature_contacts.h"
#include "detector/search/pair_search.h"
#include "detector/view/view_signs.h"

namespace assay::detector {

enum class Culling : std::uint8_t {
  view_auto,    // a point or a segment, whichever sees more; bvh where that does not pay
  view_point,   // each closed component seen from a point
  view_line,    // each closed component seen from a segment
  normal_cone,  // the tree, less patches with a normal cone and a simple contour [VMT94]
  bvh,          // the tree alone
  none,         // every pair, no boxes: for small meshes and for comparison
};

// Whether steps may be seen from view primitives.
constexpr bool uses_views(Culling culling) {
  return culling == Culling::view_auto || culling == Culling::view_point ||
         culling == Culling::view_line;
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

struct Options {
  Culling culling = Culling::view_auto;
  Start start = Start::verified;
  Pairs pairs = Pairs::all;
  Arithmetic arithmetic = Arithmetic::exact;
  Release release = Release::pieces;
  GhostTest ghost_test = GhostTest::exact;
};

namespace doubt {
inline constexpr std::uint8_t violated = 1, dirty = 2;
}

// Wall-clock milliseconds; not part of the deterministic result.
struct StepTimes {
  double view_test = 0, start = 0, ghosts = 0, broad_phase = 0, narrow_phase = 0, closure = 0,
         total = 0;
};

// At the start of a step that goes on from a committed one (L9).
struct ReleaseCounts {
  std::uint64_t in_doubt = 0;  // dirty by L8
  std::uint64_t released = 0;
  std::uint64_t pairs = 0;  // tested at that instant: met before, or a ghost beside
  std::uint64_t elementary_tests = 0;
  std::uint64_t winding_numbers = 0;  // of pieces
};

struct StepCounts {
  SearchCounts search;
  MarkingCounts marking;  // these rest on the steps before, see search/marking.h
  NarrowCounts narrow;
  ViewCounts view;
  GhostCounts ghosts;
  ReleaseCounts release;
  std::uint64_t closure_rounds = 0;
  std::uint64_t winding_numbers = 0;  // of view primitives (L5)
  std::uint64_t free_components = 0;  // by L5, without any pair
};

struct StepResult {
  Answer answer = Answer::error;
  std::optional<Problem> problem;  // when answer is error
  // When answer is collision: exact, the enclosure of the first contact time; bounded, an interval
  // that holds it if there is a contact at all; double and float, a time without promise.
  TimeEnclosure first;
  std::vector<PairContact> pairs;  // ascending by pair, each with its first time

  // Sizes of V+, V-, V0 without Vv, and of Vv: disjoint, together all triangles. A step without
  // views (culling normal_cone, bvh and none, and view-auto where it falls back to bvh) has no view
  // sets: all are 0; doubts, signs, primitives and apexes are empty.
  std::size_t view_positive = 0, view_negative = 0, view_zero = 0;
  std::size_t against_all = 0;  // Vv: violated, dirty, or both
  std::size_t violated = 0;     // touched by a ghost during the step
  std::size_t dirty = 0;        // carry doubt into this step

  // By triangle of the mesh: doubt::violated, doubt::dirty.
  std::vector<std::uint8_t> doubts;
  // Sign over the step of each triangle of the mesh, then of each ghost.
  std::vector<ViewSign> signs;
  std::vector<ViewPrimitive> primitives;  // one for each component
  std::vector<MovingPoint> apexes;        // one for each loop, see Detector::surface()

  StepCounts counts;
  StepTimes times;
};

}  // namespace assay::detector
