// Puts the self-test's families of queries to the query of a plug-in.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "reports/terminal/complaint.h"
#include "reports/terminal/option_words.h"

namespace assay::reports {

struct QuerySelfTest {
  DetectorWords detector;
  std::uint64_t seed = 1;
  std::uint64_t queries = 20'000;    // random small-integer queries; others follow from it
  std::optional<double> time_limit;  // seconds
  std::string replay;                // "family:seed:index"; empty: all
};

// Prints a line for each family, then what the plug-in does whatever it claims, and the claims
// that it breaks. Whole steps are left out. Returns the exit code of the verdict: 1 if a claim is
// broken, 3 if the time was over.
Expected<int> self_test_of_plugin(const QuerySelfTest& request);

}  // namespace assay::reports
