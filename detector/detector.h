// The production detector: view-based continuous self-collision detection of a deforming mesh. A
// detector is made once for a mesh, and then answers one step after another:
//
//   auto detector = Detector::create(triangles, positions, {});   // Expected<Detector>
//   StepResult result = detector.value().step(x_t0, x_t1);
//   if (result.answer == Answer::collision) use(result.first, result.pairs);
//
// Every vertex moves linearly from x_t0 to x_t1 over t in [0,1]. Answers are those of exact
// arithmetic on the doubles given, unless Options::arithmetic says otherwise. Touching counts as
// contact. Triangles that share a vertex or an edge are in contact when they meet beyond what they
// share. View primitives may be anywhere, inside the mesh or outside.
//
// From step to step the detector carries a state: which triangles are clean and which are dirty
// (L8, L9). It is valid at exactly the positions where the last committed step ended. evaluate()
// leaves it alone, commit() advances it to the end of the step evaluated last, and step() does
// both. A step that starts at other positions, even if one bit differs, is a new start
// (Options::start). Each call completes or leaves the state unchanged. An instance serves one
// thread at a time, and there are no globals. Answers do not depend on the caller's rounding mode
// or treatment of denormals. Each call restores the caller's settings of the processor when it
// returns, and calls a stop function under these settings.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "detector/mesh/surface.h"
#include "detector/options.h"
#include "detector/step_result.h"

namespace assay::detector {

struct StateFields;  // the fields of a SavedState, which users need not know
struct Stages;       // assembly.h
class Workers;       // assembly.h

// The state that a detector carries from step to step. It is an immutable value; copies share its
// fields. States are equal if all of their fields are equal. Comparing takes O(M) for M triangles.
class SavedState {
 public:
  explicit SavedState(StateFields fields);
  const StateFields& fields() const { return *fields_; }
  friend bool operator==(const SavedState& a, const SavedState& b);

 private:
  std::shared_ptr<const StateFields> fields_;
};

class Detector {
 public:
  // Makes a detector. Errors: those of check_triangles, check_positions and, for options.counted,
  // check_counted_pairs. The tree is made from `positions` (preprocessing, O(M log M) for M
  // triangles). View anchors and apexes are made from `positions` too, when a step first needs
  // views. Any positions of the mesh will do; the positions in the first frame are best.
  static Expected<Detector> create(const TrianglesView& triangles, const PositionsView& positions,
                                   const Options& options);
  // Makes a detector. If `stop` returns true, fails with the error `stopped`. `stop` is called
  // every few milliseconds of work, except in the few plain passes that check indices and
  // coordinates.
  static Expected<Detector> create(const TrianglesView& triangles, const PositionsView& positions,
                                   const Options& options, const StopFunction& stop);
  Detector(Detector&&) noexcept;
  Detector& operator=(Detector&&) noexcept;
  ~Detector();

  // Answers a step and leaves the state as it is. With Options::keeps_near, the next evaluation
  // takes only part of the time if its step is shorter and has the same start.
  // `primitives` is empty (the detector then places its own), or has one primitive for all
  // components, or one for each component in the order of topology().components. Each is a point or
  // a line, fixed or moving, and may differ from step to step. With `automatic` and `view_auto`,
  // primitives serve only in the steps that use views.
  // If `stop` returns true, the work ends with the answer `undecided`.
  // Errors: wrong_frame_size, wrong_primitive_count, non_finite_coordinate.
  StepResult evaluate(const PositionsView& x_t0, const PositionsView& x_t1,
                      std::span<const ViewPrimitive> primitives = {},
                      const StopFunction& stop = {});

  // Answers whether there is a contact by the time `until`, and which contact is first. This is
  // evaluate() with Pairs::first, whatever the options say. `free` means that there is no contact
  // in [0, until]; a contact at `until` itself counts. A caller that already knows a contact passes
  // its time as `until`; nothing later is looked at.
  // The step can be committed afterwards only if `until` is 1, because with a smaller `until`
  // nothing is known of the rest of the step.
  // Errors: those of evaluate; wrong_bound, if `until` is not in [0,1].
  StepResult first_contact(const PositionsView& x_t0, const PositionsView& x_t1, double until = 1,
                           const StopFunction& stop = {});

  // Advances the state to the end of the step evaluated last. Error: nothing_to_commit, if there
  // is no such step or if its evaluation had no answer (error, undecided).
  std::optional<Problem> commit();

  // Evaluates, and commits if there is an answer.
  StepResult step(const PositionsView& x_t0, const PositionsView& x_t1,
                  std::span<const ViewPrimitive> primitives = {}, const StopFunction& stop = {});

  // Returns how far the mesh may go from x_t0 towards x_t1: positions, already rounded, to which
  // the straight way is free. It is for line searches and step limiters:
  //
  //   const StepLimit limit = detector.limit(x, x + direction);
  //   x = limit.positions;
  //   detector.commit();
  //
  // A free step is taken whole. Any other step is taken up to 0.95 of its first contact time,
  // unless the way to that place, once rounded, has a contact. That can happen if two features pass
  // each other at a distance of a few units in the last place of their coordinates. Then up to 18
  // places nearer to x_t0 are tried. If the free places form roughly one interval, the place
  // returned is at least 0.98 as far as the farthest free place. `is_short` is true if the share is
  // below 0.93 of the first contact time, though the mesh starts without a contact. Share 0 means
  // that the mesh stays: there is a contact at the start, or on the way to every place that was
  // tried. With a separation, read `within the separation` for `in contact`.
  // The state stays as it is, and commit() advances it to `positions` if share is above 0.
  // Errors: those of evaluate; proves_nothing with arithmetic double_precision or single_precision.
  // Cost: one first_contact for the whole step. If the step is not free, one more for each place
  // that is tried: nearly always one place, at most 19. Options::keeps_near makes these further
  // calls faster, because they are about shorter steps from x_t0.
  StepLimit limit(const PositionsView& x_t0, const PositionsView& x_t1,
                  const StopFunction& stop = {});

  // Returns everything that later steps depend on: the state of the last commit, and the rules that
  // place view primitives and apexes. If no step has needed these rules yet, they are chosen now,
  // which takes at most as long as two steps of Culling::bvh.
  SavedState state() const;

  // Goes on from a saved state. If both detectors were made with the same options from the same
  // positions, further results equal those of the saved detector bit by bit. If they were made from
  // different positions, counts can differ, because normal cones then prove different patches free;
  // false alarms can differ too, unless the arithmetic is exact. A step that was evaluated and not
  // committed is dropped. Errors: foreign_state, if the state is of another mesh or culling, or of
  // a detector that counts pairs within other bodies (a state depends on nothing else in
  // Options::counted); damaged_state, if the state contradicts the mesh. After an error this
  // detector is unchanged.
  std::optional<Problem> restore(const SavedState& state);

  // Forgets the state and the kept pairs of features: the next step is a new start.
  void reset();

  const Topology& topology() const;
  // Returns the mesh with the ghosts that close it. If the culling has no views, the first call
  // makes the ghosts: O(M) for M triangles.
  const Surface& surface() const;

 private:
  struct Parts;
  explicit Detector(std::unique_ptr<Parts> parts);
  friend Expected<Detector> assemble(const TrianglesView&, const PositionsView&, const Options&,
                                     Stages, const StopFunction&, Workers);
  std::unique_ptr<Parts> parts_;
};

}  // namespace assay::detector
