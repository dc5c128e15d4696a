// Runs the oracle's own check: families of queries go through all methods, in several threads.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "properties/queries/query_checks.h"

namespace assay::properties {

// What the self-test consists of: families of cases, each case made alone from its index.

class SelfTestFamily {
 public:
  SelfTestFamily(std::string name, std::string about)
      : name_(std::move(name)), about_(std::move(about)) {}
  virtual ~SelfTestFamily() = default;
  SelfTestFamily(const SelfTestFamily&) = delete;
  SelfTestFamily& operator=(const SelfTestFamily&) = delete;

  const std::string& name() const { return name_; }
  const std::string& about() const { return about_; }
  // How many indices to check if `queries` random small-integer queries are asked for.
  virtual std::uint64_t indices(std::uint64_t queries) const = 0;
  // The query of the case, by seed and index; nothing for whole steps and queries of distance, and
  // for some indices of a small world, which hold no case.
  virtual std::optional<GeneratedQuery> at(std::uint64_t seed, std::uint64_t index) const = 0;
  // Checks a case. Returns what is wrong with it, or nothing.
  virtual std::optional<std::string> check(std::uint64_t seed, std::uint64_t index,
                                           QueryTally& tally) const;
  // The case with its exact numbers, and what each method says of it.
  virtual std::string text(std::uint64_t seed, std::uint64_t index) const;

 private:
  std::string name_, about_;
};

// All families, the cheap and most telling ones first: named queries with the rung that must
// decide them, small worlds, whole small steps, random queries, then the larger worlds (only if
// many queries are asked for).
const std::vector<std::unique_ptr<const SelfTestFamily>>& self_test_families();

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
