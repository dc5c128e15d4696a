#include "properties/campaign/binding.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "corpus/digest.h"
#include "properties/campaign/store.h"
#include "properties/faults/fault.h"
#include "properties/generators/families.h"

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

std::string binding_of(const CampaignRequest& request) {
  CampaignPlan plan = request.plan;
  plan.seconds = plan.shrink_share = plan.tetrahedron_seconds = 0;
  const Json json = {{"schema", store_schema},
                     {"campaign", Json::parse(plan_text(plan))},
                     {"seed", request.seed},
                     {"shard", text_of(request.shard)},
                     {"detector", json_of(request.detector)},
                     {"planted_faults", planted_count()},
                     {"digests",
                      {{"program", digest_of("/proc/self/exe")},
                       {"worker", digest_of(request.worker)},
                       {"plugin", request.plugin ? digest_of(*request.plugin) : Json(nullptr)},
                       {"generator", generator_digest()}}}};
  return json.dump();
}

BoundRun read_binding(const std::string& text, const std::filesystem::path& file) try {
  const Json json = Json::parse(text);
  auto plan = parse_plan(json.at("campaign").dump(), file);
  if (!plan) throw StoreProblem(plan.error().message);
  const auto &detector = json.at("detector"), &digests = json.at("digests"),
             &contract = detector.at("contract");
  BoundRun run;
  run.plan = std::move(plan.value());
  run.seed = json.at("seed");
  run.planted_faults = json.at("planted_faults");
  run.shard = json.at("shard");
  run.detector = detector.at("name");
  run.built_in = detector.at("built_in");
  run.adjacency = contract.at("adjacency");
  run.coordinates = contract.at("coordinates");
  run.margin = contract.at("margin");
  for (const auto& configuration : detector.at("configurations"))
    run.configurations.push_back({configuration.at("name"), configuration.at("claims")});
  // A program that was gone when it ran has no digest.
  const auto digest = [&](const char* name) {
    return digests.at(name).is_string() ? digests.at(name).get<std::string>() : std::string();
  };
  run.program = digest("program");
  run.worker = digest("worker");
  run.generator = digest("generator");
  if (!digests.at("plugin").is_null()) run.plugin = digest("plugin");
  return run;
} catch (const nlohmann::json::exception& wrong) {
  throw StoreProblem(fmt::format("{}: not the store of a run: {}", file.string(), wrong.what()));
}

std::string generator_digest() {
  constexpr std::uint64_t cases = 16;  // of a family
  std::string digests;
  for (const auto& family : families()) {
    for (std::uint64_t i = 0; i < cases; ++i) {
      const auto made = make_case(family, fmt::format("generator-digest:1:{}:{}", family.name, i));
      digests += corpus::sha256_of(corpus::case_text(made.c)) + "\n";
    }
  }
  return corpus::sha256_of(digests);
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
