// The binding of a store: the text, a JSON object, that says to which run its trials belong.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "properties/campaign/request.h"
#include "properties/claims/claims.h"

namespace assay::properties {

// Returns a contract as JSON, for the binding of a store, certificates and the reports of `check`:
// every member by its name, enums by their words, and `leaves_out`: phrases_of(contract).
nlohmann::json json_of(const Contract& contract);

// Returns the binding, of schema `assay-store/9`. The object holds `campaign` (the plan, with its
// times set to 0, because a run that ran out of time can be continued), `seed`, `shares`,
// `detector` (name, built_in, contract, threads, configurations with their claims, query_claims,
// unjudged_parts), `planted_faults` (how many this build has), `digests` (SHA-256 of program,
// worker and plug-in, null for the built-in detector, and of the generator's first cases), and
// `own_cases` (SHA-256) if the run has own cases.
std::string binding_of(const CampaignRequest& request);

// The members of a binding, as types.
struct BoundDetector {
  struct Configuration {
    std::string name;
    std::vector<std::string> claims;
  };
  std::string name;
  bool built_in = true;
  Contract contract;
  std::uint64_t threads = 1;                  // WorkerLimits::threads
  std::vector<Configuration> configurations;  // DetectorUnderTest::of_questions come last
  // As in DetectorUnderTest.
  std::vector<std::string> query_claims{}, unjudged_parts{};
};
struct BoundDigests {
  // Nothing for a file that did not exist when the run began. The built-in detector has no
  // `plugin`.
  std::optional<std::string> program, worker, plugin;
  std::string generator;
};
struct BoundRun {
  CampaignPlan plan;
  std::uint64_t seed = 0, shares = 1, planted_faults = 0;
  BoundDetector detector;
  BoundDigests digests;
};
// Return the JSON for a binding and for a certificate.
nlohmann::json json_of(const BoundDetector& detector);
nlohmann::json json_of(const BoundDigests& digests);

// Reads a binding. Fails if the text is no binding of this schema; the problem names `file`.
Expected<BoundRun> read_binding(const std::string& text, const std::filesystem::path& file);

// How two runs belong together. Runs that are judged together can differ in seed and shares.
enum class Runs : std::uint8_t { the_same, judged_together };
// Returns how two bindings differ: "seed 1 and 2, another build of assay". Empty if they agree.
std::string difference_of(const std::string& a, const std::string& b, Runs runs = Runs::the_same);

}  // namespace assay::properties
