#include "properties/campaign/stored/contract_json.h"

#include <nlohmann/json.hpp>

namespace assay::properties {
namespace {

using Json = nlohmann::json;

// Finds the value of an enum, from 0 to `last`, that has this word.
template <class Enum>
Enum value_named(const Json& word, Enum last) {
  const auto& text = word.get_ref<const std::string&>();
  for (int value = 0; value <= static_cast<int>(last); ++value) {
    if (text == name_of(static_cast<Enum>(value))) return static_cast<Enum>(value);
  }
  throw Json::other_error::create(502, "\"" + text + "\" is no word of a contract", &word);
}

}  // namespace

void to_json(Json& json, const Contract& contract) {
  json = {{"adjacency", name_of(contract.adjacency)},
          {"coordinates", name_of(contract.coordinates)},
          {"margin", contract.margin},
          {"start", name_of(contract.start)},
          {"start_distance", contract.start_distance},
          {"least_nonzero", contract.least_nonzero},
          {"largest", contract.largest},
          {"features", name_of(contract.features)},
          {"time_tolerance", contract.time_tolerance},
          {"reports_pairs", contract.reports_pairs},
          {"leaves_out", phrases_of(contract)}};
}

void from_json(const Json& json, Contract& contract) {
  contract.adjacency = value_named(json.at("adjacency"), Adjacency::no_shared_vertex);
  contract.coordinates = value_named(json.at("coordinates"), Coordinates::float32);
  contract.start = value_named(json.at("start"), StartRule::apart);
  contract.features = value_named(json.at("features"), TestedFeatures::edge_edge);
  json.at("margin").get_to(contract.margin);
  json.at("start_distance").get_to(contract.start_distance);
  json.at("least_nonzero").get_to(contract.least_nonzero);
  json.at("largest").get_to(contract.largest);
  json.at("time_tolerance").get_to(contract.time_tolerance);
  json.at("reports_pairs").get_to(contract.reports_pairs);
}

}  // namespace assay::properties
