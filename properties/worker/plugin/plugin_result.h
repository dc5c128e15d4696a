// A plug-in's result as a StepResult.
#pragma once

#include <vector>

#include "detector/options.h"
#include "detector/plugin/assay_detector.h"
#include "detector/step_result.h"
#include "properties/problem.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {

// Pairs a < b, ascending, each once with its least time ([0, 1] where none is stated).
// broken_result where it breaks the header's rules; step_failed, with the plug-in's own words,
// where it says that the step has no answer. reports_pairs: whether its contract says that it
// does; else pairs break the rules.
Expected<detector::StepResult> step_result(const assay_result& raw, std::int32_t triangle_count,
                                           bool reports_pairs = true);

// The answer of a query function that returned `code`, as a step's: an error in words where there
// is none, undecided where memory failed.
QueryAnswer query_answer(std::int32_t code, const assay_query_result& raw);

// Pairs a < b, ascending, each once; broken_result for an index that is none.
Expected<std::vector<detector::TrianglePair>> candidate_pairs(const assay_candidates& raw,
                                                              std::int32_t triangle_count);

}  // namespace assay::properties
