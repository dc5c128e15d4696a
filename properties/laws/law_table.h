// Counts how often each law was met over many cases, and whether it held.
#pragma once

#include <string>
#include <vector>

#include "properties/laws/law.h"

namespace assay::properties {

// The order in which cases are added and tables are merged does not matter, so shards and threads
// may have one each.
class LawTable {
 public:
  LawTable();

  // Checks every law on the case. A dear law is checked on its share of the cases, chosen by the
  // case's id.
  void add(CaseFacts& facts);
  void merge(const LawTable& other);

  // In the order of laws().
  const std::vector<LawTally>& tallies() const { return tallies_; }
  std::uint64_t broken() const;
  // The laws met less often than `premises`, or close in a smaller share than `least_close`.
  std::vector<const Law*> starved(std::uint64_t premises, double least_close) const;

  // One line for each law: name, premise, share of close ones, broken; below it what first broke
  // it.
  std::string text() const;

 private:
  std::vector<LawTally> tallies_;
};

}  // namespace assay::properties
