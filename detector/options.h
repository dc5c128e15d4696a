// The options of a detector. An option that is not set has its default:
//
//   Options options;
//   options.pairs = Pairs::first;
//   options.threads = 0;  // one for each processor of the machine
//   Detector detector = Detector::create(triangles, positions, options).value();
//   const StepResult result = detector.step(x_t0, x_t1);
//   use(result.first);
#pragma once

#include <cstdint>

#include "detector/mesh/counted_pairs.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

enum class Culling : std::uint8_t {
  view_auto,    // view_point or view_line for each component; bvh in steps where views do not pay
  view_point,   // each component, closed by its ghosts, is seen from a point
  view_line,    // each component, closed by its ghosts, is seen from a segment
  normal_cone,  // bvh without pairs in a patch that has a normal cone and simple contour [VMT94]
  bvh,          // pairs whose boxes meet, found by a tree of boxes
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

// Returns whether the detector decides in each step whether it uses views.
constexpr bool chooses_views(Culling culling) {
  return culling == Culling::view_auto || culling == Culling::automatic;
}

// Returns whether steps may use view primitives at all.
constexpr bool uses_views(Culling culling) {
  return chooses_views(culling) || culling == Culling::view_point || culling == Culling::view_line;
}

// The triangles that are known to be clean at a new start: at the first step, and after a jump of
// positions. Under Start::verified, the cullings `automatic` and `view_auto` compute no layers. So
// a step without views verifies nothing at its start: its pairs tell which triangles are clean at
// its end (L15).
enum class Start : std::uint8_t {
  verified,  // those that L5 proves clean, or that static contacts and layers prove clean (L9)
  clean,     // all: the caller vouches that none is in contact and each component has one layer
  unknown,   // none
};
constexpr auto names_of(Start) {
  using enum Start;
  return std::to_array<Named<Start>>(
      {{verified, "verified"}, {clean, "clean"}, {unknown, "unknown"}});
}

// The pairs in contact that a step reports.
enum class Pairs : std::uint8_t {
  all,  // every pair that is in contact at some time of the step (K with closure, L7)
  // At least one pair from each connected part of the contact graph at the first contact time (L6).
  // A reported pair can meet a little later than that time. The time stated for it is then the
  // TimeEnclosure of the first contact time, or the upper end of that enclosure. Once a contact is
  // found, no later contact is looked for. `first` took 0.1 to 0.45 of the time of `all` on scenes
  // with many contacts, 0.92 on the scene rod-twist, and a few percent more than `all` on scenes
  // without a contact.
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
  // The most threads that a step and create() use; 0 means one for each processor of the machine.
  // Results, counts included, are the same for any number of threads. A library built without
  // oneTBB uses one thread.
  std::uint32_t threads = 1;
  // Which pairs count (L19); null: every pair counts. create() copies it. A pair that does not
  // count is not reported. The detector finds its contacts all the same if the state depends on
  // them.
  const CountedPairs* counted = nullptr;
  // If 0, contacts are looked for. If above 0, pairs of triangles that come within this distance
  // are looked for, in the units of the positions (L16); then pairs that share a vertex do not
  // count. REQUIRES a finite number >= 0. A number above 0 REQUIRES Culling::bvh or Culling::none,
  // and Arithmetic::exact. Otherwise create() fails with wrong_separation.
  double separation = 0;
  // Whether evaluate, first_contact and limit keep the pairs of features that they found near. If
  // the next call is about a shorter step from the same start, it is answered from these pairs in
  // 0.03 to 0.4 of the time (L20). This needs exact arithmetic and a step without views. After a
  // first_contact, the first contact of any step in the same direction is found as fast. Answers,
  // pairs and times do not depend on this option. Counts depend on it, and so do those decisions of
  // Culling::automatic that use counts. It takes up to 300 bytes a triangle, 550 during the search,
  // and up to 2 % of the time of the first call.
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
