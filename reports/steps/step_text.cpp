#include "reports/steps/step_text.h"

#include <fmt/format.h>

#include "detector/step_result.h"
#include "reports/steps/view_use_words.h"

namespace assay::reports {

using detector::Answer;
using properties::Outcome;

std::string time_text(const detector::TimeEnclosure& time) {
  if (time.lo == time.hi) return fmt::format("{}", time.lo);
  const std::string lo = fmt::format("{:.9g}", time.lo), hi = fmt::format("{:.9g}", time.hi);
  return lo == hi ? lo : fmt::format("[{}, {}]", lo, hi);
}

namespace {

// Whether detector and oracle differ. If the outcome is `holds`, they differ in ways that break no
// claim.
bool differs(const properties::StepDiff& diff) {
  return diff.wrong_answer() || diff.wrong_first_time() || !diff.missing.empty() ||
         !diff.spurious.empty() || !diff.missing_candidates.empty() || !diff.late.empty() ||
         !diff.early.empty();
}

std::string verdict_text(const properties::StepDiff& diff) {
  if (diff.outcome == Outcome::holds) return differs(diff) ? "no claim is broken" : "agree";
  return diff.outcome == Outcome::undecided ? "undecided" : "DIFFER";
}

std::string diff_text(const properties::StepDiff& diff, bool has_stages) {
  std::string out = fmt::format("  diff: {} missing, {} spurious, {} late, {} early{}{}{}\n",
                                diff.missing.size(), diff.spurious.size(), diff.late.size(),
                                diff.early.size(), diff.wrong_answer() ? ", wrong answer" : "",
                                diff.wrong_first_time() ? ", wrong first time" : "",
                                diff.partial ? " (partial)" : "");
  if (!diff.broken.empty()) {
    out += "  broken:";
    for (const auto claim : diff.broken) out += fmt::format(" {}", properties::name_of(claim));
    out += "\n";
  }
  constexpr std::size_t most_listed = 10;
  const auto list = [&](const char* heading, const std::vector<detector::PairContact>& pairs,
                        bool has_features) {
    for (std::size_t i = 0; i < pairs.size() && i < most_listed; ++i) {
      const auto& [pair, time, feature] = pairs[i];
      out += fmt::format("  {}: triangles {} and {} at t = {}", heading, pair.a, pair.b,
                         time_text(time));
      out += has_features ? fmt::format(" ({})\n", properties::name_of(feature.kind)) : "\n";
    }
    if (pairs.size() > most_listed)
      out += fmt::format("  ... {} more\n", pairs.size() - most_listed);
  };
  list("missing", diff.missing, true);
  list("spurious", diff.spurious, has_stages);
  list("no candidate", diff.missing_candidates, true);
  return out;
}

// Tells how far off the first time is, if it is wrong.
std::string times_off_text(const properties::StepDiff& diff) {
  if (!diff.first || !diff.wrong_first_time()) return "";
  const bool is_late = diff.late_first;
  return fmt::format("  first time {}, exact {}: {} by {:.3g}\n", time_text(diff.first->detector),
                     time_text(diff.first->oracle), is_late ? "late" : "early",
                     is_late ? diff.first->late_by : diff.first->early_by);
}

// Tells the view sets. A step without views has none, so the reason why takes their place.
std::string sets_text(const detector::StepResult& result) {
  if (result.views != detector::ViewUse::used)
    return fmt::format("no views, {}", words_of(result.views));
  return fmt::format("V+ {}  V- {}  V0 {}  violated {}  dirty {}", result.view_positive,
                     result.view_negative, result.view_zero, result.violated, result.dirty);
}

std::string stages_text(const detector::StepResult& result, std::optional<double> create_ms) {
  return fmt::format(
      "  sets: {}\n"
      "  work: {} box tests, {} candidate pairs, {} elementary tests, {} closure rounds\n"
      "  ms:   {}view test {:.1f}, start {:.1f}, broad phase {:.1f}, narrow phase {:.1f}, closure "
      "{:.1f}, detector {:.1f}",
      sets_text(result), result.counts.search.box_tests, result.counts.search.candidate_pairs,
      result.counts.narrow.elementary_tests, result.counts.closure_rounds,
      create_ms ? fmt::format("create {:.1f}, ", *create_ms) : "", result.times.view_test,
      result.times.start, result.times.broad_phase, result.times.narrow_phase, result.times.closure,
      result.times.total);
}

}  // namespace

std::string step_text(std::size_t number, const detector::StepResult& result,
                      const oracle::StepJudgement* judgement, double oracle_ms,
                      const properties::StepDiff* diff, const ShownWork& shown) {
  const bool has_answer = !diff || diff->has_answer || result.answer == Answer::error;
  std::string out = fmt::format("step {}: {}", number,
                                has_answer ? properties::name_of(result.answer) : "no answer");
  if (result.answer == Answer::collision) {
    out += fmt::format(" at t = {}", time_text(result.first));
    if (shown.reports_pairs) out += fmt::format(", {} pairs in contact", result.pairs.size());
  }
  if (!diff) {
    out += "; not judged\n";
  } else if (result.answer == Answer::undecided && diff->outcome == Outcome::undecided) {
    out += "\n";
  } else {
    out += fmt::format("; {}\n", verdict_text(*diff));
  }
  if (shown.has_stages) out += stages_text(result, shown.create_ms);
  if (judgement) {
    out += fmt::format("{} {:.1f}\n  oracle: {}, {} pairs of {} feature candidates{}",
                       shown.has_stages ? ", oracle" : "  ms:   oracle", oracle_ms,
                       properties::name_of(judgement->answer), judgement->pairs.size(),
                       judgement->feature_candidates, judgement->complete ? "" : " (stopped)");
  }
  if (shown.has_stages || judgement) out += "\n";
  if (!diff) return out;
  if (diff->candidates)
    out += fmt::format("  candidates: {} pairs, at least {} needed, {} lost\n",
                       diff->candidates->given, diff->candidates->least,
                       diff->missing_candidates.size());
  out += times_off_text(*diff);
  if (diff->outcome != Outcome::holds || differs(*diff)) out += diff_text(*diff, shown.has_stages);
  return out;
}

}  // namespace assay::reports
