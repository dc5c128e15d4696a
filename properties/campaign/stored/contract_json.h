// A contract as JSON: in the binding of a store, in certificates and in the reports of `check`.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "properties/claims/contract.h"

namespace assay::properties {

// Every member by its name, enums by their words, and `leaves_out`: phrases_of(contract).
void to_json(nlohmann::json& json, const Contract& contract);
// Throws nlohmann::json::exception if the JSON is no contract. `leaves_out` is not read.
void from_json(const nlohmann::json& json, Contract& contract);

}  // namespace assay::properties
