// The figures of suite speed-error as a table, as JSON and as CSV (reports/README.md).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "reports/bench/speed_error/error_summary.h"

namespace assay::reports {

// "26 families (14 scene, 8 generated, 4 real), 971 steps": what the table below it is about.
std::string families_text(std::span<const FamilySummary> families);

// A table with one line for each variant: time over the reference's; unsafe and alarming steps,
// with a star if the variant is on the Pareto line of that error; wrong answers and pairs; first
// times that are off, as steps: median, largest in ulps (largest as a share of the step).
std::string text_of(std::span<const VariantSummary> variants);

nlohmann::ordered_json to_json(const Estimate& estimate);
nlohmann::ordered_json to_json(std::span<const FamilySummary> families);
nlohmann::ordered_json to_json(std::span<const VariantSummary> variants);

// One line for each step and variant, with its samples in ns separated by blanks: nothing is
// averaged.
std::string csv_of(std::span<const JudgedStep> steps);

}  // namespace assay::reports
