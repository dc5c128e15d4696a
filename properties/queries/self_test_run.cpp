#include "properties/queries/self_test_run.h"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <iterator>
#include <mutex>
#include <string_view>
#include <thread>

namespace assay::properties {
namespace {

constexpr std::uint64_t indices_at_once = 64;  // indices that a thread takes at once
constexpr std::size_t failures_kept = 5;

// The state that the threads of one family share.
class Run {
 public:
  Run(const SelfTestFamily& family, const SelfTestOptions& options,
      const std::function<void(std::uint64_t)>& progress)
      : family_(family),
        options_(options),
        progress_(progress),
        end_(family.indices(options.queries)) {}

  void work() {
    while (!stopped_) {
      const std::uint64_t begin = next_.fetch_add(indices_at_once);
      if (begin >= end_) return;
      FamilyResult found;
      const std::uint64_t end = std::min(begin + indices_at_once, end_);
      std::uint64_t index = begin;
      for (; index < end && !stopped_; ++index) {
        if (options_.stop && options_.stop()) {
          stopped_ = true;
          break;
        }
        auto wrong = family_.check(options_.seed, index, found.tally);
        if (!wrong) continue;
        found.failures.push_back({index, std::move(*wrong)});
        stopped_ = stopped_ || options_.stop_at_contradiction;
      }
      merge(found, index - begin);
    }
  }

  FamilyResult result() {
    result_.complete = done_ == end_;
    return std::move(result_);
  }

 private:
  void merge(FamilyResult& found, std::uint64_t done) {
    const std::lock_guard lock(mutex_);
    result_.tally += found.tally;
    auto& kept = result_.failures;
    std::move(found.failures.begin(), found.failures.end(), std::back_inserter(kept));
    std::sort(kept.begin(), kept.end(),
              [](const auto& a, const auto& b) { return a.index < b.index; });
    if (kept.size() > failures_kept) kept.resize(failures_kept);
    done_ += done;
    if (progress_) progress_(done_);
  }

  const SelfTestFamily& family_;
  const SelfTestOptions& options_;
  const std::function<void(std::uint64_t)>& progress_;
  const std::uint64_t end_;
  std::atomic<std::uint64_t> next_ = 0;
  std::atomic<bool> stopped_ = false;
  std::mutex mutex_;
  FamilyResult result_;
  std::uint64_t done_ = 0;
};

std::optional<std::uint64_t> whole_number(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

}  // namespace

FamilyResult run_family(const SelfTestFamily& family, const SelfTestOptions& options,
                        const std::function<void(std::uint64_t)>& progress) {
  const auto begin = std::chrono::steady_clock::now();
  Run run(family, options, progress);
  {
    std::vector<std::jthread> others;
    for (int i = 1; i < options.jobs; ++i) others.emplace_back([&run] { run.work(); });
    run.work();
  }
  FamilyResult result = run.result();
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

std::optional<SelfTestCase> self_test_case(const std::string& name) {
  const auto last = name.rfind(':');
  if (last == std::string::npos || last == 0) return {};
  const auto middle = name.rfind(':', last - 1);
  if (middle == std::string::npos) return {};
  const std::string_view all = name;
  const auto seed = whole_number(all.substr(middle + 1, last - middle - 1));
  const auto index = whole_number(all.substr(last + 1));
  if (!seed || !index) return {};
  for (const auto& family : self_test_families()) {
    if (family->name() == all.substr(0, middle)) return SelfTestCase{family.get(), *seed, *index};
  }
  return {};
}

}  // namespace assay::properties
