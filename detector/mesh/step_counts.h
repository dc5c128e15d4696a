// What a step did, counted by its stages. Counts do not depend on the machine; times do.
#pragma once

#include <cstdint>

namespace assay::detector {

// Which rung of the elementary test decided a feature pair: the order along an axis, doubles with
// error bounds, integers of fixed width, integers without bound. `open`: bounded arithmetic has none
// after the filter, could not tell, and counts a contact.
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
  std::uint64_t child_counts = 0;   // looks at how many children of a node may hold a partner
  std::uint64_t skipped = 0;        // nodes with a single such child, left without a box test
  std::uint64_t contour_tests = 0;  // of patches with a normal cone
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
  std::uint64_t cleared = 0;  // nodes that lost one
};

struct NarrowCounts {
  std::uint64_t elementary_tests = 0;  // feature pairs tested beyond rung 0, each once
  ContactRungCounts rungs;             // `axis`: those whose boxes met only as floats

  NarrowCounts& operator+=(const NarrowCounts& other) {
    elementary_tests += other.elementary_tests;
    rungs += other.rungs;
    return *this;
  }
};

struct ViewCounts {
  std::uint64_t lanes = 0, filter = 0, exact = 0;  // triangles settled by each rung
  std::uint64_t open = 0;                          // bounded arithmetic could not tell: zero

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
  std::uint64_t pairs = 0;             // ghost and triangle whose moving boxes are not apart
  std::uint64_t elementary_tests = 0;  // feature pairs of these tested beyond axis order
  // Triangles of those pairs, each once, in the step itself: what GhostTest::boxes calls violated.
  std::uint64_t near_triangles = 0;

  // In box tests (5 ns). A pair is up to 15 feature pairs held against axis order and up to 6
  // orientations; an elementary test beyond axis order takes 0.1 to 2 us.
  std::uint64_t work() const { return box_tests + 32 * pairs + 64 * elementary_tests; }
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

// Wall-clock milliseconds; not part of the deterministic result.
struct StepTimes {
  double view_test = 0, start = 0, ghosts = 0, broad_phase = 0, narrow_phase = 0, closure = 0,
         total = 0;
};

}  // namespace assay::detector
