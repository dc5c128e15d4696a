#include "properties/campaign/ledger/run_folder.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <ctime>

#include "properties/worker/plugin/python_word.h"

namespace assay::properties {

std::filesystem::path copied_store_file(const std::filesystem::path& out, std::uint64_t seed) {
  return out / fmt::format("seed-{}.sqlite", seed);
}

Expected<std::vector<std::filesystem::path>> stored_runs(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> stores;
  for (const auto& file : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = file.path().filename().string();
    const bool is_copy = name.starts_with("seed-") && name.ends_with(".sqlite");
    if (is_copy || name == store_file("")) stores.push_back(file.path());
  }
  if (error) return Problem{fmt::format("{}: {}", folder.string(), error.message())};
  if (stores.empty()) return Problem{fmt::format("{}: no run is stored here", folder.string())};
  std::sort(stores.begin(), stores.end());
  return stores;
}

Expected<void> expect_no_other_store(const std::filesystem::path& folder,
                                     const std::set<std::filesystem::path>& expected) {
  const auto there = stored_runs(folder);
  if (!there) return boost::outcome_v2::success();
  for (const auto& file : there.value()) {
    if (!expected.contains(file))
      return Problem{
          fmt::format("{}: is of another run; name a new folder: --out NEW", file.string())};
  }
  return boost::outcome_v2::success();
}

void note_library(Store& store, const CampaignRequest& request) {
  if (!request.plugin) return;
  const auto named = request.plugin->string();
  std::error_code error;
  const auto found = std::filesystem::absolute(*request.plugin, error);
  store.set_note(library_note, error || names_python(named) ? named : found.string());
}

std::string time_in_utc() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

void note_begin(Store& store) {
  if (!store.note(begin_note)) store.set_note(begin_note, time_in_utc());
}

std::filesystem::path failure_file(const StoredFailure& failure, bool smallest) {
  std::string stem = fmt::format("{}-{}", failure.id(), failure.shown_configuration());
  std::erase(stem, ',');
  for (char& c : stem) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.';
    if (!is_plain) c = '-';
  }
  return std::filesystem::path("failures") /
         (stem + (smallest ? "-smallest.json" : "-original.json"));
}

}  // namespace assay::properties
