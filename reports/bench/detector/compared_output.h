// What `bench --detector` found, as a table, as JSON and as CSV (reports/README.md).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "reports/bench/detector/compared_sequence.h"

namespace assay::reports {

// What is compared, then one row for each sequence: the times of both, their ratio with its
// interval, the same for preprocessing, and errors.
std::string text_of(const ComparedDetector& detector, std::span<const ComparedSequence> sequences);

nlohmann::ordered_json to_json(const ComparedDetector& detector);
nlohmann::ordered_json to_json(std::span<const ComparedSequence> sequences);

// One line for each sequence and round; a single line for a sequence without times.
std::string csv_of(std::span<const ComparedSequence> sequences);

}  // namespace assay::reports
