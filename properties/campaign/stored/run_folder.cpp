#include "properties/campaign/stored/run_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace assay::properties {

std::filesystem::path store_file(const std::filesystem::path& out, const Shard& shard) {
  return out / fmt::format("shard-{}-of-{}.sqlite", shard.index, shard.count);
}

std::vector<std::filesystem::path> stored_shards(const std::filesystem::path& folder,
                                                 std::string& problem) {
  std::error_code error;
  std::vector<std::filesystem::path> stores;
  for (const auto& file : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = file.path().filename().string();
    const bool is_shard = name.starts_with("shard-") && name.ends_with(".sqlite");
    if (is_shard || name == merged_file("").filename()) stores.push_back(file.path());
  }
  if (error) {
    problem = fmt::format("{}: {}", folder.string(), error.message());
  } else if (stores.empty()) {
    problem = fmt::format("{}: no run is stored here", folder.string());
  }
  std::sort(stores.begin(), stores.end());
  return stores;
}

std::filesystem::path failure_file(const StoredFailure& failure, bool smallest) {
  std::string stem = fmt::format("{}-{}", failure.id, failure.configuration);
  std::erase(stem, ',');
  for (char& c : stem) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.';
    if (!is_plain) c = '-';
  }
  return std::filesystem::path("failures") /
         (stem + (smallest ? "-smallest.json" : "-original.json"));
}

}  // namespace assay::properties
