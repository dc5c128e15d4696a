// The reducer's search: the best case so far, and the judge behind a cache and limits.
#pragma once

#include <chrono>
#include <cstdint>
#include <unordered_map>
#include <vector>

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

// How far the vertices of a mesh are from the triangles of the reported pair.

struct Rings {
  // Both are by vertex. `distance` is in edges from the nearest vertex of the focus, or
  // `unreached` if no path leads there. `parent` is a neighbour that is nearer by one, or the
  // vertex itself if its distance is 0 or unreached.
  std::vector<int> distance;
  std::vector<std::int32_t> parent;
  std::vector<std::vector<std::int32_t>> neighbours;  // ascending
  std::vector<std::int32_t> far_first;                // vertices: farthest first, then by number
  int farthest = 0;                                   // greatest distance that is reached

  static constexpr int unreached = 1 << 30;
};

// The rings around finding().focus of the best case, or around its first triangle if the focus is
// empty. O(n log n).
Rings rings_of(const ReductionSearch& search);

// The triangles with all vertices at a distance of `ring` or less.
corpus::Case within(const corpus::Case& c, const Rings& rings, int ring);

// Offers to drop or change ranges [begin, end) of a list, halves first. `try_range` is called with
// ever smaller ranges and returns whether it succeeded. After a success the list (`size`) is
// shorter, and the same place is tried again. A range is not tried a second time after a success
// elsewhere; a later call of the pass does that.
template <class Size, class TryRange>
void try_halves(const ReductionSearch& search, Size size, TryRange try_range) {
  for (std::size_t chunk = std::max<std::size_t>(1, (size() + 1) / 2);; chunk /= 2) {
    for (std::size_t begin = 0; begin < size() && !search.ended();) {
      if (!try_range(begin, std::min(begin + chunk, size()))) begin += chunk;
    }
    if (chunk == 1 || search.ended()) return;
  }
}

}  // namespace assay::properties
