#include "reports/bench/sequences/sequence_times.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <numeric>

#include "detector/detector.h"
#include "reports/bench/same_answers.h"
#include "reports/bench/suites.h"
#include "reports/bench/timed_step.h"

namespace assay::reports {
namespace {

using namespace detector;

// A variant that takes this many times as long as another one is no choice, and a few rounds
// suffice to tell how far off it is.
constexpr double far_off = 3;
constexpr int rounds_of_far_off = 2;

class Play {
 public:
  Play(const std::string& name, const corpus::Sequence& sequence, bool starts_clean,
       BenchReport& report)
      : name_(name), sequence_(sequence), starts_clean_(starts_clean), report_(report) {}

  std::vector<double> run(const SequenceVariant& variant) {
    auto detector =
        made(Detector::create(sequence_.triangles, sequence_.frames[0],
                              options_of_sequence(variant.culling, starts_clean_, variant.threads)),
             name_);
    std::vector<double> ms;
    for (std::size_t s = 0; s + 1 < sequence_.frames.size(); ++s) {
      const auto begin = std::chrono::steady_clock::now();
      StepResult result = detector.step(sequence_.frames[s], sequence_.frames[s + 1]);
      const std::chrono::duration<double, std::milli> taken =
          std::chrono::steady_clock::now() - begin;
      ms.push_back(taken.count());
      compare(s, variant, result);
    }
    return ms;
  }

 private:
  void compare(std::size_t s, const SequenceVariant& variant, StepResult& result) {
    const std::string label = fmt::format("{}, step {}", name_, s + 1);
    const auto hash = result_hash(result);
    const auto [known, is_new] = hashes_.try_emplace({s, variant.culling}, hash);
    if (!is_new && known->second != hash)
      report_.wrong_answers.push_back(label + ": the same culling gives another result");
    if (first_.size() == s) {
      first_.push_back(std::move(result));
    } else {
      check_same_pairs(label, first_[s], result, report_);
    }
  }

  const std::string& name_;
  const corpus::Sequence& sequence_;
  const bool starts_clean_;
  BenchReport& report_;
  std::vector<StepResult> first_;
  std::map<std::pair<std::size_t, Culling>, std::uint64_t> hashes_;
};

}  // namespace

std::vector<double> SequenceVariant::sums() const {
  std::vector<double> sums;
  for (const auto& round : ms) sums.push_back(std::accumulate(round.begin(), round.end(), 0.0));
  return sums;
}

std::vector<double> SequenceVariant::of_step(std::size_t step) const {
  std::vector<double> values;
  for (const auto& round : ms) values.push_back(round[step]);
  return values;
}

void time_sequence(const std::string& name, const corpus::Sequence& sequence, bool starts_clean,
                   int rounds, std::vector<SequenceVariant>& variants, BenchReport& report) {
  Play play(name, sequence, starts_clean, report);
  std::vector<double> first;
  for (const auto& variant : variants) {
    const auto ms = play.run(variant);
    first.push_back(std::accumulate(ms.begin(), ms.end(), 0.0));
  }
  const double least = *std::min_element(first.begin(), first.end());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t n = 0; n < variants.size(); ++n) {
      const std::size_t i = round % 2 == 0 ? n : variants.size() - 1 - n;
      const bool is_far_off = first[i] > far_off * least;
      if (!is_far_off || round < rounds_of_far_off) variants[i].ms.push_back(play.run(variants[i]));
    }
  }
}

}  // namespace assay::reports
