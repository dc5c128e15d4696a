// Turns the results of a plug-in into those of this project.
#pragma once

#include <vector>

#include "detector/options.h"
#include "detector/plugin/assay_detector.h"
#include "detector/step_result.h"
#include "properties/problem.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {

// The result of a step. Its pairs are a < b, ascending, each once with its least time ([0, 1] if
// none is stated). Fails if it breaks the header's rules, and, with the plug-in's own words, if it
// says that the step has no answer. If `reports_pairs` is false, because the
// contract says that the plug-in reports none, pairs break the rules.
Expected<detector::StepResult> step_result(const assay_result& raw, std::int32_t triangle_count,
                                           bool reports_pairs = true);

// The answer of a query function that returned `code`, as a step has it: an error in words if
// there is no answer, undecided if memory failed.
QueryAnswer query_answer(std::int32_t code, const assay_query_result& raw);

// The candidate pairs a < b, ascending, each once. Fails if an index is none of a
// triangle.
Expected<std::vector<detector::TrianglePair>> candidate_pairs(const assay_candidates& raw,
                                                              std::int32_t triangle_count);

}  // namespace assay::properties
