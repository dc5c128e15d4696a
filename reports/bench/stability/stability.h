// Hard cases at all strengths of their families, in several arithmetics: where each of them breaks.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "corpus/hard/hard_families.h"
#include "detector/detector.h"
#include "detector/step/stages.h"
#include "oracle/mesh/step.h"
#include "properties/judging/step_errors.h"
#include "reports/bench/suites.h"

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
  const corpus::Case& of_case() const { return case_; }
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

// One family at one strength in one arithmetic: a cell of the heat map. Also the sum of such cells;
// strength, exponent and knob are then those of none.
struct StabilityCell {
  std::string family, arithmetic;
  int strength = 0;
  int exponent = 0;  // the family's knob stands at 2^exponent, or at 0 if it touches
  bool touches = false;
  std::string knob;  // what the knob is, with its unit
  int cases = 0;
  // The answer and the set of pairs are the oracle's, and if the case gives the view primitive, no
  // triangle is V+ or V- that really is not. (The detector's own primitives may lie on the
  // surface, which is not what the other families are about.)
  int right = 0;
  // In addition, every time is the enclosure of exact arithmetic and every sign is the oracle's.
  int exactly_right = 0;
  int refuted = 0;      // a claim of the arithmetic is broken, or a sign is wrong
  int wrong_signs = 0;  // a triangle is V+ or V- that really is not
  // All arithmetics are asked for what exact arithmetic claims.
  properties::StepErrors errors;

  double share_right() const { return cases ? static_cast<double>(right) / cases : 1; }
  StabilityCell& operator+=(const StabilityCell& other);
};

// Compares the result with the oracle. The cell of this one case.
StabilityCell judge_hard_case(const detector::StepResult& result, HardTruth& truth,
                              detector::Arithmetic arithmetic);

// Changes of a case that must not change its answer: other numbering, mirrored, scaled, moved.
struct ChangedCase {
  corpus::Case changed;
  std::vector<std::int32_t> triangle;  // by triangle: its index in the changed case
};

struct CaseChange {
  const char* name;
  // Makes the change; nothing if a coordinate would be rounded. The case's id is the only source
  // of randomness.
  std::optional<ChangedCase> (*make)(const corpus::Case& c);
};

// The changes: permutation (of vertices, triangles, first corners), mirror (with all triangles
// turned, so that outside stays outside), power of two (up or down, by the case's id), and
// translation (as far as it can be exact).
std::span<const CaseChange> case_changes();

// Whether both have the same answer and, triangle by triangle, the same pairs; if `times`, also
// the same times.
bool same_but_for_numbering(const detector::StepResult& original,
                            const detector::StepResult& changed,
                            std::span<const std::int32_t> triangle, bool times);

// How many answers stay the same under a change, of those cases in which the change is exact.
struct Survival {
  int changed = 0, same = 0;
};

// One family in one arithmetic.
struct FamilyStability {
  std::vector<StabilityCell> cells;   // by strength, ascending
  std::vector<Survival> survivals;    // in the order of case_changes()
  detector::ContactRungCounts rungs;  // of elementary tests that axis order did not settle
  detector::ViewCounts view_rungs;
  std::string first_wrong, first_refuted;  // ids of cases; empty: none

  // The least strength at which a case is not right.
  std::optional<int> breaks_at() const;
  StabilityCell total() const;
};

struct StabilityPlan {
  int strength_step = 1;  // 0, step, 2 step ...; strongest and touching always too
  int rounds = 2;         // rounds of all kinds of the family, at each strength
  int touching_rounds = 10;
  int most_triangles = 5000;  // strengths of larger meshes are left out
};

// Returns one result for each subject. `disagreements` gets the ids of cases for which the oracle
// says something else than their construction. `tick` is called after each case.
std::vector<FamilyStability> measure_stability(const corpus::HardFamily& family,
                                               std::span<const StabilitySubject> subjects,
                                               const StabilityPlan& plan,
                                               std::vector<std::string>& disagreements,
                                               const std::function<void()>& tick);

// Suite `stability` over any families and subjects, so that tests can hand in wrong ones. The rows
// are family by family and subject by subject. These are wrong answers: an exact subject that is
// wrong, a bounded one that is refuted, and an oracle that contradicts a construction. `cells`, if
// given, gets all cells in the order of the heat map.
BenchReport stability_of(std::span<const corpus::HardFamily> families,
                         std::span<const StabilitySubject> subjects, const BenchSettings& settings,
                         const BenchProgress& progress,
                         std::vector<StabilityCell>* cells = nullptr);

}  // namespace assay::reports
