// What `bench --detector` found, as a table, as JSON and as CSV (reports/README.md).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "reports/bench/detector/compared_sequence.h"

namespace assay::reports {

// With what it is compared, then a row a sequence: times of both, their ratio with its interval,
// the same of preprocessing, and errors.
std::string text_of(const ComparedDetector& detector, std::span<const ComparedSequence> sequences);

nlohmann::ordered_json to_json(const ComparedDetector& detector);
nlohmann::ordered_json to_json(std::span<const ComparedSequence> sequences);

// A line a sequence and round; one without times where there are none.
std::string csv_of(std::span<const ComparedSequence> sequences);

}  // namespace assay::reports
