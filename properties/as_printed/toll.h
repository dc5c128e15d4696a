// Measures what the thesis as printed misses and what it saves, over random cases of the
// campaigns' generic families.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace assay::properties {

// One detector over all steps. A missed step is counted once, under the worst that befell it.
struct TollRow {
  std::string name;
  std::uint64_t silent = 0;      // answered free, although there is a contact
  std::uint64_t late = 0;        // answered collision with a late first time
  std::uint64_t incomplete = 0;  // the first time is right, but pairs are missing
  std::uint64_t pairs_missing = 0;
  std::uint64_t candidates = 0;
  // Milliseconds of the steps without their view tests, because a deviation computes its own in
  // exact numbers. Not deterministic.
  double ms = 0;
};

struct TollTable {
  std::uint64_t cases = 0, steps = 0, colliding = 0, pairs = 0;  // counted by the oracle
  std::vector<TollRow> rows;  // the right detector, each deviation alone, all of them together
};

// Runs the cases campaign:family:0, 1, ... of each generic family. About 30 ms a case.
TollTable measure_toll(const std::string& campaign, std::uint64_t cases_of_family);

// A table, a line a row.
std::string text_of(const TollTable& table);

}  // namespace assay::properties
