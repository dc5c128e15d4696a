// What is clean, as a stage of the detector: by view (L5), by layers (L9), from step to step (L8).
#pragma once

#include "detector/step_work.h"

namespace assay::detector {

class ReleaseRule {
 public:
  // bounded: what doubles cannot tell is not released.
  explicit ReleaseRule(Arithmetic arithmetic = Arithmetic::exact) : arithmetic_(arithmetic) {}
  virtual ~ReleaseRule() = default;

  // L8: whether the state of the last commit serves a step that starts at x_t0.
  virtual bool still_holds(const StepState& state, const PositionsView& x_t0) const {
    return state.holds_at(x_t0);
  }

  // L5 over the step: every triangle of the component and every ghost of it positive, and winding
  // number 1 at the primitive at t=0. Then it is free and all of it is clean.
  virtual bool is_free(StepWork& work, std::size_t component) const;

  // L5 at t=0: the component is embedded there and clean, whatever came before.
  virtual bool released_at_start(const StepWork& work, std::size_t component) const;

  // L9 at t=0, without history, for the components listed: static contacts of mesh and ghosts, then
  // layers by piece; writes work.clean of their triangles. False when stopped.
  virtual bool verify_start(StepWork& work, const std::vector<std::int32_t>& components) const;

  // L8: work.clean of the step's start becomes that of its end. `pairs`: the contacts found;
  // `complete`: all there are (else nothing is known after a collision).
  virtual void settle(const StepWork& work, const std::vector<PairContact>& pairs, bool complete,
                      std::vector<std::uint8_t>& clean) const;

 private:
  Arithmetic arithmetic_;
};

}  // namespace assay::detector
