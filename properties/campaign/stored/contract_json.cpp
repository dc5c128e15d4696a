#include "properties/campaign/stored/contract_json.h"

#include <nlohmann/json.hpp>

#include "properties/json_fields.h"

namespace assay::properties {

void to_json(nlohmann::json& json, const Contract& contract) {
  json = json_of_fields<nlohmann::json>(contract);
  json["leaves_out"] = phrases_of(contract);
}

void from_json(const nlohmann::json& json, Contract& contract) { read_fields(json, contract); }

}  // namespace assay::properties
