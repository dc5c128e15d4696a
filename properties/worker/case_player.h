// Plays a case through the built-in detector, which carries its state from step to step.
#pragma once

#include <optional>
#include <vector>

#include "corpus/cases/case_file.h"
#include "detector/detector.h"
#include "detector/step/stages.h"

namespace assay::properties {

// The primitive that the case states for the step (corpus::view_of_step), as the detector takes
// it; none if the case states none, or if the culling uses no views. It is inline because
// tests/mutation links the detector alone.
inline std::vector<detector::ViewPrimitive> given_view(
    std::optional<detector::ViewPrimitive> stated, detector::Culling culling) {
  if (!stated || !uses_views(culling)) return {};
  // A segment serves as a point by its first end.
  if (culling == detector::Culling::view_point) stated->q1 = stated->q0;
  return {*stated};
}

class CasePlayer {
 public:
  // Makes a new detector from the first frame, with these stages or the standard ones. What counts
  // is the case's to say, not the options'. The case must outlive the player. Errors and cost are
  // those of Detector::create.
  static detector::Expected<CasePlayer> make(const corpus::Case& c,
                                             const detector::Options& options,
                                             std::optional<detector::Stages> stages = {},
                                             const detector::StopFunction& stop = {});

  // The number of steps of the case. All functions below REQUIRE s < steps().
  std::size_t steps() const { return script_.size(); }
  const corpus::CaseStep& step(std::size_t s) const { return script_[s]; }
  const detector::Positions& x_t0(std::size_t s) const { return start_of(*case_, script_[s]); }
  const detector::Positions& x_t1(std::size_t s) const { return end_of(*case_, script_[s]); }

  // Plays step s as the script says: the state advances if the script commits the step and it has
  // an answer. Steps may be played in any order; a step that does not continue the detector's
  // state is a new start for it.
  detector::StepResult play(std::size_t s, const detector::StopFunction& stop = {});
  // Returns the same result, but the state stays as it is; detector().commit() can still advance
  // it.
  detector::StepResult look(std::size_t s, const detector::StopFunction& stop = {});

  detector::Detector& detector() { return detector_; }
  const detector::Detector& detector() const { return detector_; }

 private:
  CasePlayer(const corpus::Case& c, const detector::Options& options, detector::Detector detector);

  const corpus::Case* case_;
  std::vector<corpus::CaseStep> script_;
  // The view primitives given, by step. They are computed beforehand, so that whoever times a step
  // times the detector alone.
  std::vector<std::vector<detector::ViewPrimitive>> given_;
  detector::Detector detector_;
};

}  // namespace assay::properties
