#include "properties/campaign/binding.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "corpus/digest.h"

namespace assay::properties {
namespace {

using Json = nlohmann::ordered_json;

Json words_of(const Claims& claims) {
  Json list = Json::array();
  for (const auto claim : list_of(claims)) list.push_back(name_of(claim));
  return list;
}

Json json_of(const DetectorUnderTest& detector) {
  Json configurations = Json::array();
  for (const auto& configuration : detector.configurations) {
    configurations.push_back(
        {{"name", configuration.name}, {"claims", words_of(detector.claims_in(configuration))}});
  }
  return {{"name", detector.name},
          {"built_in", detector.built_in},
          {"contract",
           {{"adjacency", name_of(detector.contract.adjacency)},
            {"coordinates", name_of(detector.contract.coordinates)},
            {"margin", detector.contract.margin}}},
          {"configurations", std::move(configurations)}};
}

// A file that is not there is found out by whoever runs it.
Json digest_of(const std::filesystem::path& file) {
  const auto digest = corpus::sha256_of_file(file);
  return digest ? Json(digest.value()) : Json(nullptr);
}

}  // namespace

std::string text_of(const Shard& shard) { return fmt::format("{}/{}", shard.index, shard.count); }

std::string binding_of(const CampaignRequest& request) {
  CampaignPlan plan = request.plan;
  plan.seconds = plan.shrink_share = plan.tetrahedron_seconds = 0;
  const Json json = {{"schema", "assay-store/1"},
                     {"campaign", Json::parse(plan_text(plan))},
                     {"seed", request.seed},
                     {"shard", text_of(request.shard)},
                     {"detector", json_of(request.detector)},
                     {"digests",
                      {{"program", digest_of("/proc/self/exe")},
                       {"worker", digest_of(request.worker)},
                       {"plugin", request.plugin ? digest_of(*request.plugin) : Json(nullptr)}}}};
  return json.dump();
}

std::optional<std::string> with_shard(const std::string& binding, const std::string& shard) {
  Json json = Json::parse(binding, nullptr, false);
  if (!json.is_object() || !json.contains("shard")) return std::nullopt;
  json["shard"] = shard;
  return json.dump();
}

std::string difference_of(const std::string& a, const std::string& b) {
  const Json left = Json::parse(a, nullptr, false), right = Json::parse(b, nullptr, false);
  if (!left.is_object() || !right.is_object()) return "one of them says not of what it is";
  const Json one = left.flatten(), other = right.flatten();
  for (const auto& [key, value] : one.items()) {
    if (key == "/shard") continue;
    if (!other.contains(key)) return fmt::format("{} {} and none", key.substr(1), value.dump());
    if (other[key] != value)
      return fmt::format("{} {} and {}", key.substr(1), value.dump(), other[key].dump());
  }
  for (const auto& [key, value] : other.items()) {
    if (!one.contains(key)) return fmt::format("{} none and {}", key.substr(1), value.dump());
  }
  return "";
}

}  // namespace assay::properties
