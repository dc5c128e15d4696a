#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "properties/judging/agreement.h"
#include "reports/check/check_run.h"
#include "reports/steps/measures_text.h"
#include "reports/steps/step_report.h"
#include "reports/terminal/words.h"
#include "reports/terminal/work.h"

namespace assay::reports {

using properties::Outcome;

namespace {

// Returns the claims in words. The outcome names only claims that were judged.
std::string claims_text(const std::vector<std::string>& held_claims,
                        const std::vector<properties::NotJudged>& not_judged) {
  if (not_judged.empty()) return "; all claims hold\n";
  if (held_claims.empty()) return "; no claim was judged\n";
  return fmt::format("; {} hold{}\n", join(held_claims, ", "), held_claims.size() == 1 ? "s" : "");
}

}  // namespace

std::vector<ClaimResult> CheckOutcome::claim_results() const {
  using State = ClaimResult::State;
  std::map<std::string, std::string> texts;
  for (const auto& [claim, step] : first_broken)
    texts[name_of(claim)] = fmt::format("first in step {}", step + 1);
  std::vector<ClaimResult> results;
  const auto add = [&](const std::string& claim, State state, const std::string& why) {
    const auto text = texts.find(claim);
    if (text == texts.end()) {
      results.push_back({claim, state, why});
    } else {
      results.push_back({claim, State::broken, text->second});
    }
  };
  for (const auto& claim : held_claims)
    add(claim, undecided ? State::undecided : State::holds, undecided ? "undecided" : "");
  for (const auto& [claim, reason] : not_judged) add(claim, State::not_judged, reason);
  return results;
}

std::string CheckOutcome::summary() const {
  std::string text = undecided || !ending.empty() ? "no collision found so far" : "no collision";
  if (!has_answers) text = "only candidate pairs";
  if (collision_step) {
    text = fmt::format("collision at t = {} of step {}", time_text(collision_time),
                       *collision_step + 1);
  }
  if (!rest.empty()) {
    text = rest;
  } else if (unanswered_step && !collision_step) {
    text = fmt::format(
        "the oracle finds a contact at t = {} of step {}, which has no answer that "
        "can be judged",
        time_text(unanswered_time), *unanswered_step + 1);
    if (!unanswered_error.empty() && unanswered_error != ending) text += ": " + unanswered_error;
  }
  if (unsound) {
    text += "; UNSOUND: oracle and second opinion contradict each other\n";
  } else if (defect) {
    text += fmt::format("; DEFECT: {}\n", facts_differ ? "the case's expected facts do not hold"
                                          : !ending.empty() ? ending
                                                            : "detector and oracle differ");
  } else if (undecided) {
    text +=
        fmt::format("; undecided: {}\n", !ending.empty()          ? ending
                                         : !limit_reached.empty() ? limit_reached + " reached"
                                         : !losses.empty()        ? "a part of the input is lost"
                                         : is_judged && judged_steps == 0 ? "no step was judged"
                                                                          : "a step is undecided");
  } else if (!is_judged) {
    text += "; not judged\n";
  } else if (!judged_by_claims) {
    text += "; detector and oracle agree\n";
  } else if (first_missed) {
    text += fmt::format("; no claim is broken, and the contact of step {} is missed\n",
                        *first_missed + 1);
  } else {
    text += claims_text(held_claims, not_judged);
  }
  for (const auto& [claim, reason] : not_judged)
    text += fmt::format("not judged: {}, because {}\n", claim, reason);
  return text + measures_sentence(measures);
}

const char* CheckOutcome::word() const {
  if (unsound) return "unsound";
  if (defect) return name_of(Outcome::defect);
  if (!is_judged) return "not judged";
  return name_of(undecided ? Outcome::undecided : Outcome::holds);
}

Expected<int> CheckOutcome::end(bool fail_on_collision) const {
  if (!unwritten.empty()) return Problem{unwritten};
  return exit_code(fail_on_collision);
}

int CheckOutcome::exit_code(bool fail_on_collision) const {
  if (unsound) return exit_unsound;
  if (defect) return exit_defect;
  if (undecided) return exit_undecided;
  if (fail_on_collision && collision_step) return exit_collision;
  return exit_holds;
}

using Json = nlohmann::ordered_json;

Json check_report(const std::vector<std::string>& files, const detector::Topology& mesh,
                  const StepAnswers& answers, const CheckOutcome& outcome, Json steps) {
  const auto or_null = [](const std::string& text) { return text.empty() ? Json() : Json(text); };
  const auto tested = answers.to_json();
  const auto create_ms = answers.create_ms();
  return {{"schema", "assay-check/1"},
          {"version", version_text()},
          {"files", files},
          {"triangles", mesh.triangles.size()},
          {"components", mesh.components.size()},
          {"culling", tested["culling"]},
          {"arithmetic", tested["arithmetic"]},
          {"separation", answers.under_test().contract.separation},
          {"detector", tested["detector"]},
          {"detector_ended", or_null(outcome.ending)},
          {"judged", outcome.is_judged},
          {"outcome", outcome.word()},
          {"limit_reached", or_null(outcome.limit_reached)},
          {"lost", outcome.losses},
          {"peak_memory_bytes", peak_resident_bytes()},
          {"times_ms", {{"create", create_ms ? Json(*create_ms) : Json()}}},
          {"steps", std::move(steps)}};
}

void CheckOutcome::count(const properties::StepDiff& diff, const detector::StepResult& result) {
  measures += properties::measures_of({&diff, 1}, {&result, 1});
  measures.left_out_misses += diff.left_out_missed ? 1 : 0;
}

void CheckOutcome::judge_claims(const properties::DetectorUnderTest& plugin,
                                std::size_t steps_left_out) {
  measures.steps_left_out = steps_left_out;
  not_judged = properties::not_judged(plugin.claims, plugin.contract, measures);
  held_claims = words_of(without(plugin.claims, not_judged));
}

}  // namespace assay::reports
