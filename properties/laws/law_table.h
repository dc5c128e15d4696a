// Counts over many cases how often the premise of each law held, how often its values came close
// (facts/value_range.h), and how often the law was broken.
#pragma once

#include <string>
#include <vector>

#include "properties/laws/law.h"

namespace assay::properties {

// Whether the case is in the share of cases on which the law is checked (Law::one_in).
bool is_checked_on(const Law& law, std::string_view case_id);

// The order in which cases are added and tables are merged does not matter, so shards and threads
// may have one each.
class LawTable {
 public:
  LawTable();

  // Checks the laws on the case: all that cost little, and each costly one if the case's id is in
  // that law's share.
  void add(CaseFacts& facts);
  void merge(const LawTable& other);

  // In the order of laws().
  const std::vector<LawTally>& tallies() const { return tallies_; }
  std::uint64_t broken() const;
  // The laws that were hardly tried: their premise held less often than `premises` times, or the
  // share of these times in which they came close is below `least_close`.
  std::vector<const Law*> starved(std::uint64_t premises, double least_close) const;

  // One line for each law: name, premise, share of close ones, broken; below it what first broke
  // it.
  std::string text() const;

 private:
  std::vector<LawTally> tallies_;
};

}  // namespace assay::properties
