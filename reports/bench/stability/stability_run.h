// One hard case in one arithmetic, held against the oracle.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "detector/detector.h"
#include "detector/step/stages.h"
#include "oracle/mesh/step.h"

namespace assay::reports {

// What is held against the oracle: an arithmetic, in stages that a test may replace.
struct StabilitySubject {
  std::string name;
  detector::Arithmetic arithmetic = detector::Arithmetic::exact;
  std::function<detector::Stages(const detector::Options&)> stages = detector::standard_stages;
};

// exact, bounded, double, float.
std::vector<StabilitySubject> all_arithmetics();

// The step of the case in this arithmetic, all pairs, start verified, by the case's own culling and
// from its view primitive where it has them, else by view-point from the detector's own primitives.
// A mesh that is refused gives that error.
detector::StepResult run_hard_case(const corpus::Case& c, const StabilitySubject& subject);

// What the oracle says of a case, found once.
class HardTruth {
 public:
  explicit HardTruth(const corpus::Case& c);

  const oracle::StepJudgement& judgement() const { return judgement_; }
  bool gives_view() const { return case_.view.has_value(); }
  // Whether it is what the case was built for: answer, first time, view signs.
  bool agrees_with_construction() const;
  // The signs seen from the primitives of this result, one for each triangle.
  const std::vector<detector::ViewSign>& signs(const detector::StepResult& result);

 private:
  const corpus::Case& case_;
  oracle::StepJudgement judgement_;
  std::vector<std::int32_t> component_of_triangle_;
  std::vector<detector::ViewPrimitive> seen_from_;
  std::vector<detector::ViewSign> signs_;
};

struct HardOutcome {
  // The answer and the set of pairs are the oracle's; where the case gives the view primitive, no
  // triangle is V+ or V- that is not. (The detector's own primitives may lie on the surface, which
  // is not what the other families are about.)
  bool right = false;
  // right, every time is the enclosure of exact arithmetic, every sign is the oracle's.
  bool exactly_right = false;
  bool missed = false;       // free against a contact, or a missing pair
  bool spurious = false;     // collision against none, or a pair too many
  bool late = false;         // the first time begins after t*, or that of a pair after its own
  bool early = false;        // the first time ends before t*
  bool wrong_signs = false;  // a triangle is V+ or V- that is not
  // First time less t*, where both collide: that of the end which is wrong, else 0. As a share of
  // the step, and in ulps of the greater of the two.
  double time_error = 0, time_error_ulps = 0;
};

HardOutcome judge_hard_case(const detector::StepResult& result, HardTruth& truth);

}  // namespace assay::reports
