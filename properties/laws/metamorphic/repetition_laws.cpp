// Laws about one step that is evaluated in two ways.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "detector/assembly.h"
#include "detector/parallel/workers.h"
#include "detector/state/step_state.h"
#include "properties/laws/metamorphic/change_laws.h"
#include "properties/laws/metamorphic/pinned_run.h"
#include "properties/laws/step_law.h"
#include "properties/random.h"
#include "properties/worker/case_run.h"

namespace assay::properties {
namespace {

// Returns whether time t of the whole step is time u of that half. Both 2t and, for t >= 1/2, 2t -
// 1 are exact. If no double equals the time, its enclosure in the second half is closer, and lies
// inside of the one that is computed here.
bool corresponds(const TimeEnclosure& t, const TimeEnclosure& u, int half) {
  const TimeEnclosure doubled = {2 * t.lo - half, 2 * t.hi - half};
  if (t.lo == t.hi) return u == doubled;
  return doubled.lo <= u.lo && u.lo < u.hi && u.hi <= doubled.hi;
}

std::string compare_first(const StepResult& whole, const StepResult& first,
                          const StepResult& second) {
  const bool collides = whole.answer == Answer::collision;
  const int half = first.answer == Answer::collision ? 0 : 1;
  const StepResult& early = half == 0 ? first : second;
  if (collides != (early.answer == Answer::collision)) {
    return collides ? "the halves are free" : "the whole is free";
  }
  if (collides && !corresponds(whole.first, early.first, half)) return "another first time";
  return {};
}

std::string compare_pairs(const StepResult& whole, const StepResult& first,
                          const StepResult& second) {
  std::map<TrianglePair, std::pair<int, TimeEnclosure>> in_halves;
  for (const auto& contact : first.pairs) in_halves.try_emplace(contact.pair, 0, contact.time);
  for (const auto& contact : second.pairs) in_halves.try_emplace(contact.pair, 1, contact.time);
  for (const auto& [pair, time, feature] : whole.pairs) {
    const int half = time.hi <= 0.5 ? 0 : 1;
    const auto node = in_halves.extract(pair);
    if (!node || node.mapped().first != half || !corresponds(time, node.mapped().second, half))
      return fmt::format("({}, {}) is missing in its half, or has a wrong time", pair.a, pair.b);
  }
  if (in_halves.empty()) return {};
  const auto& pair = in_halves.begin()->first;
  return fmt::format("({}, {}) is in contact in a half, but not in the whole step", pair.a, pair.b);
}

// Compares every committed step of the case in two halves with the whole step, both rounded to a
// grid, so that the middle places of vertices, primitives and apexes are exact. A pair of the whole
// step is also a pair of a half, at twice its time or at twice its time less one; and a pair of a
// half is also a pair of the whole step.
void check_halves(CaseFacts& facts, LawTally& tally) {
  auto run = pinned_run(facts);
  if (!run) return;
  const auto whole = on_a_grid(std::move(*run));
  const auto halved = changes::halves.of(whole);
  if (!halved) return;
  auto options = facts.options();
  // The middle positions may be rounded, so nobody can vouch for a clean start there. The start is
  // verified instead.
  if (options.start == detector::Start::clean) options.start = detector::Start::verified;
  auto player = PinnedPlayer::make(whole, options, facts.stages_of());
  auto half_player = PinnedPlayer::make(halved->c, options, facts.stages_of());
  if (!player || !half_player) return;
  const auto results = player->play(), of_halves = half_player->play();
  auto half = of_halves.begin();
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    const auto& first = *half++;
    if (!whole.script[s].commit) continue;
    const auto& second = *half++;
    std::string wrong = compare_first(results[s], first, second);
    if (wrong.empty() && facts.options().pairs == detector::Pairs::all) {
      wrong = compare_pairs(results[s], first, second);
    }
    note(facts, s, wrong, tally);
  }
}

void check_repeated_call(CaseFacts& facts, LawTally& tally) {
  const auto run = pinned_run(facts);
  auto player = run ? PinnedPlayer::make(*run, facts.options(), facts.stages_of()) : std::nullopt;
  if (!player) return;
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    const StepResult once = player->evaluate(s), again = player->evaluate(s);
    player->commit(s, again);
    std::string differing = difference(once, again);
    if (differing.empty()) differing = difference(facts.result(s), once);
    note(facts, s, differing.empty() ? holds() : differing + " differs", tally);
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
    const std::string differing = difference(facts.result(s), result);
    note(facts, s, differing.empty() ? holds() : differing + " differs", tally);
  }
}

// Makes another detector from the positions with which the case ends, so that it has chosen other
// apexes and primitives. It has a state of its own, and is in the middle of something else: one
// step is committed, and another one is evaluated and not committed.
std::optional<detector::Detector> busy_detector(const CaseFacts& facts) {
  const auto& frames = facts.source().frames;
  auto creation = detector::assemble(facts.source().triangles, frames.back(), facts.options(),
                                     facts.stages_of()(facts.options()));
  if (!creation) return std::nullopt;
  creation.value().step(frames.back(), frames.back());
  creation.value().evaluate(frames.back(), frames.front());
  return std::move(creation.value());
}

// Restores the same state with one primitive too few among those that Culling::view_auto has chosen
// since. The detector has to refuse this state.
bool is_taken_with_one_too_few(const detector::SavedState& state, detector::Detector& detector) {
  detector::StateFields fields = state.fields();
  if (!fields.committed || fields.anchors.empty()) return false;
  auto anchors = fields.anchors;
  anchors.pop_back();
  fields.committed->policy.anchors = {
      std::make_shared<const std::vector<detector::ViewAnchor>>(std::move(anchors))};
  return !detector.restore(detector::SavedState(std::move(fields)));
}

std::string goes_on(const CaseFacts& facts, std::size_t s, const detector::SavedState& state,
                    CasePlayer& other) {
  auto busy = busy_detector(facts);
  if (!busy) return "whether a second detector can be made";
  if (is_taken_with_one_too_few(state, *busy)) return "whether a wrong state is refused";
  if (busy->restore(state)) return "whether the state can be restored";
  if (!busy->commit()) return "whether commit is refused right after a restore";
  if (busy->state() != state) return "the restored state";
  other.detector() = std::move(*busy);
  StepResult result = other.play(s);
  // The counts may differ, because the trees are shaped by other positions.
  result.counts = facts.result(s).counts;
  return difference(facts.result(s), result);
}

// Compares the two detectors by a next step at rest, which settles the triangles that the last
// committed step left in contact.
std::string rests_alike(const CaseFacts& facts, detector::Detector& detector, const Positions& x) {
  auto restored = busy_detector(facts);
  if (!restored || restored->restore(detector.state())) return "the state";
  const StepResult expectation = detector.evaluate(x, x);
  StepResult result = restored->evaluate(x, x);
  result.counts = expectation.counts;  // as in goes_on
  const auto differing = difference(expectation, result);
  return differing.empty() ? "" : differing + " of a step at rest";
}

void check_restored_state(CaseFacts& facts, LawTally& tally) {
  const auto make = [&] {
    return CasePlayer::make(facts.source(), facts.options(), facts.stages_of()(facts.options()));
  };
  auto player = make(), other = make();
  if (!player || !other) return;
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    std::string differing = goes_on(facts, s, player.value().detector().state(), other.value());
    player.value().play(s);
    const auto expectation = player.value().detector().state();
    if (differing.empty() && other.value().detector().state() != expectation)
      differing = "the state after the step";
    if (differing.empty()) differing = rests_alike(facts, player.value().detector(), facts.x_t1(s));
    note(facts, s, differing.empty() ? holds() : differing + " differs", tally);
  }
}

// Runs the pieces of a loop one after the other, in an order and in lanes that are drawn. If a
// result depends on order or lanes, the run can so be repeated, and its case can be shrunk.
class DrawnOrder : public detector::ThreadArena {
 public:
  DrawnOrder(Random random, std::size_t lanes) : random_(random), lanes_(lanes) {}
  void run(std::size_t count, const Work& work) override {
    for (const auto i : shuffled(random_, in_order(count)))
      work.run(at(i), at(random_.below(static_cast<int>(lanes_))));
  }

 private:
  Random random_;
  const std::size_t lanes_;
};

void check_threads(CaseFacts& facts, LawTally& tally) {
  constexpr std::uint32_t threads = 3;
  auto options = facts.options();
  const auto make = [&](std::uint32_t count) {
    options.threads = count;
    return CasePlayer::make(facts.source(), options, facts.stages_of()(options));
  };
  auto alone = make(1), shared = make(threads), in_order = make(1);
  const Random random(Random::hash(facts.source().id), Random::hash("order of pieces"));
  const auto& c = facts.source();
  auto in_drawn_order = detector::assemble(
      c.triangles, c.frames.front(), facts.options(), facts.stages_of()(facts.options()), {},
      detector::Workers(std::make_unique<DrawnOrder>(random, threads), threads));
  if (!alone || !shared || !in_order || !in_drawn_order) return;
  in_order.value().detector() = std::move(in_drawn_order.value());
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    alone.value().play(s);
    const auto state = alone.value().detector().state();
    std::string differing;
    for (auto* other : {&in_order, &shared}) {
      if (!differing.empty()) break;
      differing = difference(facts.result(s), other->value().play(s));
      if (differing.empty() && other->value().detector().state() != state)
        differing = "the state after the step";
    }
    note(facts, s, differing.empty() ? holds() : differing + " differs", tally);
  }
}

void check_equal_ends(CaseFacts& facts, LawTally& tally) {
  const auto run = pinned_run(facts);
  if (!run || facts.options().culling != Culling::view_point) return;
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    const auto& primitives = facts.result(s).primitives;
    const bool points =
        std::ranges::all_of(primitives, [](const auto& primitive) { return primitive.is_point(); });
    if (!points) return;
  }
  auto options = facts.options();
  options.culling = Culling::view_line;
  auto player = PinnedPlayer::make(*run, options, facts.stages_of());
  if (!player) return;
  const auto results = player->play();
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    const std::string differing = difference(facts.result(s), results[s]);
    note(facts, s, differing.empty() ? holds() : differing + " differs", tally);
  }
}

constexpr Law repetition_law_table[] = {
    {"Change_StepHalved", "change",
     "If a step is taken in two halves, with the state carried over, it has the same pairs at the "
     "same times; if only first contacts are asked for, it has the same first time. (Its "
     "coordinates are rounded to a grid before, so that the middle is exact.)",
     "nothing", check_halves, one_case_in_16, PremiseScope::any_culling, &changes::halves},
    {"Change_EqualEndsAreAPoint", "change",
     "A segment whose ends coincide gives the result of the point, to the last bit.", "nothing",
     check_equal_ends, one_case_in_16},
    {"Change_RepeatedCall", "change",
     "The same step evaluated again, by this detector or another one, gives the same bytes.",
     "nothing", check_repeated_call, one_case_in_16},
    {"Change_EvaluateChangesNothing", "change",
     "Steps that are evaluated and not committed leave no trace in the results that follow.",
     "nothing", check_evaluate_changes_nothing, one_case_in_16, PremiseScope::any_culling,
     &changes::other_evaluations},
    {"Change_ThreadsDoNotShow", "change",
     "Three threads give the same bytes as one, counts and state included; so does a detector that "
     "runs the pieces of its loops one by one, in a drawn order and in drawn lanes.",
     "nothing", check_threads, one_case_in_16},
    {"Change_RestoredStateGoesOn", "change",
     "A state gives the same later results and states after it is restored in a second detector of "
     "the same mesh, which was made from other positions and has evaluated a step. The second "
     "detector can then no longer commit that evaluation.",
     "nothing", check_restored_state, one_case_in_16},
    {"Change_StepReversed", "change",
     "If a sequence is played back, each step from its end to its start, each step has the same "
     "pairs, and is free if it was free.",
     "nothing", check_form<changes::played_back>, one_case_in_16, PremiseScope::any_culling,
     &changes::played_back},
    {"Change_StepsBeforeDoNotShow", "change",
     "If a detector first plays the steps of a sequence in another order, and then the sequence, "
     "the sequence has the same answers, pairs and times as in a new detector.",
     "nothing", check_form<changes::other_steps_first>, one_case_in_16, PremiseScope::any_culling,
     &changes::other_steps_first},
};

}  // namespace

std::span<const Law> repetition_laws() { return repetition_law_table; }

}  // namespace assay::properties
