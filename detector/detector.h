// The production detector: view-based continuous self-collision detection of a deforming mesh.
//
//   auto detector = Detector::create(triangles, positions, {});   // Expected<Detector>
//   StepResult result = detector.value().step(x_t0, x_t1);
//   if (result.answer == Answer::collision) use(result.first, result.pairs);
//
// Every vertex moves linearly from x_t0 to x_t1 over t in [0,1]. Answers are those of exact
// arithmetic on the doubles given, unless another is asked for (Arithmetic). Touching counts;
// triangles that share a vertex or an edge are in contact when they meet beyond what they share.
// The primitive may be anywhere, inside or not.
//
// State is per triangle, clean or dirty (L8, L9), and belongs to exact positions: evaluate() leaves
// it alone, commit() advances it to the end of the step evaluated last, step() is both. A step that
// starts elsewhere than the committed positions is treated as a new start. Each call completes or
// changes nothing. One instance a thread; no globals.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "detector/mesh/surface.h"
#include "detector/options.h"
#include "detector/step_result.h"

namespace assay::detector {

struct StateFields;  // of no concern to users
struct Stages;       // assembly.h

// What a detector carries from step to step, as a value that can be copied and kept, and as bytes
// in a file. Copies share what they hold; nothing of it ever changes.
class SavedState {
 public:
  explicit SavedState(StateFields fields);

  // The same bytes on every machine: 24 a vertex, 1 a triangle, 16 a pair in contact, and what the
  // components and holes take. O(M).
  std::vector<std::uint8_t> bytes() const;
  // damaged_state, other_state_version; of which mesh it is, restore() checks. Takes no more memory
  // than a few times the bytes that are there, whatever they say. O(M).
  static Expected<SavedState> read(std::span<const std::uint8_t> bytes);

  const StateFields& fields() const { return *fields_; }

 private:
  std::shared_ptr<const StateFields> fields_;
};

class Detector {
 public:
  // Errors: those of check_triangles and check_positions. `positions` shape the tree and the view
  // anchors and apexes (preprocessing, O((M + ghosts) log M)); any positions of the mesh will do,
  // the first frame is best.
  static Expected<Detector> create(const TrianglesView& triangles, const PositionsView& positions,
                                   const Options& options);
  // The same, and `stop` ends it: error stopped. Asked after every few milliseconds of work, but
  // for the adjacency of the mesh and its checks, 0.5 us a triangle, of which it is asked in
  // between.
  static Expected<Detector> create(const TrianglesView& triangles, const PositionsView& positions,
                                   const Options& options, const StopFunction& stop);
  Detector(Detector&&) noexcept;
  Detector& operator=(Detector&&) noexcept;
  ~Detector();

  // primitives: none (the detector's own), one for all components, or one for each component, in
  // the order of topology().components; points or lines, fixed or moving, another one in each step
  // if so wished. Errors: wrong_primitive_count, non_finite_coordinate. With view-auto they serve
  // in the steps that use views.
  // `stop` ends long work with the answer undecided.
  StepResult evaluate(const PositionsView& x_t0, const PositionsView& x_t1,
                      std::span<const ViewPrimitive> primitives = {},
                      const StopFunction& stop = {});

  // Advances the state to the end of the step evaluated last; nothing_to_commit without one, or
  // when that evaluate had no answer (error, undecided).
  std::optional<Problem> commit();

  // evaluate, and commit where there is an answer.
  StepResult step(const PositionsView& x_t0, const PositionsView& x_t1,
                  std::span<const ViewPrimitive> primitives = {}, const StopFunction& stop = {});

  // What later steps rest on: the last commit, and where views and apexes are placed.
  SavedState state() const;

  // Goes on from there: further results are those of the detector that was saved, bit by bit (where
  // both were made from the same positions; else all but the counts). What was evaluated and not
  // committed is dropped. foreign_state, and nothing changes, when it is of another mesh or
  // culling.
  std::optional<Problem> restore(const SavedState& state);

  // Forgets the state: the next step is a new start.
  void reset();

  const Topology& topology() const;
  // The mesh with the ghosts that close it.
  const Surface& surface() const;

 private:
  struct Parts;
  explicit Detector(std::unique_ptr<Parts> parts);
  friend Expected<Detector> assemble(const TrianglesView&, const PositionsView&, const Options&,
                                     Stages, const StopFunction&);
  std::unique_ptr<Parts> parts_;
};

}  // namespace assay::detector
