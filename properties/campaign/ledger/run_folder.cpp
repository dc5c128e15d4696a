#include "properties/campaign/ledger/run_folder.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <ctime>

#include "properties/campaign/ledger/binding.h"
#include "properties/worker/plugin/python_word.h"

namespace assay::properties {

namespace {

constexpr const char *library_note = "library", *begin_note = "begun";

}  // namespace

std::filesystem::path store_file(const std::filesystem::path& out, const Shard& shard) {
  return out / fmt::format("shard-{}-of-{}.sqlite", shard.index, shard.count);
}

Expected<std::vector<std::filesystem::path>> stored_shards(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> stores;
  for (const auto& file : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = file.path().filename().string();
    const bool is_shard = name.starts_with("shard-") && name.ends_with(".sqlite");
    if (is_shard || name == merged_file("").filename()) stores.push_back(file.path());
  }
  if (error) return Problem{fmt::format("{}: {}", folder.string(), error.message())};
  if (stores.empty()) return Problem{fmt::format("{}: no run is stored here", folder.string())};
  std::sort(stores.begin(), stores.end());
  return stores;
}

Expected<WholeShard> make_whole(const std::filesystem::path& file, const CampaignRequest& request) {
  return catch_store_problem([&] {
    const std::string binding = value_or_throw(Store::read(file)).binding();
    const auto difference = difference_of(binding, binding_of(request));
    if (!difference.empty()) {
      throw StoreProblem(fmt::format("{}: of another run: {}", file.string(), difference));
    }
    // The store is opened for writing, because nobody else may hold the file when it is sealed.
    Store store = value_or_throw(Store::open(file, binding));
    WholeShard whole{store.trial_count(), value_or_throw(store.kept_failures())};
    value_or_throw(store.seal());
    return whole;
  });
}

void note_library(Store& store, const CampaignRequest& request) {
  if (!request.plugin) return;
  const auto named = request.plugin->string();
  std::error_code error;
  const auto found = std::filesystem::absolute(*request.plugin, error);
  store.set_note(library_note, error || names_python(named) ? named : found.string());
}

std::optional<std::string> noted_library(const Store& store) { return store.note(library_note); }

std::string time_in_utc() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

void note_begin(Store& store) {
  if (!store.note(begin_note)) store.set_note(begin_note, time_in_utc());
}

std::optional<std::string> noted_begin(const Store& store) { return store.note(begin_note); }

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

Expected<Checks> Checks::open(const std::filesystem::path& out, const CampaignRequest& request) {
  auto store = Store::open(checks_file(out), with_shard(binding_of(request), checks_shard).value());
  if (!store) return store.error();
  return Checks(std::move(store.value()));
}

void Checks::drop(std::string_view kind) {
  update([&](Store& store) { store.drop(kind); });
}

void Checks::keep_failures(const std::set<std::string>& signatures) {
  update([&](Store& store) { store.keep_failures(signatures); });
}

void Checks::seal() {
  update([](Store& store) { value_or_throw(store.seal()); });
}

Expected<KeptFailures> Checks::failures() const {
  if (problem_) return *problem_;
  return store_.kept_failures();
}

void Checks::update(const std::function<void(Store&)>& work) {
  if (problem_) return;
  if (const auto done = catch_store_problem([&] { work(store_); }); !done) problem_ = done.error();
}

}  // namespace assay::properties
