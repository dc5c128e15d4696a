// Runs a family of hard cases at all strengths, in several arithmetics.
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
  int strength_step = 1;  // 0, step, 2 step ...; strongest and touching always too
  int rounds = 2;         // rounds of all kinds of the family, at each strength
  int touching_rounds = 10;
  int most_triangles = 5000;  // strengths of larger meshes are left out
};

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
  std::string first_wrong, first_missed, first_late;  // ids of cases; empty: none

  // The least strength at which a case is not right.
  std::optional<int> breaks_at() const;
  StabilityCell total() const;  // of all strengths; strength, exponent, knob unset
};

// Returns one result for each subject. `disagreements` gets the ids of cases for which the oracle
// says something else than their construction. `tick` is called after each case.
std::vector<FamilyStability> measure_stability(const corpus::HardFamily& family,
                                               std::span<const StabilitySubject> subjects,
                                               const StabilityPlan& plan,
                                               std::vector<std::string>& disagreements,
                                               const std::function<void()>& tick);

}  // namespace assay::reports
