// The claims of the detector, in configurations drawn so that all pairs of values of options,
// question, state, mesh and size occur.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "detector/assembly.h"
#include "oracle/mesh/pair_relation.h"
#include "properties/changes/changes.h"
#include "properties/generators/parts.h"
#include "properties/judging/agreement.h"
#include "properties/judging/contracted_case.h"
#include "properties/judging/verdict.h"
#include "properties/laws/options/drawn_options.h"
#include "properties/laws/step_law.h"
#include "properties/random.h"
#include "properties/worker/case_run.h"

namespace assay::properties {
namespace {

using detector::StepLimit;

// The case that the oracle is asked about, and the case that the detector is given: with the step
// that the state asks for in front, and with its far body.
struct PosedCase {
  Case judged_case, played_case;
  DrawnOptions draw;
};

// Returns the case with the step that the state asks for in front.
Case with_step_before(Case c, StateBefore state) {
  const auto last = static_cast<std::int32_t>(c.frames.size()) - 1;
  auto script = steps_of(c);
  if (state == StateBefore::elsewhere) script.insert(script.begin(), {last, last, true});
  if (state == StateBefore::carried) script.insert(script.begin(), {last, script[0].from, true});
  c.script = std::move(script);
  return c;
}

// Leaves something out. Some cases have no such form; then the draw is taken back.
void leave_out(DrawnOptions& d, Random& random, const CaseFacts& facts, Case& c) {
  if (d.left_out == LeftOut::nothing) return;
  std::vector<PairContact> in_contact;
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    const auto& pairs = facts.judgement(s).pairs;
    in_contact.insert(in_contact.end(), pairs.begin(), pairs.end());
  }
  auto relation = relation_without(d.left_out, random, c, in_contact);
  if (relation.count_all() || c.counted) {
    d.left_out = LeftOut::nothing;
  } else {
    c.counted = corpus::CaseRelation{std::move(relation), {}};
  }
}

// Returns a power of two, from a quarter of the mesh down to its 2^-12.
double separation_of(const DrawnOptions& d, Random& random, const Case& c) {
  const double extent = extent_of(c);
  if (d.apart == Apart::none || !(extent > 0x1p-400 && extent < 0x1p400)) return 0;
  const int halvings = d.apart == Apart::much ? random.between(2, 4) : random.between(5, 12);
  return std::ldexp(1, std::ilogb(extent) - halvings);
}

PosedCase posed(const CaseFacts& facts) {
  PosedCase p{facts.source(), {}, drawn_options(facts)};
  auto& d = p.draw;
  Random random(Random::hash(p.judged_case.id), Random::hash("what is asked"));
  auto scaled = d.is_scaled ? form_of(changes::power_of_two, p.judged_case) : std::nullopt;
  d.is_scaled = scaled.has_value();
  if (scaled) p.judged_case = std::move(scaled->c);
  leave_out(d, random, facts, p.judged_case);
  d.options.separation = separation_of(d, random, p.judged_case);
  if (d.options.separation == 0) d.apart = Apart::none;
  // Adds two features that only just come within the separation, or only just do not.
  if (d.apart != Apart::none && d.options.start != detector::Start::clean && random.one_in(2))
    p.judged_case = with_approach(std::move(p.judged_case), d.options.separation, random);
  auto large =
      d.has_far_body ? with_far_body(p.judged_case, d.options.separation) : std::optional<Case>();
  d.has_far_body = large.has_value();
  p.played_case = with_step_before(large ? std::move(*large) : p.judged_case, d.state);
  return p;
}

// Returns the oracle's judgement of each step of the posed case. The oracle is asked anew only if
// its judgement of the case itself does not tell.
std::vector<StepJudgement> truth_of(const PosedCase& p, const CaseFacts& facts) {
  const auto* counted_pairs = counted_of(p.judged_case);
  const auto features = oracle::mesh_features(p.judged_case.triangles);
  const auto relation =
      counted_pairs ? std::optional<oracle::PairRelation>(std::in_place, *counted_pairs, features)
                    : std::nullopt;
  JudgeOptions options;
  options.counted = counted_pairs;
  std::vector<StepJudgement> truth;
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    if (p.draw.options.separation > 0 || (relation && relation->is_of_features())) {
      const auto& step = facts.script(s);
      truth.push_back(judge_under(contract_of(p.draw.options),
                                  {start_of(p.judged_case, step), end_of(p.judged_case, step)},
                                  p.judged_case.triangles, options));
      continue;
    }
    truth.push_back(facts.judgement(s));
    auto& of_step = truth.back();
    if (!relation) continue;
    keep_counted(relation, of_step.pairs);
    const auto first = std::ranges::min_element(
        of_step.pairs, [](const auto& a, const auto& b) { return a.time < b.time; });
    const bool meets = first != of_step.pairs.end();
    of_step.first = meets ? first->time : TimeEnclosure{};
    if (of_step.complete) of_step.answer = meets ? Answer::collision : Answer::free;
  }
  return truth;
}

// Goes on in a detector that was made elsewhere, and has committed something else.
bool go_on_elsewhere(CasePlayer& player, const Case& c, Options options,
                     const StagesOf& stages_of) {
  options.counted = counted_of(c);
  const auto state = player.detector().state();
  const auto& elsewhere = c.frames.back();
  auto creation = detector::assemble(c.triangles, elsewhere, options, stages_of(options));
  if (!creation) return false;
  creation.value().step(elsewhere, elsewhere);
  if (creation.value().restore(state)) return false;
  player.detector() = std::move(creation.value());
  return true;
}

// The reply to a question before a step.
struct Reply {
  std::string wrong;
  std::optional<StepLimit> limit;  // to be judged
};

bool is_the_same(const StepLimit& a, const StepLimit& b) {
  return a.answer == b.answer && a.share == b.share && a.positions == b.positions &&
         a.first == b.first;
}

// Asks once to the end, to count the calls of the stop function; then asks again, and stops at one
// of these calls. `ask` returns what is wrong with an answer that should have been stopped.
template <class Ask>
std::string ask_and_stop(Random& random, detector::Detector& detector, const Ask& ask) {
  const auto state = detector.state();
  int times = 0, questions = 0;
  ask([&] { return ++times, false; }, false);
  if (times == 0) return "";
  const int last = random.between(1, times);
  // With several threads the stop function may be called less often than before.
  std::string wrong = ask([&] { return ++questions == last; }, true);
  if (questions < last) return "";
  if (wrong.empty() && !detector.commit()) wrong = "a stopped call can be committed";
  if (wrong.empty() && detector.state() != state) wrong = "a stopped call leaves a trace";
  return wrong;
}

Reply ask_before(Question question, Random& random, CasePlayer& player, std::size_t s) {
  auto& detector = player.detector();
  const auto &x_t0 = player.x_t0(s), &x_t1 = player.x_t1(s);
  const auto stopped_step = [&](const StopFunction& stop, bool is_stopped) -> std::string {
    const auto answer = player.look(s, stop).answer;
    return is_stopped && answer != Answer::undecided
               ? fmt::format("a stopped step is {}", name_of(answer))
               : "";
  };
  StepLimit whole;
  const auto stopped_limit = [&](const StopFunction& stop, bool is_stopped) -> std::string {
    auto limit = detector.limit(x_t0, x_t1, stop);
    if (!is_stopped) {
      whole = std::move(limit);
    } else if (limit.answer != Answer::undecided || limit.share != 0 || limit.positions != x_t0) {
      return fmt::format("a stopped limit is {}, share {}", name_of(limit.answer), limit.share);
    }
    return "";
  };
  switch (question) {
    case Question::none:
      return {};
    case Question::limit:
      return {"", detector.limit(x_t0, x_t1)};
    case Question::stopped_step:
      return {ask_and_stop(random, detector, stopped_step), {}};
    case Question::stopped_limit: {
      auto wrong = ask_and_stop(random, detector, stopped_limit);
      if (wrong.empty() && !is_the_same(whole, detector.limit(x_t0, x_t1)))
        wrong = "a limit differs after a call of limit that was stopped";
      return {wrong, {}};
    }
  }
  return {};
}

struct PlayedStep {
  StepResult result;
  Reply reply;
};

// Returns one result for each step of the case; fewer if a state was not taken, or the mesh is
// refused.
std::vector<PlayedStep> play(const PosedCase& p, const StagesOf& stages_of) {
  const auto& [options, state] = std::tie(p.draw.options, p.draw.state);
  auto player = CasePlayer::make(p.played_case, options, stages_of(options));
  if (!player) return {};
  const auto steps = player.value().steps();
  if (state == StateBefore::reset) {
    for (std::size_t s = 0; s < steps; ++s) player.value().play(s);
    player.value().detector().reset();
  }
  Random random(Random::hash(p.played_case.id), Random::hash("where it is stopped"));
  std::vector<PlayedStep> list;
  for (std::size_t s = 0; s < steps; ++s) {
    if (state == StateBefore::restored &&
        !go_on_elsewhere(player.value(), p.played_case, options, stages_of))
      break;
    Reply reply = ask_before(p.draw.question, random, player.value(), s);
    list.push_back({player.value().play(s), std::move(reply)});
  }
  return list;
}

// Returns what is wrong with a limit, or empty.
std::string fault_of(const StepLimit& limit, const PosedCase& p, const CaseStep& step,
                     const StepJudgement& truth) {
  if (limit.problem) return "a limit is refused";
  Contract contract = contract_of(p.draw.options);
  contract.progress = built_in_progress;
  // Bounded arithmetic may see a contact too early, or where there is none.
  const Claims claims = p.draw.options.arithmetic == Arithmetic::exact
                            ? claims_on_limits
                            : Claims{Claim::commit_free, Claim::path_free};
  JudgeOptions options;
  options.counted = counted_of(p.judged_case);
  const auto& x_t0 = start_of(p.judged_case, step);
  StepDiff diff;
  judge_limit(LimitAnswer{limit.share, limit.positions.topRows(x_t0.rows())},
              {{x_t0, end_of(p.judged_case, step)},
               p.judged_case.triangles,
               options,
               truth,
               claims,
               contract},
              diff);
  return diff.breaches.empty() ? "" : fmt::format("limit: {}", name_of(diff.breaches.front()));
}

// Returns whether the caller vouches rightly (CaseFacts::is_trusted). A step without views does not
// tell its apexes. It takes from a clean start only that nothing pierces its own component there,
// and leaves components with ghosts dirty (L15). So it suffices if all is clean with the apexes of
// `facts`.
bool is_vouched_rightly(CaseFacts& tail, CaseFacts& facts, std::size_t s, std::size_t before) {
  if (tail.is_trusted(s)) return true;
  if (const auto& known_step = tail.known_from(s))
    return is_vouched_rightly(tail, facts, *known_step, before);
  if (s < before || tail.has_views(s) || !facts.has_views(s - before)) return false;
  const auto& clean = facts.layers_at_start(s - before).clean;
  return std::ranges::all_of(clean, [](std::uint8_t c) { return c != 0; });
}

void check_options(CaseFacts& facts, LawTally& tally) {
  if (!facts.stages_of()) return;
  const PosedCase p = posed(facts);
  const auto& options = p.draw.options;
  const auto played_steps = play(p, facts.stages_of());
  const std::size_t steps = steps_of(p.played_case).size(), before = steps - facts.steps();
  if (played_steps.size() < steps) {
    note(facts, 0, p.draw.text() + ": refused", tally);
    return;
  }
  const auto truth = truth_of(p, facts);
  std::vector<StepResult> results;
  for (const auto& step : played_steps) results.push_back(step.result);
  std::vector<StepJudgement> judgements(before);
  judgements.insert(judgements.end(), truth.begin(), truth.end());
  CaseFacts tail(p.played_case, options, results, judgements, facts.surface(), facts.stages_of());
  const Claims claims = claims_of(options);
  const Contract contract = contract_of(options);
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    if (!truth[s].complete || !is_vouched_rightly(tail, facts, s + before, before)) continue;
    const auto& [result, reply] = played_steps[s + before];
    const auto diff = compare(result, truth[s], claims, contract, p.played_case.triangles);
    std::string wrong = diff.outcome == Outcome::defect
                            ? failure_of(diff, result, contract).explanation
                            : reply.wrong;
    if (wrong.empty() && reply.limit) wrong = fault_of(*reply.limit, p, facts.script(s), truth[s]);
    note(facts, s, wrong.empty() ? holds() : fmt::format("{}: {}", p.draw.text(), wrong), tally);
  }
}

constexpr Law option_law_table[] = {
    {"Claim_InEveryPairOfOptions", "claim",
     "The claims hold in drawn configurations with pairwise coverage of culling, arithmetic, "
     "start, pairs, threads, separation, relation, question, state before the case, mesh and size. "
     "Some configurations ask for limits, and some stop steps or limits. `--start clean` is drawn "
     "only for a clean start.",
     "contacts, pairs within a distance, and layers of a clean start", check_options, 4},
};

}  // namespace

std::span<const Law> option_laws() { return option_law_table; }

}  // namespace assay::properties
