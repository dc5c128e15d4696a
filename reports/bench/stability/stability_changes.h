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

}  // namespace assay::reports
