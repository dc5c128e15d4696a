// Counts how much each stage of a step had to do. Counts do not depend on the machine; times do.
// The result of a step has both:
//
//   const ContactRungCounts& rungs = result.counts.narrow.rungs;
//   use(rungs.by_integers(), rungs.total());  // feature pairs
//   use(result.times.narrow_phase, result.times.total);
#pragma once

#include <cstdint>

namespace assay::detector {

// The rung of the elementary test that decided a feature pair: the order along an axis, doubles
// with error bounds, integers of fixed width, or integers without bound. `open` means that bounded
// arithmetic, which has no integers, could not tell and took the pair for a contact.
enum class ContactRung : std::uint8_t { axis, filter, fixed, unbounded, open };

struct ContactRungCounts {
  std::uint64_t axis = 0, filter = 0, fixed = 0, unbounded = 0, open = 0;
  void add(ContactRung rung) {
    ++(rung == ContactRung::axis        ? axis
       : rung == ContactRung::filter    ? filter
       : rung == ContactRung::fixed     ? fixed
       : rung == ContactRung::unbounded ? unbounded
                                        : open);
  }
  std::uint64_t by_integers() const { return fixed + unbounded; }
  std::uint64_t total() const { return axis + filter + by_integers() + open; }

  ContactRungCounts& operator+=(const ContactRungCounts& other) {
    axis += other.axis;
    filter += other.filter;
    fixed += other.fixed;
    unbounded += other.unbounded;
    open += other.open;
    return *this;
  }
};

struct SearchCounts {
  std::uint64_t box_tests = 0;
  // How often the search counted the children of a node that can contain a partner for the other
  // node of the pair.
  std::uint64_t child_counts = 0;
  // How often there was only one such child: the search then went on with it without a box test.
  std::uint64_t skipped = 0;
  std::uint64_t contour_tests = 0;  // contour tests of patches that have a normal cone
  std::uint64_t candidate_pairs = 0;

  SearchCounts& operator+=(const SearchCounts& other) {
    box_tests += other.box_tests;
    child_counts += other.child_counts;
    skipped += other.skipped;
    contour_tests += other.contour_tests;
    candidate_pairs += other.candidate_pairs;
    return *this;
  }
};

struct MarkingCounts {
  std::uint64_t changed = 0;  // triangles whose flags changed
  std::uint64_t marked = 0;   // nodes that got a flag, leaves included
  std::uint64_t cleared = 0;  // nodes that lost a flag
};

struct NarrowCounts {
  // Feature pairs that the axis rung did not decide, each counted once.
  std::uint64_t elementary_tests = 0;
  // For each rung, the number of feature pairs that it decided. `axis` decides only feature pairs
  // whose boxes meet because boxes are rounded to floats.
  ContactRungCounts rungs;

  NarrowCounts& operator+=(const NarrowCounts& other) {
    elementary_tests += other.elementary_tests;
    rungs += other.rungs;
    return *this;
  }
};

struct ViewCounts {
  std::uint64_t lanes = 0, filter = 0, exact = 0;  // triangles whose sign this rung decided
  std::uint64_t open = 0;  // triangles whose sign bounded arithmetic cannot tell: they are in V0

  ViewCounts& operator+=(const ViewCounts& other) {
    lanes += other.lanes;
    filter += other.filter;
    exact += other.exact;
    open += other.open;
    return *this;
  }
};

struct GhostCounts {
  std::uint64_t box_tests = 0;
  std::uint64_t pairs = 0;             // pairs of a ghost and a triangle whose moving boxes meet
  std::uint64_t elementary_tests = 0;  // feature pairs of these that axis order did not decide
  // The triangles of these pairs, each counted once; only the sweep of the step itself counts them.
  std::uint64_t near_triangles = 0;

  // Returns the work in units of a box test (5 ns). For one pair up to 15 feature pairs are tested
  // by axis order, and up to 6 orientations are computed. An elementary test of a feature pair that
  // axis order did not decide takes 0.1 to 2 us.
  std::uint64_t work() const { return box_tests + 32 * pairs + 64 * elementary_tests; }

  GhostCounts& operator+=(const GhostCounts& other) {
    box_tests += other.box_tests;
    pairs += other.pairs;
    elementary_tests += other.elementary_tests;
    near_triangles += other.near_triangles;
    return *this;
  }
};

// The release of dirty triangles at the start of a step that begins where the last committed step
// ended (L9).
struct ReleaseCounts {
  std::uint64_t in_doubt = 0;  // triangles that L8 does not show to be clean
  std::uint64_t released = 0;  // triangles that L9 shows to be clean again
  // Pairs tested at t=0: pairs of triangles that met in the step before, and pairs of a triangle
  // and a ghost near it.
  std::uint64_t pairs = 0;
  std::uint64_t elementary_tests = 0;
  std::uint64_t winding_numbers = 0;  // computed for pieces of the mesh (L9)
};

struct StepCounts {
  SearchCounts search;
  MarkingCounts marking;  // depends on earlier steps too, see search/pair_rule.h
  NarrowCounts narrow;
  ViewCounts view;
  GhostCounts ghosts;
  ReleaseCounts release;
  std::uint64_t closure_rounds = 0;
  std::uint64_t winding_numbers = 0;  // computed at view primitives (L5)
  std::uint64_t free_components = 0;  // shown to be free by L5, without testing any pair
};

// Wall-clock milliseconds. They are not part of the deterministic result.
struct StepTimes {
  double view_test = 0, start = 0, ghosts = 0, broad_phase = 0, narrow_phase = 0, closure = 0,
         total = 0;
};

}  // namespace assay::detector
