// A family of hard cases at all strengths, in several arithmetics.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "corpus/hard/hard_families.h"
#include "reports/bench/stability/stability_cell.h"
#include "reports/bench/stability/stability_run.h"

namespace assay::reports {

struct StabilityPlan {
  int strength_step = 1;  // of 0, step, 2 step ...; strongest and touching are always among them
  int rounds = 2;         // of all kinds of the family, at each strength
  int touching_rounds = 10;
  int most_triangles = 5000;  // strengths of larger meshes are left out
};

// Answers kept under a change, of those in which it is exact.
struct Survival {
  int changed = 0, same = 0;
};

// One family in one arithmetic.
struct FamilyStability {
  std::vector<StabilityCell> cells;   // by strength, ascending
  std::vector<Survival> survivals;    // in the order of case_changes()
  detector::ContactRungCounts rungs;  // of elementary tests past axis order
  detector::ViewCounts view_rungs;
  std::string first_wrong, first_missed, first_late;  // ids of cases; empty: none

  // The least strength at which a case is not right.
  std::optional<int> breaks_at() const;
  StabilityCell total() const;  // of all strengths; strength, exponent and knob are those of none
};

// One for each subject. `disagreements`: ids of cases of which the oracle says another thing than
// their construction. `tick` is called after each case.
std::vector<FamilyStability> measure_stability(const corpus::HardFamily& family,
                                               std::span<const StabilitySubject> subjects,
                                               const StabilityPlan& plan,
                                               std::vector<std::string>& disagreements,
                                               const std::function<void()>& tick);

}  // namespace assay::reports
