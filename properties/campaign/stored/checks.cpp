#include "properties/campaign/stored/checks.h"

#include "properties/campaign/stored/binding.h"
#include "properties/campaign/stored/run_folder.h"

namespace assay::properties {

Expected<Checks> Checks::open(const std::filesystem::path& out, const CampaignRequest& request) {
  auto store = Store::open(checks_file(out), with_shard(binding_of(request), checks_shard).value());
  if (!store) return store.error();
  return Checks(std::move(store.value()));
}

void Checks::drop(DroppedKind kind) {
  update([&](Store& store) { properties::drop(store, kind); });
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
