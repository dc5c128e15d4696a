// The same step asked for in another way.
#include <fmt/format.h>

#include <algorithm>

#include "properties/laws/law_groups.h"
#include "properties/laws/metamorphic/halves.h"
#include "properties/laws/metamorphic/pinned_run.h"
#include "properties/laws/metamorphic/result_equality.h"
#include "properties/laws/step_law.h"

namespace assay::properties {
namespace {

using detector::StepResult;

void check_repeated_call(CaseFacts& facts, LawTally& tally) {
  const auto run = pinned_run(facts);
  auto player = run ? PinnedPlayer::make(*run, facts.options(), facts.stages_of()) : std::nullopt;
  if (!player) return;
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    const StepResult once = player->evaluate(s), again = player->evaluate(s);
    player->commit(s, again);
    std::string what = difference(once, again);
    if (what.empty()) what = difference(facts.result(s), once);
    note(facts, s, what.empty() ? holds() : what + " differs", tally);
  }
}

void check_evaluate_changes_nothing(CaseFacts& facts, LawTally& tally) {
  const auto run = pinned_run(facts);
  auto player = run ? PinnedPlayer::make(*run, facts.options(), facts.stages_of()) : std::nullopt;
  if (!player) return;
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    player->evaluate(s, facts.x_t1(s), facts.x_t0(s));
    player->evaluate(s, facts.x_t0(s), facts.x_t0(s));
    const StepResult result = player->evaluate(s);
    player->commit(s, result);
    const std::string what = difference(facts.result(s), result);
    note(facts, s, what.empty() ? holds() : what + " differs", tally);
  }
}

// The first step again, after the last one.
void check_reset(CaseFacts& facts, LawTally& tally) {
  const auto run = pinned_run(facts);
  auto player = run ? PinnedPlayer::make(*run, facts.options(), facts.stages_of()) : std::nullopt;
  if (!player) return;
  player->play();
  player->detector().reset();
  const std::string what = difference(facts.result(0), player->evaluate(0));
  note(facts, 0, what.empty() ? holds() : what + " differs", tally);
}

void check_equal_ends(CaseFacts& facts, LawTally& tally) {
  const auto run = pinned_run(facts);
  if (!run || facts.options().culling != detector::Culling::view_point) return;
  for (const auto& of_step : run->primitives) {
    const bool points = std::all_of(of_step.begin(), of_step.end(),
                                    [](const auto& primitive) { return primitive.is_point(); });
    if (!points) return;
  }
  auto options = facts.options();
  options.culling = detector::Culling::view_line;
  auto player = PinnedPlayer::make(*run, options, facts.stages_of());
  if (!player) return;
  const auto results = player->play();
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    const std::string what = difference(facts.result(s), results[s]);
    note(facts, s, what.empty() ? holds() : what + " differs", tally);
  }
}

constexpr Law repetition_law_table[] = {
    {"Change_StepHalved", "change",
     "A step in two halves, the state carried (all coordinates rounded to a grid before, so that "
     "the middle is exact), has the pairs of the whole, each at its time; of first contacts the "
     "first time.",
     "nothing", check_halves, dear},
    {"Change_EqualEndsAreAPoint", "change",
     "A segment whose ends coincide gives the result of the point, to the last bit.", "nothing",
     check_equal_ends, dear},
    {"Change_RepeatedCall", "change",
     "The same step evaluated again, by this detector or another one, gives the same bytes.",
     "nothing", check_repeated_call, dear},
    {"Change_EvaluateChangesNothing", "change",
     "Steps that are evaluated and not committed leave no trace in the results that follow.",
     "nothing", check_evaluate_changes_nothing, dear},
    {"Change_ResetStartsAnew", "change",
     "After a reset the first step gives the same bytes as it did at first.", "nothing",
     check_reset, dear},
};

}  // namespace

std::span<const Law> repetition_laws() { return repetition_law_table; }

}  // namespace assay::properties
