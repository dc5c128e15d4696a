#include "reports/page_data/run_notes.h"

#include <nlohmann/json.hpp>

namespace assay::reports {

using Json = nlohmann::ordered_json;

namespace {

constexpr const char* detector_key = "detector";
constexpr const char* faults_key = "planted faults";
constexpr const char* canary_key = "canary";
constexpr const char* end_key = "end";

template <class Number>
Json or_null(const std::optional<Number>& number) {
  return number ? Json(*number) : Json();
}

Json fault_json(const properties::FaultResult& result) {
  const auto& fault = *result.fault;
  Json json = {{"name", fault.name},
               {"about", fault.about},
               {"law", fault.law},
               {"status", properties::name_of(fault.status)},
               {"found", result.found()},
               {"median_cases", or_null(result.median())},
               {"cases", Json::array()},
               {"by_curated", fault.curated.empty() ? Json() : Json(result.by_curated)},
               {"known_vertices", fault.smallest_vertices ? Json(fault.smallest_vertices) : Json()},
               {"shrunk", nullptr}};
  for (const auto& needed : result.needed) json["cases"].push_back(or_null(needed));
  if (result.reduction && result.shown_by) {
    const auto& reduction = *result.reduction;
    json["shrunk"] = {{"from_triangles", result.shown_by->triangles.rows()},
                      {"from_steps", corpus::steps_of(*result.shown_by).size()},
                      {"vertices", reduction.smallest.frames[0].rows()},
                      {"triangles", reduction.smallest.triangles.rows()},
                      {"steps", corpus::steps_of(reduction.smallest).size()},
                      {"calls", reduction.calls},
                      {"seconds", reduction.seconds}};
  }
  return json;
}

// Null where there is none; a note that is no JSON counts as none.
Json read_note(const properties::Store& store, const char* key) {
  const auto text = store.note(key);
  if (!text) return nullptr;
  auto json = Json::parse(*text, nullptr, false);
  return json.is_discarded() ? Json() : json;
}

}  // namespace

void note_detector(properties::Store& store, const properties::CampaignRequest& request) {
  Json names = Json::array();
  for (const auto& configuration : request.detector.configurations)
    names.push_back(configuration.name);
  store.set_note(detector_key, Json{{"name", request.detector.name},
                                    {"built_in", request.detector.built_in},
                                    {"library", request.plugin ? request.plugin->string() : ""},
                                    {"configurations", std::move(names)}}
                                   .dump());
}

void note_canary(properties::Store& store, const properties::CanaryResult& canary) {
  store.set_note(
      canary_key,
      Json{{"fault", canary.fault}, {"found_after", or_null(canary.found_after)}}.dump());
}

void note_faults(properties::Store& store, const std::vector<properties::FaultResult>& results) {
  Json list = Json::array();
  for (const auto& result : results) list.push_back(fault_json(result));
  store.set_note(faults_key, list.dump());
}

void note_end(properties::Store& store, const RunEndNote& end) {
  store.set_note(
      end_key,
      Json{{"outcome", end.outcome}, {"harness", end.harness}, {"bounds_met", end.bounds_met}}
          .dump());
}

std::optional<RunEndNote> noted_end(const properties::Store& store) {
  const Json json = read_note(store, end_key);
  if (!json.is_object()) return std::nullopt;
  try {
    return RunEndNote{json.at("outcome"), json.at("harness").get<std::vector<std::string>>(),
                      json.at("bounds_met")};
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

std::optional<DetectorNote> noted_detector(const properties::Store& store) {
  const Json json = read_note(store, detector_key);
  if (!json.is_object()) return std::nullopt;
  try {
    return DetectorNote{json.at("name"), json.at("built_in"), json.at("library"),
                        json.at("configurations").get<std::vector<std::string>>()};
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

Json noted_faults(const properties::Store& store) {
  const Json json = read_note(store, faults_key);
  return json.is_array() ? json : Json();
}

Json noted_canary(const properties::Store& store) {
  const Json json = read_note(store, canary_key);
  return json.is_object() ? json : Json();
}

}  // namespace assay::reports
