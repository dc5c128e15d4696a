#include "properties/campaign/ledger/binding.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "corpus/digest.h"
#include "properties/campaign/ledger/row_fields.h"
#include "properties/campaign/ledger/store.h"
#include "properties/faults/fault.h"
#include "properties/fields.h"
#include "properties/generators/draft.h"
#include "properties/queries/query_families.h"

namespace assay::properties {

using Json = nlohmann::json;

ASSAY_FIELDS(BoundDetector::Configuration, name, claims)
ASSAY_FIELDS(BoundDetector, name, built_in, contract, threads, configurations, query_claims,
             unjudged_parts)
ASSAY_FIELDS(BoundDigests, program, worker, plugin, generator)

template <class Archive>
void fields(Archive& archive, BoundRun& run) {
  archive("seed", run.seed, "shares", run.shares, "planted_faults", run.planted_faults, "detector",
          run.detector, "digests", run.digests);
}

namespace {

BoundDetector bound_detector(const DetectorUnderTest& detector, std::uint64_t threads) {
  BoundDetector out{detector.name,
                    detector.built_in,
                    detector.contract,
                    threads,
                    {},
                    words_of(detector.query_claims),
                    detector.unjudged_parts};
  for (const auto* list : {&detector.configurations, &detector.of_questions}) {
    for (const auto& configuration : *list)
      out.configurations.push_back(
          {configuration.name, words_of(detector.claims_in(configuration))});
  }
  return out;
}

// Returns the digest; nothing if its file is not there. Whoever runs the file will find that out.
std::optional<std::string> digest_if(const corpus::Expected<std::string>& digest) {
  return digest ? std::optional(digest.value()) : std::nullopt;
}

Json member(const Json& json, const std::string& key) {
  if (json.is_object()) return json.value(key, Json());
  const auto index = std::stoul(key);
  return index < json.size() ? json[index] : Json();
}

// Returns the first member in which the two differ, with its path, and both values: "seed 1 and 2".
std::string first_difference(const std::string& part, const Json& a, const Json& b) {
  if (!a.is_structured() || !b.is_structured())
    return fmt::format("{} {} and {}", part, a.is_null() ? "none" : corpus::json_text(a),
                       b.is_null() ? "none" : corpus::json_text(b));
  // The name says more than any other member does.
  const bool are_named = a.is_object() && b.is_object() && a.contains("name") && b.contains("name");
  if (are_named && a["name"] != b["name"]) return first_difference(part, a["name"], b["name"]);
  for (const auto* list : {&a, &b}) {
    for (const auto& [key, unused] : list->items()) {
      const auto mine = member(a, key), its = member(b, key);
      if (mine != its) return first_difference(part + "/" + key, mine, its);
    }
  }
  return part;
}

// Returns the SHA-256 over the first cases of every family, which changes if the generator makes
// other cases. About 10 ms.
std::string generator_digest() {
  constexpr std::uint64_t cases = 16;  // this many cases of each family
  std::string digests;
  // Larger cases are made by the code of the smallest of their families.
  const auto smallest = size_families().first(1);
  for (const auto key :
       {families(), question_families(), counted_families(), query_families(), smallest}) {
    for (const auto& family : key) {
      for (std::uint64_t i = 0; i < cases; ++i) {
        const auto creation =
            make_case(family, fmt::format("generator-digest:1:{}:{}", family.name, i));
        digests += corpus::sha256_of(case_text(creation.c)) + "\n";
      }
    }
  }
  return corpus::sha256_of(digests);
}

}  // namespace

std::string binding_of(const CampaignRequest& request) {
  CampaignPlan plan = request.plan;
  plan.seconds = plan.shrink_share = plan.tetrahedron_seconds = 0;
  const BoundRun run{
      {},
      request.seed,
      request.shares,
      planted_count(),
      bound_detector(request.detector, request.limits.threads),
      {digest_if(corpus::sha256_of_file("/proc/self/exe")),
       digest_if(corpus::sha256_of_file(request.worker)),
       request.plugin ? digest_if(JudgedLibrary::of(*request.plugin, request.worker)->digest())
                      : std::nullopt,
       generator_digest()}};
  Json json = json_of_fields<Json>(run);
  json["detector"] = json_of(run.detector);
  json["schema"] = store_schema;
  json["campaign"] = Json::parse(plan_text(plan));
  if (request.own_cases) json["own_cases"] = request.own_cases->digest;
  return corpus::json_text(json);
}

Json json_of(const Contract& contract) {
  Json json = json_of_fields<Json>(contract);
  json["leaves_out"] = phrases_of(contract);
  return json;
}
Json json_of(const BoundDetector& detector) {
  Json json = json_of_fields<Json>(detector);
  json["contract"] = json_of(detector.contract);
  return json;
}
Json json_of(const BoundDigests& digests) { return json_of_fields<Json>(digests); }

Expected<BoundRun> read_binding(const std::string& text, const std::filesystem::path& file) try {
  const auto parsed = corpus::parse_sorted_json(text, file);
  if (!parsed) return Problem{parsed.error().message};
  const Json& json = parsed.value();
  auto plan = parse_plan(corpus::json_text(json.at("campaign")), file);
  if (!plan) return Problem{plan.error().message};
  BoundRun run;
  run.plan = std::move(plan.value());
  read_fields(json, run);
  constexpr std::uint64_t most_shares = 1'000'000;
  if (run.shares < 1 || run.shares > most_shares)
    return Problem{fmt::format("{}: {} is no valid number of shares", file.string(), run.shares)};
  return run;
} catch (const Json::exception& wrong) {
  return Problem{fmt::format("{}: not the store of a run: {}", file.string(), wrong.what())};
}

std::string difference_of(const std::string& a, const std::string& b, Runs runs) {
  const auto first = corpus::parse_sorted_json(a, "binding"),
             right = corpus::parse_sorted_json(b, "binding");
  const bool are_objects = first && right && first.value().is_object() && right.value().is_object();
  if (!are_objects) return "one of the two stores does not describe its run";
  std::vector<std::string> differences;
  const auto parts_of = [&](Json binding) {
    if (runs == Runs::judged_together) {
      binding.erase("seed");
      binding.erase("shares");
    }
    // If the builds differ, no other difference that follows from a build is told.
    Json& digests = binding["digests"];
    const bool is_build = digests.is_object() && digests.contains("program");
    binding["build"] = is_build ? Json{digests["program"], digests["worker"]} : Json();
    if (is_build) {
      binding["library"] = digests["plugin"];
      binding.erase("digests");
    }
    return binding;
  };
  const Json one = parts_of(first.value()), other = parts_of(right.value());
  const bool is_other_build = one["build"] != other["build"];
  if (is_other_build) differences.emplace_back("another build of assay");
  Json all = one;
  all.update(other);
  for (const auto& [part, unused] : all.items()) {
    const Json mine = one.value(part, Json()), its = other.value(part, Json());
    if (mine == its || part == "build") continue;
    if (part == "library") {
      differences.emplace_back("another build of the detector's library");
    } else if (part == "own_cases") {
      differences.emplace_back("other cases of the owner (--corpus)");
    } else if (!(is_other_build && part == "planted_faults")) {
      differences.push_back(first_difference(part, mine, its));
    }
  }
  return fmt::format("{}", fmt::join(differences, ", "));
}

}  // namespace assay::properties
