// The stage of the detector that finds which triangles are clean: by view (L5), by layers (L9), and
// from step to step (L8).
//
// Let a step go on from a committed one. A triangle is in doubt at the instant between the two
// steps if it was dirty at the start of the committed step, or if a ghost touched it or it was in
// contact with its own component during that step. After a collision found by K alone all triangles
// are in doubt, and after a step without views all triangles of a component with ghosts are (L15).
// A triangle in doubt is released if it touches nothing of S at that instant and has the common
// layer of its component. Exactly those in doubt that are not released are dirty at the start of
// the new step. A step without views releases nothing.
//
// The common layer of a component is that of its triangles that are not in doubt. If there are
// none, it is the layer that most untouched triangles of the component have (tie: the layer that
// holds the lowest triangle). L5 is a quicker way to the same result: if all of S is positive with
// winding number 1, S is embedded with one layer.
#pragma once

#include <span>

#include "detector/step/step_work.h"

namespace assay::detector {

class ReleaseRule {
 public:
  // In bounded arithmetic a triangle is not released if doubles cannot tell.
  explicit ReleaseRule(Arithmetic arithmetic = Arithmetic::exact) : arithmetic_(arithmetic) {}
  virtual ~ReleaseRule() = default;

  // Returns whether the state of the last commit is valid for a step that starts at vertices_t0
  // (L8).
  virtual bool still_holds(const StepState& state, const PositionsView& vertices_t0,
                           const PacedStop& pace) const {
    return state.holds_at(vertices_t0, pace);
  }

  // Applies L5 over the step: returns whether every triangle and every ghost of the component is
  // positive, and the winding number is 1 at the primitive at t=0. The component is then free and
  // all of it is clean.
  virtual bool is_free(const GivenStep& step, const StepMarks& marks, StepCost& cost,
                       std::size_t component) const;

  // Applies L5 at t=0: returns whether the component is embedded there. It is then clean, whatever
  // came before.
  virtual bool released_at_start(const GivenStep& step, const StepMarks& marks, StepCost& cost,
                                 std::size_t component) const;

  // Applies L9 at t=0 of a new start to the components listed. It looks for static contacts of mesh
  // and ghosts, then at layers by piece, and sets marks.clean for triangles of these components.
  // Returns false if stopped.
  virtual bool verify_start(const GivenStep& step, StepMarks& marks, StepCost& cost,
                            const std::vector<std::int32_t>& components) const;

  // Applies L9 at t=0 of a step that goes on from step.last_state to the components listed. Their
  // triangles whose marks.clean is 0 are in doubt by L8; marks.clean is set to 1 for those that are
  // released. Returns false if stopped. The cost is that of the triangles in doubt (layers.h).
  virtual bool release(const GivenStep& step, StepMarks& marks, StepCost& cost,
                       const std::vector<std::int32_t>& components) const;

  // Sets the clean triangles and the pairs in contact of `state`, the state at the end of the step
  // (L8). They follow from marks.clean at its start and from `pairs`, the contacts found.
  // `complete` says that these are all contacts. If they are not, no triangle is clean after a
  // collision.
  virtual void settle(const GivenStep& step, const StepMarks& marks,
                      const std::vector<PairContact>& pairs, bool complete, StepState& state) const;

  // Returns a few triangles of the component that are clean at t=0 by L8. `release` takes the
  // common layer from them.
  virtual std::vector<std::int32_t> witnesses(const GivenStep& step, const StepMarks& marks,
                                              std::size_t component) const;

  // Returns, after a step without views (L15), whether the triangles of the component that settle
  // called clean are known to be clean. They are if the component has no ghosts. If it has ghosts,
  // nobody swept these, and none of its triangles is clean, whatever the pairs were.
  virtual bool knows_clean(const GivenStep& step, const std::vector<PairContact>& pairs,
                           std::size_t component) const;

  // Returns those triangles in doubt that may touch a ghost of their component at t=0 of a step
  // that goes on from step.last_state: all of them. Triangles in no pair are included, because one
  // may hang out of a hole with a ghost through it.
  virtual std::vector<std::int32_t> may_touch_ghosts(
      const GivenStep& step, const std::vector<std::int32_t>& in_doubt) const;

 protected:
  Arithmetic arithmetic() const { return arithmetic_; }

 private:
  bool release_without_history(const GivenStep& step, StepMarks& marks, StepCost& cost,
                               const std::vector<std::int32_t>& components) const;

  Arithmetic arithmetic_;
};

// Finds what the triangles in doubt touch at the start of a step that goes on from a committed one
// (L9).
//
// Only triangles in doubt need to be looked at, because clean ones touch nothing (L8). The
// triangles that those in doubt may touch are known from the committed step:
//   Mesh against mesh: a pair that meets at the end of a step was in contact during it, so it is
//   in that step's complete pair set (L7). If one triangle pierces the other there without any
//   contact of features, it did so at the start of that step too. Both were dirty then, and the
//   pair was tested for that.
//   Mesh against ghosts: a triangle that a ghost meets at the end was touched during the step, or
//   it was pierced since before the step and so was dirty (L11). Either way it is in doubt.
//
// Sets touched[t] for the triangles of those pairs in step.last_state->contacts that still meet at
// t=0. Returns false if stopped. Costs at most 15 elementary tests a pair.
bool add_lasting_contacts(const GivenStep& step, StepCost& cost,
                          std::vector<std::uint8_t>& touched);

// Sets touched[t] for those triangles in doubt of component c that a ghost of c meets or pierces at
// t=0. Returns false if stopped. For each triangle it descends the tree of each hole. REQUIRES the
// grid of the mesh at rest at t=0, which the caller makes once for all components, because that
// takes a pass over all vertices.
bool add_ghost_touches(const GivenStep& step, StepCost& cost, const FloatGrid& grid, std::size_t c,
                       std::span<const std::int32_t> in_doubt, std::vector<std::uint8_t>& touched);

}  // namespace assay::detector
