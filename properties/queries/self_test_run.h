// Runs the oracle's own check: families of queries go through all methods, in several threads.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "properties/queries/self_test_families.h"

namespace assay::properties {

struct SelfTestOptions {
  std::uint64_t seed = 1;
  std::uint64_t queries = 20'000;  // random small-integer queries; sets the size of the others too
  int jobs = 1;                    // threads; counts and failures do not depend on it
  std::function<bool()> stop;      // asked between cases, from any thread; may be empty
  bool stop_at_contradiction = false;
};

struct SelfTestFailure {
  std::uint64_t index = 0;
  std::string contradiction;
};

struct FamilyResult {
  QueryTally tally;
  bool complete = false;  // every index was checked
  double seconds = 0;
  std::vector<SelfTestFailure> failures;  // the first few, ascending by index
};

// `progress` is told how many indices of the family are done, from one thread at a time.
FamilyResult run_family(const SelfTestFamily& family, const SelfTestOptions& options,
                        const std::function<void(std::uint64_t done)>& progress);

// A case of the self-test, found by its name "family:seed:index"; nothing if there is none.
struct SelfTestCase {
  const SelfTestFamily* family = nullptr;
  std::uint64_t seed = 0, index = 0;
};
std::optional<SelfTestCase> self_test_case(const std::string& name);

}  // namespace assay::properties
