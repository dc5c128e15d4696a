// The stage of the detector that finds which triangles are clean: by view (L5), by layers (L9), and
// from step to step (L8).
//
// Let a new step go on from a committed step. A triangle is in doubt at the instant between the two
// steps if it was dirty at the start of the committed step, or if during that step a ghost touched
// it or it was in contact with its own component. After a collision found without the closure (L7)
// all triangles are in doubt. After a step without views all triangles of a component with ghosts
// are in doubt (L15). A triangle in doubt is released if it touches nothing of S at that instant
// and has the common layer of its component. The triangles in doubt that are not released are dirty
// at the start of the new step; no other triangles are. A step without views releases nothing.
//
// The common layer of a component is the layer of its triangles that are not in doubt. If all its
// triangles are in doubt, it is the layer that most untouched triangles of the component have (tie:
// the layer of the lowest triangle). L5 is a quicker way to the same result: if all triangles of S
// are positive and the winding number is 1, S is embedded with one layer.
#pragma once

#include <span>

#include "detector/step/step_work.h"

namespace assay::detector {

class ReleaseRule {
 public:
  // With Arithmetic::bounded a triangle is not released if doubles cannot tell.
  explicit ReleaseRule(Arithmetic arithmetic = Arithmetic::exact) : arithmetic_(arithmetic) {}
  virtual ~ReleaseRule() = default;

  // Returns whether the last committed state is valid for a step that starts at vertices_t0 (L8).
  virtual bool still_holds(const StepState& state, const PositionsView& vertices_t0,
                           const PacedStop& pace) const {
    return state.holds_at(vertices_t0, pace);
  }

  // Applies L5 over the step: returns whether every triangle and every ghost of the component is
  // positive, and the winding number is 1 at the primitive at t=0. If so, the component is free and
  // all of its triangles are clean.
  virtual bool is_free(const GivenStep& step, const StepMarks& marks, StepCost& cost,
                       std::size_t component) const;

  // Applies L5 at t=0: returns whether the component is proved embedded at t=0. If so, all of its
  // triangles are clean, whatever came before.
  virtual bool released_at_start(const GivenStep& step, const StepMarks& marks, StepCost& cost,
                                 std::size_t component) const;

  // Applies L9 at t=0 of a new start to these components. It finds static contacts of mesh and
  // ghosts, then the layer of each piece, and sets marks.clean for the triangles of these
  // components. Returns false if stopped.
  virtual bool verify_start(const GivenStep& step, StepMarks& marks, StepCost& cost,
                            const std::vector<std::int32_t>& components) const;

  // Applies L9 to these components, at t=0 of a step that goes on from step.last_state. Their
  // triangles with marks.clean 0 are in doubt by L8; sets marks.clean to 1 for triangles that are
  // released. Returns false if stopped. The cost is proportional to the number of triangles in
  // doubt (layers.h).
  virtual bool release(const GivenStep& step, StepMarks& marks, StepCost& cost,
                       const std::vector<std::int32_t>& components) const;

  // Sets the clean triangles and the pairs in contact of `state`, the state at the end of the step
  // (L8). These follow from marks.clean, which is for the start of the step, and from `pairs`, the
  // contacts found. `complete` says that `pairs` has all contacts of the step. If it has not, no
  // triangle is clean after a collision.
  virtual void settle(const GivenStep& step, const StepMarks& marks,
                      const std::vector<PairContact>& pairs, bool complete, StepState& state) const;

  // Returns a few triangles of the component that are clean at t=0 by L8. Their layer is the common
  // layer for `release`.
  virtual std::vector<std::int32_t> witnesses(const GivenStep& step, const StepMarks& marks,
                                              std::size_t component) const;

  // After a step without views (L15): returns whether the triangles of the component for which
  // settle() has set `clean` are known to be clean. This is so if the component has no ghosts. If
  // it has ghosts, these were not swept, and none of its triangles is known to be clean, whatever
  // the pairs were.
  virtual bool knows_clean(const GivenStep& step, const std::vector<PairContact>& pairs,
                           std::size_t component) const;

  // Returns the triangles of in_doubt that may touch a ghost of their component at t=0 of a step
  // that goes on from step.last_state. This implementation returns all triangles of in_doubt, also
  // those that are in no pair, because such a triangle can hang out of a hole with a ghost through
  // it.
  virtual std::vector<std::int32_t> may_touch_ghosts(
      const GivenStep& step, const std::vector<std::int32_t>& in_doubt) const;

 protected:
  Arithmetic arithmetic() const { return arithmetic_; }

 private:
  bool release_without_history(const GivenStep& step, StepMarks& marks, StepCost& cost,
                               const std::vector<std::int32_t>& components) const;

  Arithmetic arithmetic_;
};

// Finds which triangles in doubt are touched at the start of a step that goes on from a committed
// step (L9).
//
// Only triangles in doubt need to be tested, because clean triangles touch nothing (L8). The
// committed step tells what a triangle in doubt can touch:
//   Two mesh triangles: a pair that meets at the end of the committed step was in contact during
//   that step, so it is in the complete pair set of that step (L7). If one triangle pierces the
//   other at the end without any contact of features, it pierced the other at the start of that
//   step too. Both triangles were dirty then, and the pair was tested for piercing.
//   A mesh triangle and a ghost: if they meet at the end, the ghost touched the triangle during the
//   step, or pierced it already before the step, so that the triangle was dirty (L11). In both
//   cases the triangle is in doubt.
//
// Sets touched[t] for the triangles of each pair in step.last_state->contacts that meets at t=0.
// Returns false if stopped. Makes at most 15 elementary tests a pair.
bool add_lasting_contacts(const GivenStep& step, StepCost& cost,
                          std::vector<std::uint8_t>& touched);

// Sets touched[t] for each triangle of in_doubt that a ghost of component c meets or pierces at
// t=0. Returns false if stopped. For each triangle it descends the tree of each hole. REQUIRES
// triangles of component c, and the grid of the mesh at rest at t=0. The caller makes this grid
// once for all components, because that takes a pass over all vertices.
bool add_ghost_touches(const GivenStep& step, StepCost& cost, const FloatGrid& grid, std::size_t c,
                       std::span<const std::int32_t> in_doubt, std::vector<std::uint8_t>& touched);

}  // namespace assay::detector
