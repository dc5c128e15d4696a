// What is clean, as a stage of the detector: by view (L5), by layers (L9), from step to step (L8).
//
// Dirty at the start of a step that goes on from a committed one is exactly what was dirty at the
// start of that one, or touched by a ghost or in contact with its own component during it (after a
// collision found by K alone: everything), less what is released at the instant between the two: of
// each component the triangles that touch nothing of S there and have its common layer. The common
// layer is that of the triangles that are not in doubt; where there are none, the layer that most
// untouched triangles of the component have (tie: the one that holds the lowest). L5 is a quicker
// way to the same: where all of S is positive with winding number 1, S is embedded with one layer.
#pragma once

#include "detector/step/step_work.h"

namespace assay::detector {

class ReleaseRule {
 public:
  // bounded: what doubles cannot tell is not released.
  explicit ReleaseRule(Arithmetic arithmetic = Arithmetic::exact, Release release = Release::pieces)
      : arithmetic_(arithmetic), release_(release) {}
  virtual ~ReleaseRule() = default;

  // L8: whether the state of the last commit serves a step that starts at x_t0.
  virtual bool still_holds(const StepState& state, const PositionsView& x_t0,
                           const PacedStop& pace) const {
    return state.holds_at(x_t0, pace);
  }

  // L5 over the step: every triangle of the component and every ghost of it positive, and winding
  // number 1 at the primitive at t=0. Then it is free and all of it is clean.
  virtual bool is_free(StepWork& work, std::size_t component) const;

  // L5 at t=0: the component is embedded there and clean, whatever came before.
  virtual bool released_at_start(const StepWork& work, std::size_t component) const;

  // L9 at t=0, without history, for the components listed: static contacts of mesh and ghosts, then
  // layers by piece; writes work.clean of their triangles. False when stopped.
  virtual bool verify_start(StepWork& work, const std::vector<std::int32_t>& components) const;

  // L9 at t=0 of a step that goes on from work.known, for the components listed: some of their
  // triangles are dirty by L8, and work.clean says which are not; those released are added to it.
  // False when stopped. Costs what is in doubt (static_touches.h, layers.h).
  virtual bool release(StepWork& work, const std::vector<std::int32_t>& components) const;

  // L8: work.clean of the step's start becomes that of its end, with the contacts behind it.
  // `pairs`: the contacts found; `complete`: all there are (else nothing is known after a
  // collision).
  virtual void settle(const StepWork& work, const std::vector<PairContact>& pairs, bool complete,
                      StepState& state) const;

  // The triangles that name the common layer of a component in `release`: clean at t=0 by L8.
  virtual std::vector<std::int32_t> witnesses(const StepWork& work, std::size_t component) const;

  // L15: whether what settle says is clean is so, after a step without views. It is in a component
  // that has no ghosts. Where it has some, nobody swept them, and none of it is clean, whatever the
  // pairs were.
  virtual bool knows_clean(const StepWork& work, const std::vector<PairContact>& pairs,
                           std::size_t component) const;

  // Those in doubt that may touch a ghost of their component at t=0, of a step that goes on from
  // work.known: all of them. One that is in no pair may hang outside, with a ghost through it.
  virtual std::vector<std::int32_t> may_touch_ghosts(
      const StepWork& work, const std::vector<std::int32_t>& in_doubt) const;

 protected:
  Arithmetic arithmetic() const { return arithmetic_; }

 private:
  bool release_without_history(StepWork& work, const std::vector<std::int32_t>& components) const;

  Arithmetic arithmetic_;
  Release release_;
};

}  // namespace assay::detector
