// The options of a detector. An option that is not set has its default:
//
//   Options options;
//   options.pairs = Pairs::first;
//   options.threads = 0;  // as many as the machine has
//   Detector detector = Detector::create(triangles, positions, options).value();
//   const StepResult result = detector.step(x_t0, x_t1);
//   use(result.first);
#pragma once

#include <cstdint>

#include "detector/mesh/counted_pairs.h"
#include "detector/mesh/step_types.h"

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
constexpr auto names_of(Culling) {
  using enum Culling;
  return std::to_array<Named<Culling>>({{automatic, "auto"},
                                        {view_auto, "view-auto"},
                                        {view_point, "view-point"},
                                        {view_line, "view-line"},
                                        {normal_cone, "normal-cone"},
                                        {bvh, "bvh"},
                                        {none, "none"}});
}

// Returns whether each step decides for itself if it uses views.
constexpr bool chooses_views(Culling culling) {
  return culling == Culling::view_auto || culling == Culling::automatic;
}

// Returns whether steps may use view primitives at all.
constexpr bool uses_views(Culling culling) {
  return chooses_views(culling) || culling == Culling::view_point || culling == Culling::view_line;
}

// The triangles that are known to be clean at a new start: at the first step, and after a jump of
// positions. With Start::verified, Culling::automatic and view_auto leave out the layers. A step
// without views then verifies nothing: its pairs tell which triangles are clean afterwards (L15).
enum class Start : std::uint8_t {
  verified,  // those that L5 shows; elsewhere those that static contacts and layers show (L9)
  clean,     // the caller vouches that nothing is in contact and that layers are common
  unknown,   // everything is dirty
};
constexpr auto names_of(Start) {
  using enum Start;
  return std::to_array<Named<Start>>(
      {{verified, "verified"}, {clean, "clean"}, {unknown, "unknown"}});
}

// The pairs in contact that a step reports.
enum class Pairs : std::uint8_t {
  all,  // the complete pair set of the step (K with closure, L7)
  // Pairs in contact by the upper end of the first time: each connected part of the contact graph
  // at the first time holds one of them (L6). Some may meet later, but within the enclosure of the
  // first time: their own time is the same enclosure, or its upper end. As soon as a contact is
  // found, nothing later is looked at. This took 0.1 to 0.45 of the time of `all` on scenes of many
  // contacts, 0.92 on rod-twist, and a few percent more than `all` where there is no contact.
  first,
};
constexpr auto names_of(Pairs) {
  return std::to_array<Named<Pairs>>({{Pairs::all, "all"}, {Pairs::first, "first"}});
}

struct Options {
  Culling culling = Culling::automatic;
  Start start = Start::verified;
  Pairs pairs = Pairs::all;
  Arithmetic arithmetic = Arithmetic::exact;
  // How many threads a step and create() may use; 0 means as many as the machine has. Results are
  // the same for any number, counts included. A library built without oneTBB uses one thread.
  std::uint32_t threads = 1;
  // Which pairs count (L19); null: all of them. It is read when a detector is created, which keeps
  // a copy. A pair that does not count is not reported; its contacts are still found where the
  // state has to know them.
  const CountedPairs* counted = nullptr;
  // If 0, contacts are looked for, else pairs of triangles that come within this distance, in the
  // units of the positions (L16). Pairs that share a vertex do not count then. REQUIRES a finite
  // number >= 0; above 0 it REQUIRES Culling::bvh or none, and exact arithmetic. Otherwise create()
  // refuses it with wrong_separation.
  double separation = 0;
  // Whether evaluate, first_contact and limit keep the pairs of features that they found near. Then
  // a next question about a shorter step from the same start is answered from these pairs in 0.03
  // to 0.4 of the time, provided that the arithmetic is exact and the step has no views (L20).
  // After a first_contact, the first contact of any step in the same direction is found as fast.
  // Answers, pairs and times do not depend on this option; counts do, and so do decisions of
  // `automatic` that rest on counts. It takes up to 300 bytes a triangle, 550 during the search,
  // and up to 2 % of the time of a first question.
  bool keeps_near = false;
};

// Calls visit(name, option) for each option whose type is an enum.
template <class Options, class Visit>
constexpr void for_each_choice(Options& options, const Visit& visit) {
  visit("culling", options.culling);
  visit("start", options.start);
  visit("pairs", options.pairs);
  visit("arithmetic", options.arithmetic);
}

}  // namespace assay::detector
