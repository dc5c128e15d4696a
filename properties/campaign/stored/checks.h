// checks.sqlite, in which `assay certify` stores what it finds out by itself as soon as it is
// known.
//
// It is used like an output stream: after the first problem nothing more is stored. Whoever writes
// asks problem() before starting work that would then be in vain.
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
  // Opens OUT/checks.sqlite, bound to the request; the problems are those of Store::open.
  static Expected<Checks> open(const std::filesystem::path& out, const CampaignRequest& request);

  // Stores a struct of evidence.h.
  template <class T>
  void keep(const T& evidence) {
    update([&](Store& store) { store.set(to_row(evidence)); });
  }
  void drop(DroppedKind kind);
  // Removes the stored failures whose signature is not in the set.
  void keep_failures(const std::set<std::string>& signatures);
  // See Store::seal.
  void seal();
  // See Store::known_rows.
  const RowTally& known_rows() const { return store_.known_rows(); }
  // The stored failures, or the first problem.
  Expected<KeptFailures> failures() const;

  // Does work that may throw StoreProblem, unless there was a problem before. For campaign/ alone.
  void update(const std::function<void(Store&)>& work);

  // The first problem, if any.
  const std::optional<Problem>& problem() const { return problem_; }

 private:
  explicit Checks(Store store) : store_(std::move(store)) {}
  Store store_;
  std::optional<Problem> problem_;
};

}  // namespace assay::properties
