// Changes of a case that must not change its answer: other numbering, mirrored, scaled, moved.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "corpus/cases/case_file.h"
#include "detector/options.h"
#include "detector/step_result.h"

namespace assay::reports {

struct ChangedCase {
  corpus::Case changed;
  std::vector<std::int32_t> triangle;  // its index in the changed case, by triangle
};

struct CaseChange {
  const char* name;
  // Nothing where a coordinate would be rounded. The case's id is the only randomness.
  std::optional<ChangedCase> (*make)(const corpus::Case& c);
};

// permutation (vertices, triangles, first corners), mirror (and all triangles turned, so that
// outside stays outside), power of two (both ways, as the id has it), translation (as far as can be
// exact).
std::span<const CaseChange> case_changes();

// The same answer and, triangle by triangle, the same pairs; `times`: with the same times.
bool same_but_for_numbering(const detector::StepResult& original,
                            const detector::StepResult& changed,
                            std::span<const std::int32_t> triangle, bool times);

}  // namespace assay::reports
