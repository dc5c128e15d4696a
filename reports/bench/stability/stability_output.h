// The heat map of suite `stability` as JSON and CSV (fields: reports/README.md).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "reports/bench/stability/stability_cell.h"

namespace assay::reports {

nlohmann::ordered_json to_json(std::span<const StabilityCell> heat);
// One line for each cell, without the single time errors.
std::string csv_of(std::span<const StabilityCell> heat);

}  // namespace assay::reports
