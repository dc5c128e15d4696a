// All that the stores of a folder hold of one campaign: what a certificate is computed from.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "properties/campaign/store.h"

namespace assay::reports {

struct StoreFile {
  std::string name;    // without its folder
  std::string sha256;  // of its bytes
};

struct Findings {
  nlohmann::ordered_json binding;    // of the run; its `shard` means nothing
  std::vector<StoreFile> files;      // by name
  std::vector<std::string> shards;   // "1/4", of those that are there
  std::vector<std::string> missing;  // of those that are not
  properties::Tally tally;
  properties::Counts signatures;                    // failures met
  std::vector<properties::StoredFailure> failures;  // one a signature, the smallest mesh
  std::map<std::string, std::vector<properties::Evidence>, std::less<>> evidence;  // by kind
  // SHA-256 over all rows but times: the same for the same campaign, however long it took.
  std::string rows;

  // Of a kind, by name and shard; empty where there are none.
  const std::vector<properties::Evidence>& of(std::string_view kind) const;
  // Facts of the first one of this kind and name; null where there is none.
  nlohmann::ordered_json facts(std::string_view kind, std::string_view name) const;
};

// OUT/checks.sqlite: what `assay certify` finds out by itself.
std::filesystem::path checks_file(const std::filesystem::path& out);

// Of one store alone.
std::optional<Findings> read_one_store(const std::filesystem::path& file, std::string& problem);

// Reads merged.sqlite where there is one, else every shard-*.sqlite, and checks.sqlite. One line in
// `problem` where there is nothing, a file cannot be read, two are of different runs, or a trial is
// none that its shard plans.
std::optional<Findings> read_findings(const std::filesystem::path& folder, std::string& problem);

}  // namespace assay::reports
