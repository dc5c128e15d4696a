// The reducer's search: the best case so far, and the judge behind a cache and limits.
#pragma once

#include <chrono>
#include <unordered_map>

#include "properties/reducer/mesh_size.h"
#include "properties/reducer/reducer.h"

namespace assay::properties {

class ReductionSearch {
 public:
  // Judges `failing` once. found() tells whether it fails, so that there is something to reduce.
  ReductionSearch(const corpus::Case& failing, const Judge& judge, const ReduceLimits& limits,
                  const OnBetter& on_better);

  bool found() const { return !finding_.signature.empty(); }
  const corpus::Case& best() const { return best_; }
  const Finding& finding() const { return finding_; }
  const MeshSize& size() const { return size_; }

  // Makes `candidate` the best case if it is valid, is smaller, and fails with the same signature.
  // Returns whether it did.
  bool offer(const corpus::Case& candidate);

  // The same, but `candidate` need not be smaller.
  bool replace(const corpus::Case& candidate);

  // What the judge says of a case of any size: a finding with the signature searched for, or
  // nothing. The best case stays as it is.
  std::optional<Finding> ask(const corpus::Case& candidate);

  // From now on a failure of the same claim and kind counts as the same, whatever its feature and
  // cause, or one of the whole signature that the best case has by then.
  void match_kind_alone(bool alone) { kind_alone_ = alone; }

  // A limit is reached: nothing is judged any more.
  bool ended() const;
  std::uint64_t calls() const { return calls_; }
  double seconds() const;

  // Calls and successes from now on count for this pass.
  void begin_pass(const std::string& name);
  const std::vector<PassStatistics>& statistics() const { return statistics_; }

 private:
  void keep(const corpus::Case& candidate, const MeshSize& size, Finding finding);

  const Judge& judge_;
  ReduceLimits limits_;
  const OnBetter& on_better_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  corpus::Case best_;
  Finding finding_;
  MeshSize size_;
  MeshSize reported_;  // the least size that on_better_ was told
  std::uint64_t calls_ = 0;
  bool matches(const Finding& finding) const;

  bool kind_alone_ = false;
  // The judged cases by the hash of their content.
  std::unordered_map<std::uint64_t, std::optional<Finding>> judged_;
  std::vector<PassStatistics> statistics_;
  std::size_t pass_ = 0;
  double pass_start_ = 0;
};

}  // namespace assay::properties
