#include "properties/campaign/stored/binding.h"

#include <fmt/format.h>

#include "corpus/digest.h"
#include "properties/campaign/stored/json_optional.h"
#include "properties/campaign/stored/store.h"
#include "properties/faults/fault.h"
#include "properties/generators/families.h"

namespace assay::properties {

using Json = nlohmann::json;

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(BoundDetector::Contract, adjacency, coordinates, margin)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(BoundDetector::Configuration, name, claims)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(BoundDetector, name, built_in, contract, configurations)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(BoundDigests, program, worker, plugin, generator)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(BoundRun, seed, planted_faults, shard, detector, digests)

namespace {

BoundDetector bound(const DetectorUnderTest& detector) {
  const auto& contract = detector.contract;
  BoundDetector out{detector.name,
                    detector.built_in,
                    {name_of(contract.adjacency), name_of(contract.coordinates), contract.margin},
                    {}};
  for (const auto& configuration : detector.configurations) {
    out.configurations.push_back({configuration.name, {}});
    for (const auto claim : list_of(detector.claims_in(configuration)))
      out.configurations.back().claims.emplace_back(name_of(claim));
  }
  return out;
}

// A file that is not there is found out by whoever runs it.
std::optional<std::string> digest_of(const std::filesystem::path& file) {
  const auto digest = corpus::sha256_of_file(file);
  return digest ? std::optional(digest.value()) : std::nullopt;
}

}  // namespace

std::string binding_of(const CampaignRequest& request) {
  CampaignPlan plan = request.plan;
  plan.seconds = plan.shrink_share = plan.tetrahedron_seconds = 0;
  Json json =
      BoundRun{{},
               request.seed,
               planted_count(),
               text_of(request.shard),
               bound(request.detector),
               {digest_of("/proc/self/exe"), digest_of(request.worker),
                request.plugin ? digest_of(*request.plugin) : std::nullopt, generator_digest()}};
  json["schema"] = store_schema;
  json["campaign"] = Json::parse(plan_text(plan));
  return json.dump();
}

Json json_of(const BoundDetector& detector) { return detector; }
Json json_of(const BoundDigests& digests) { return digests; }

Expected<BoundRun> read_binding(const std::string& text, const std::filesystem::path& file) try {
  const Json json = Json::parse(text);
  auto plan = parse_plan(json.at("campaign").dump(), file);
  if (!plan) return Problem{ProblemKind::damaged_store, plan.error().message};
  auto run = json.get<BoundRun>();
  run.plan = std::move(plan.value());
  return run;
} catch (const Json::exception& wrong) {
  return Problem{ProblemKind::damaged_store,
                 fmt::format("{}: not the store of a run: {}", file.string(), wrong.what())};
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
