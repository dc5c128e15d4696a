#include "reports/bench/speed_error/error_runs.h"

#include <fmt/format.h>

#include <chrono>

#include "oracle/mesh/step.h"
#include "properties/judging/agreement.h"
#include "properties/worker/case_player.h"
#include "reports/bench/interleave.h"
#include "reports/bench/timed_step.h"

namespace assay::reports {
namespace {

using namespace detector;

// A step that takes the oracle longer than this is timed and not judged.
constexpr std::chrono::seconds oracle_limit{20};

oracle::StepJudgement judge(const corpus::Case& c, const corpus::CaseStep& step) {
  const auto end = std::chrono::steady_clock::now() + oracle_limit;
  return oracle::judge_step({start_of(c, step), end_of(c, step)}, c.triangles,
                            {1, [end] { return std::chrono::steady_clock::now() > end; }});
}

class CaseRun {
 public:
  CaseRun(const ErrorFamily& family, const TimedCase& timed, std::vector<std::string>& wrong,
          const std::function<void()>& tick)
      : family_(family), timed_(timed), wrong_(wrong), tick_(tick) {
    constexpr Eigen::Index most_triangles_for_none = 64;
    variants_ = all_variants(timed.c.triangles.rows() <= most_triangles_for_none);
    for (const auto& variant : variants_) {
      auto made = properties::CasePlayer::make(timed.c, options_of(variant));
      if (!made) throw UnusableData(timed.c.id + ": " + made.error().message);
      players_.push_back(std::move(made.value()));
    }
  }

  std::vector<JudgedStep> run() {
    for (std::size_t s = 0; s < players_.front().steps(); ++s) run_step(s);
    return std::move(done_);
  }

 private:
  Options options_of(const Variant& variant) const {
    return {variant.culling, timed_.start, variant.pairs, variant.arithmetic};
  }

  void run_step(std::size_t index) {
    std::vector<StepResult> results(variants_.size());
    const auto samples = time_all(index, results);
    const auto truth = judge(timed_.c, players_.front().step(index));
    for (std::size_t v = 0; v < variants_.size(); ++v) {
      JudgedStep out;
      out.family = family_.name;
      out.kind = family_.kind;
      out.case_id = timed_.c.id;
      out.step = index;
      out.triangles = static_cast<std::size_t>(timed_.c.triangles.rows());
      out.variant = variants_[v];
      out.ns = samples[v];
      out.reference_ns = samples[0];
      out.hash = result_hash(results[v]);
      out.box_tests = results[v].counts.search.box_tests;
      out.candidates = results[v].counts.search.candidate_pairs;
      out.elementary_tests = results[v].counts.narrow.elementary_tests;
      compare_with(truth, results[v], out);
      done_.push_back(std::move(out));
    }
    if (!players_.front().step(index).commit) return;
    for (auto& player : players_) player.detector().commit();
  }

  std::vector<std::vector<double>> time_all(std::size_t index, std::vector<StepResult>& results) {
    std::vector<std::uint64_t> hashes(variants_.size());
    std::vector<Measurement> measurements;
    for (std::size_t v = 0; v < variants_.size(); ++v) {
      measurements.push_back([&, v] {
        tick_();
        const double ns = ns_of([&] { results[v] = players_[v].look(index); });
        if (results[v].answer == Answer::error) {
          throw UnusableData(timed_.c.id + ": " + results[v].problem->message);
        }
        const auto hash = result_hash(results[v]);
        if (hashes[v] != 0 && hash != hashes[v]) complain(index, v, "two evaluations differ");
        hashes[v] = hash;
        return ns;
      });
    }
    return interleave(family_.rounds, measurements);
  }

  void compare_with(const oracle::StepJudgement& truth, const StepResult& result, JudgedStep& out) {
    out.judged = truth.complete;
    if (!out.judged) return;
    // All arithmetics are asked for what exact arithmetic would claim. Otherwise doubles, which
    // claim no pair, could miss none.
    const auto diff = properties::compare(
        result, truth, properties::claims_of({.pairs = out.variant.pairs}), {}, timed_.c.triangles);
    out.contact = truth.answer == Answer::collision;
    out.missed = diff.wrong_answer() && out.contact;
    out.false_alarm = diff.wrong_answer() && !out.contact;
    out.missing = diff.missing.size();
    out.spurious = diff.spurious.size();
    if (out.contact && result.answer == Answer::collision) {
      out.first = first_time_error(result.first, truth.first);
    }
    const auto own =
        properties::compare(result, truth, properties::claims_of(options_of(out.variant)));
    if (own.outcome != properties::Outcome::holds) {
      complain(out.step, out.variant, "refuted by the oracle");
    }
  }

  void complain(std::size_t index, std::size_t v, const char* complaint) {
    complain(index, variants_[v], complaint);
  }
  void complain(std::size_t index, const Variant& variant, const char* complaint) {
    wrong_.push_back(fmt::format("{}, case {}, step {}, {}: {}", family_.name, timed_.c.id,
                                 index + 1, name_of(variant), complaint));
  }

  const ErrorFamily& family_;
  const TimedCase& timed_;
  std::vector<std::string>& wrong_;
  const std::function<void()>& tick_;
  std::vector<Variant> variants_;
  std::vector<properties::CasePlayer> players_;
  std::vector<JudgedStep> done_;
};

}  // namespace

std::vector<JudgedStep> run_case(const ErrorFamily& family, const TimedCase& timed,
                                 std::vector<std::string>& wrong,
                                 const std::function<void()>& tick) {
  return CaseRun(family, timed, wrong, tick).run();
}

}  // namespace assay::reports
