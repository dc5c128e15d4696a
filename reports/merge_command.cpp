// `assay merge`: the stores of several shards of one campaign become one.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "properties/campaign/merge.h"
#include "properties/campaign/store.h"
#include "reports/commands.h"
#include "reports/complaint.h"
#include "reports/failure_text.h"
#include "reports/shell_word.h"

namespace assay::reports {
namespace {

// Nothing, and `problem` set, where a folder holds no store.
std::vector<std::filesystem::path> stores_of(const std::vector<std::string>& folders,
                                             std::string& problem) {
  std::vector<std::filesystem::path> stores;
  for (const auto& folder : folders) {
    auto found = stored_shards(folder, problem);
    if (!problem.empty()) return {};
    stores.insert(stores.end(), found.begin(), found.end());
  }
  return stores;
}

std::uint64_t planned_of(const nlohmann::json& campaign) {
  std::uint64_t planned = 0;
  for (const auto& stratum : campaign["strata"]) planned += stratum["cases"].get<std::uint64_t>();
  return planned;
}

}  // namespace

int run_merge(const MergeRequest& request) {
  std::string problem;
  const auto stores = stores_of(request.folders, problem);
  if (!problem.empty()) return refuse(problem);
  std::error_code error;
  std::filesystem::create_directories(request.out, error);
  if (error) return refuse(fmt::format("{}: cannot be made: {}", request.out, error.message()));
  const auto out = merged_file(request.out);
  if (const auto wrong = properties::merge_stores(stores, out)) return refuse(*wrong);
  const auto merged = properties::Store::read(out, problem);
  if (!merged) return refuse(problem);
  const auto binding = nlohmann::json::parse(merged->binding());
  const auto planned = planned_of(binding["campaign"]), trials = merged->trial_count();
  fmt::print("{} stores of campaign {}, seed {}: {} of {} trials; writes {}\n", stores.size(),
             binding["campaign"]["name"].get<std::string>(), binding["seed"].get<std::uint64_t>(),
             trials, planned, out.string());
  const auto failures = write_failures(*merged, request.out, "");
  fmt::print("{}", failures.text);
  if (failures.problem) return refuse(*failures.problem);
  if (trials < planned) {
    fmt::print("{} trials are absent: merge the shards that hold them too\n", planned - trials);
  } else {
    fmt::print("next: assay certify --campaign {} --seed {} --out {}\n",
               binding["campaign"]["name"].get<std::string>(), binding["seed"].get<std::uint64_t>(),
               shell_word(request.out));
  }
  return exit_holds;
}

}  // namespace assay::reports
