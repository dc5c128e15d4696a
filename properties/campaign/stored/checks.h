// checks.sqlite: what `assay certify` finds out by itself, stored as it becomes known.
//
// It is written to as a stream is: after the first problem nothing more is stored, and whoever
// writes asks problem() before work that would then be for nothing.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>

#include "properties/campaign/request.h"
#include "properties/campaign/stored/evidence.h"
#include "properties/campaign/stored/store.h"

namespace assay::properties {

class Checks {
 public:
  // OUT/checks.sqlite, bound to the request; the problems are those of Store::open.
  static Expected<Checks> open(const std::filesystem::path& out, const CampaignRequest& request);

  // A struct of evidence.h.
  template <class T>
  void keep(const T& evidence) {
    update([&](Store& store) { store.set(to_row(evidence)); });
  }
  void drop(DroppedKind kind);
  // Takes away the failures of other signatures.
  void keep_failures(const std::set<std::string>& signatures);
  // As Store::seal.
  void seal();
  // As Store::known_rows.
  const RowTally& known_rows() const { return store_.known_rows(); }
  // What is stored, or the first problem.
  Expected<KeptFailures> failures() const;

  // Does what may throw StoreProblem, unless there was a problem before. For campaign/ alone.
  void update(const std::function<void(Store&)>& work);

  // The first one.
  const std::optional<Problem>& problem() const { return problem_; }

 private:
  explicit Checks(Store store) : store_(std::move(store)) {}
  Store store_;
  std::optional<Problem> problem_;
};

}  // namespace assay::properties
