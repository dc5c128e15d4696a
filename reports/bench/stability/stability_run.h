// Runs one hard case in one arithmetic and compares the result with the oracle.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "detector/detector.h"
#include "detector/step/stages.h"
#include "oracle/mesh/step.h"

namespace assay::reports {

// What is compared with the oracle: an arithmetic, in stages that a test may replace.
struct StabilitySubject {
  std::string name;
  detector::Arithmetic arithmetic = detector::Arithmetic::exact;
  std::function<detector::Stages(const detector::Options&)> stages = detector::standard_stages;
};

// exact, bounded, double, float.
std::vector<StabilitySubject> all_arithmetics();

// Runs the step of the case in this arithmetic, with all pairs and start verified. If the case
// states a culling and a view primitive, they are used; else culling view-point, from the
// detector's own primitives. If the mesh is refused, the result is that error.
detector::StepResult run_hard_case(const corpus::Case& c, const StabilitySubject& subject);

// What the oracle says of a case, computed once.
class HardTruth {
 public:
  explicit HardTruth(const corpus::Case& c);

  const oracle::StepJudgement& judgement() const { return judgement_; }
  bool gives_view() const { return case_.view.has_value(); }
  // Whether the oracle finds what the case was built for: answer, first time, view signs.
  bool agrees_with_construction() const;
  // The exact signs as seen from the primitives of this result, one for each triangle.
  const std::vector<detector::ViewSign>& signs(const detector::StepResult& result);

 private:
  const corpus::Case& case_;
  oracle::StepJudgement judgement_;
  std::vector<std::int32_t> component_of_triangle_;
  std::vector<detector::ViewPrimitive> seen_from_;
  std::vector<detector::ViewSign> signs_;
};

struct HardOutcome {
  // The answer and the set of pairs are the oracle's, and if the case gives the view primitive, no
  // triangle is V+ or V- that really is not. (The detector's own primitives may lie on the
  // surface, which is not what the other families are about.)
  bool right = false;
  // In addition to `right`, every time is the enclosure of exact arithmetic and every sign is the
  // oracle's.
  bool exactly_right = false;
  bool missed = false;       // `free`, although there is a contact, or a missing pair
  bool spurious = false;     // `collision`, although there is none, or a pair too many
  bool late = false;         // a first time, or a pair's time, begins after the exact one
  bool early = false;        // the first time ends before t*
  bool wrong_signs = false;  // a triangle is V+ or V- that really is not
  // If both collide: the first time minus t*, for the end of its interval that is wrong, else 0.
  // Given as a share of the step, and in ulps of the greater of the two times.
  double time_error = 0, time_error_ulps = 0;
};

HardOutcome judge_hard_case(const detector::StepResult& result, HardTruth& truth);

}  // namespace assay::reports
