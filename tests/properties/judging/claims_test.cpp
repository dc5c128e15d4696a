// A detector is judged by its claims: each claim is broken once, without any other, and a claim
// that is not made is never broken.
#include "properties/claims/claims.h"

#include <nlohmann/json.hpp>

#include "detector/step_result.h"
#include "properties/judging/agreement.h"
#include "properties/judging/step_measures.h"
#include "tests/meshes.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using detector::Answer, detector::PairContact, detector::TimeEnclosure;

// Triangles 0-1 share an edge, 0-2 and 1-2 a vertex; 3 and 4 are apart.
detector::Triangles mesh() { return tests::triangles_of("0 1 2, 1 0 3, 0 4 5, 6 7 8, 9 10 11"); }

PairContact pair_at(std::int32_t a, std::int32_t b, double lo, double hi) {
  return {{a, b}, {lo, hi}, {}};
}
PairContact pair_at(std::int32_t a, std::int32_t b, double t) { return pair_at(a, b, t, t); }

detector::StepResult collision(TimeEnclosure first, std::vector<PairContact> pairs) {
  detector::StepResult result;
  result.answer = Answer::collision;
  result.first = first;
  result.pairs = std::move(pairs);
  return result;
}

detector::StepResult answer(Answer value) {
  detector::StepResult result;
  result.answer = value;
  return result;
}

oracle::StepJudgement truth(std::vector<PairContact> pairs) {
  oracle::StepJudgement judgement;
  judgement.complete = true;
  judgement.answer = pairs.empty() ? Answer::free : Answer::collision;
  judgement.first = {1, 1};
  for (const auto& p : pairs) judgement.first = std::min(judgement.first, p.time);
  judgement.pairs = std::move(pairs);
  return judgement;
}

// Of an oracle that was stopped when it had found these.
oracle::StepJudgement stopped(std::vector<PairContact> pairs) {
  auto judgement = truth(std::move(pairs));
  judgement.complete = false;
  judgement.answer = Answer::undecided;
  return judgement;
}

using List = std::vector<Claim>;

// What a plug-in may claim at most of its steps.
const Claims claimable = claims_of({}).only(claims_from_outside);

StepDiff judged(const detector::StepResult& result, const oracle::StepJudgement& judgement,
                Claims claims = claimable, Contract contract = {}) {
  return compare(result, judgement, claims, contract, mesh());
}

TEST(Claims, TheBuiltInClaimsAllButAllPairsWhenItIsAskedForTheFirst) {
  auto all = list_of(claims_from_outside);
  // Those of a broad phase and of a limiter are theirs alone.
  std::erase_if(
      all, [](Claim claim) { return claim == Claim::candidates || claims_on_limits.has(claim); });
  EXPECT_EQ(list_of(claims_of({})), all);
  const auto first = claims_of({.pairs = detector::Pairs::first});
  for (const auto claim : all) EXPECT_EQ(first.has(claim), claim != Claim::all_pairs);
}

TEST(Claims, AreTheBitsOfThePluginInterface) {
  const Claim last = list_of(claims_from_outside).back();
  EXPECT_EQ(claims_from_outside.bits(), (row_of(last).bit << 1) - 1u);
}

TEST(Claims, FollowTheArithmetic) {
  using detector::Arithmetic;
  auto bounded = claims_of({.arithmetic = Arithmetic::bounded});
  EXPECT_FALSE(bounded.has(Claim::no_spurious) || bounded.has(Claim::times_unique));
  EXPECT_EQ(bounded.set(Claim::no_spurious).set(Claim::times_unique), claims_of({}));
  for (const auto plain : {Arithmetic::double_precision, Arithmetic::single_precision}) {
    const std::vector<Claim> few = {Claim::deterministic, Claim::total};
    EXPECT_EQ(list_of(claims_of({.arithmetic = plain})), few);
  }
}

TEST(Claims, FreeAgainstAContactIsUnsoundAndLosesItsPairs) {
  const auto diff = judged(answer(Answer::free), truth({pair_at(3, 4, .5)}));
  EXPECT_EQ(diff.outcome, Outcome::defect);
  EXPECT_EQ(diff.breaches, (List{Claim::free_sound, Claim::first_pairs, Claim::all_pairs}));
  // A detector that promises nothing about `free` has broken nothing.
  EXPECT_EQ(judged(answer(Answer::free), truth({pair_at(3, 4, .5)}), {Claim::first_time}).outcome,
            Outcome::holds);
}

// A refusal counts as one beyond each number of the capacity, never at it, and as any other below.
TEST(Claims, ARefusalBeyondTheCapacityBreaksNothing) {
  auto judgement = truth({pair_at(3, 4, .5), pair_at(0, 3, .5)});
  judgement.feature_candidates = 7;
  struct Row {
    Contract contract;
    bool is_beyond;
  };
  const Row rows[] = {{{}, false},
                      {{.capacity_triangles = 5}, false},
                      {{.capacity_triangles = 4}, true},
                      {{.capacity_contacts = 2}, false},
                      {{.capacity_contacts = 1}, true},
                      {{.capacity_candidates = 7}, false},
                      {{.capacity_candidates = 6}, true},
                      {{.capacity_triangles = 9, .capacity_candidates = 6}, true}};
  const auto diff_of = [](const oracle::StepJudgement& truth, const Claims& claims,
                          const Contract& contract) {
    CaseRun refusal;
    note_capacity(refusal, 0);
    const detector::Positions x(6, 3);
    return judge_step(refusal, 0, {{x, x}, mesh(), {}, truth, claims, contract});
  };
  for (const auto& [contract, is_beyond] : rows) {
    const auto diff = diff_of(judgement, claimable, contract);
    EXPECT_EQ(diff.outcome, is_beyond ? Outcome::refused : Outcome::defect);
    EXPECT_EQ(diff.breaches, is_beyond ? List{} : List{Claim::total});
    // Without the claim total a refusal breaks nothing, and answers nothing.
    EXPECT_EQ(diff_of(judgement, {Claim::free_sound}, contract).outcome,
              is_beyond ? Outcome::refused : Outcome::error);
    // An answer is judged, whatever the capacity: silence is no refusal.
    EXPECT_EQ(judged(answer(Answer::free), judgement, claimable, contract).breaches.front(),
              Claim::free_sound);
  }
  // Pairs that the contract leaves out fill no buffer.
  auto neighbours = truth({pair_at(0, 1, .5), pair_at(3, 4, .5)});
  const Contract strangers = {.adjacency = Adjacency::no_shared_vertex, .capacity_contacts = 1};
  EXPECT_EQ(diff_of(neighbours, claimable, strangers).outcome, Outcome::defect);
  // An oracle that was stopped has counted too little to refuse the refusal.
  neighbours.complete = false;
  EXPECT_EQ(diff_of(neighbours, claimable, strangers).outcome, Outcome::undecided);
}

TEST(Claims, CollisionAgainstNoneIsSpurious) {
  EXPECT_EQ(judged(answer(Answer::free), truth({})).outcome, Outcome::holds);
  const auto alarm = collision({0, 0}, {pair_at(3, 4, 0)});
  EXPECT_EQ(judged(alarm, truth({})).breaches, List{Claim::no_spurious});
  const Claims others = {Claim::free_sound, Claim::not_late, Claim::first_time};
  EXPECT_EQ(judged(alarm, truth({})).outcome, Outcome::defect);
  EXPECT_EQ(judged(alarm, truth({}), others).outcome, Outcome::holds);
  const auto with_margin = judged(alarm, truth({}), claimable, {.margin = .1});
  EXPECT_EQ(with_margin.outcome, Outcome::holds);
}

// The features of a query share no vertex, so that its alarms are judged under every margin.
TEST(Claims, AMarginVoidsAlarmsOfStepsThatTestNeighbours) {
  const Contract margin = {.margin = .1};
  EXPECT_FALSE(judged_claims(claimable, margin).has(Claim::no_spurious));
  EXPECT_TRUE(judged_claims(claimable, margin, true).has(Claim::no_spurious));
  EXPECT_FALSE(judged_claims(claimable, margin, true).has(Claim::first_time));
}

// Triangles 3 and 4 come within the slack at .25, and within the separation at .5 or not at all.
TEST(Claims, ASlackExcusesWhatComesWithinIt) {
  const Contract slack = {.adjacency = Adjacency::no_shared_vertex, .margin = .1, .separation = .1};
  const auto within = [](std::vector<PairContact> pairs) {
    auto step = truth(std::move(pairs));
    step.within_slack = {pair_at(3, 4, .25)};
    return step;
  };
  const auto near_miss = within({}), near = within({pair_at(3, 4, .5)});
  const auto broken_by = [&](const oracle::StepJudgement& step, double t) {
    return judged(collision({t, t}, {pair_at(3, 4, t)}), step, claimable, slack).breaches;
  };
  EXPECT_EQ(broken_by(near_miss, .25), List{});
  EXPECT_EQ(broken_by(near_miss, .75), List{});
  EXPECT_EQ(broken_by(near_miss, .125), List{Claim::no_spurious});  // before it is within the slack
  EXPECT_EQ(broken_by(near, .25), List{});
  EXPECT_EQ(broken_by(near, .75), (List{Claim::not_late, Claim::all_pairs}));
  EXPECT_EQ(judged(answer(Answer::free), near_miss, claimable, slack).breaches, List{});
  // Pairs have their right times here, and the first time is before them all.
  EXPECT_EQ(judged(collision({.125, .125}, {pair_at(3, 4, .25)}), near, claimable, slack).breaches,
            List{Claim::no_spurious});
  auto nowhere = near_miss;
  nowhere.within_slack.emplace();
  EXPECT_EQ(broken_by(nowhere, .25), List{Claim::no_spurious});
}

TEST(Claims, ATimeIsAnIntervalThatMustHoldTheOracles) {
  const double half_up = std::nextafter(.5, 1);
  const auto step = truth({pair_at(3, 4, .5, half_up)});  // strictly between the two
  const auto broken_by = [&](double lo, double hi) {
    return judged(collision({lo, hi}, {pair_at(3, 4, 0, 1)}), step).breaches;
  };
  EXPECT_EQ(broken_by(.5, half_up), List{});
  EXPECT_EQ(broken_by(.25, .75), List{});
  EXPECT_EQ(broken_by(0, 1), List{});
  EXPECT_EQ(broken_by(.5, .5), List{Claim::first_time});
  EXPECT_EQ(broken_by(0, .25), List{Claim::first_time});
  EXPECT_EQ(broken_by(half_up, 1), (List{Claim::not_late, Claim::first_time}));
  // Early is not late.
  const auto early = collision({.25, .25}, {});
  EXPECT_EQ(judged(early, step, {Claim::not_late}).outcome, Outcome::holds);
  const auto late = collision({.75, .75}, {});
  EXPECT_EQ(judged(late, step, {Claim::not_late}).breaches, List{Claim::not_late});
  EXPECT_TRUE(judged(early, step).wrong_first_time() && judged(late, step).wrong_first_time());
}

// One meaning for all counts: by the lower end, by more than the tolerance.
TEST(Claims, ATimeIsLateOrEarlyByItsLowerEnd) {
  const auto off_by = [](double lo, double hi, double tolerance) {
    const auto off = judged(collision({lo, hi}, {pair_at(3, 4, 0, 1)}), truth({pair_at(3, 4, .5)}),
                            {Claim::first_time}, {.time_tolerance = tolerance})
                         .first->off;
    return std::pair(off.late, off.early);
  };
  using Off = std::pair<double, double>;
  EXPECT_EQ(off_by(.5, .5, 0), (Off{0, 0}));
  EXPECT_EQ(off_by(.5, 1, 0), (Off{0, 0}));
  EXPECT_EQ(off_by(.25, 1, 0), (Off{0, .25})) << "a step size states a time";
  EXPECT_EQ(off_by(.25, .375, 0), (Off{0, .25}));
  EXPECT_EQ(off_by(.75, 1, 0), (Off{.25, 0}));
  EXPECT_EQ(off_by(.5 + 1e-4, .75, 1e-3), (Off{0, 0})) << "tolerated";
  EXPECT_EQ(off_by(.5 - 1e-4, .75, 1e-3), (Off{0, 0}));
}

TEST(Claims, APairWithoutATimeIsJudgedByTheFirstTimeOnly) {
  const auto step = truth({pair_at(0, 3, .75), pair_at(3, 4, .5)});
  const auto without =
      judged(collision({.5, .5}, {pair_at(0, 3, 0, 1), pair_at(3, 4, 0, 1)}), step);
  EXPECT_EQ(without.outcome, Outcome::holds);
  const auto late = judged(collision({.5, .5}, {pair_at(0, 3, .8), pair_at(3, 4, .5)}), step);
  EXPECT_EQ(late.breaches, List{Claim::all_pairs});
  EXPECT_EQ(late.late.size(), 1u);
  const auto early = judged(collision({.5, .5}, {pair_at(0, 3, .7), pair_at(3, 4, .5)}), step);
  EXPECT_EQ(early.breaches, List{Claim::no_spurious});
  EXPECT_EQ(early.early.size(), 1u);
}

TEST(Claims, L6_MissingPairsAreExcusedWhereAllPairsIsNotClaimed) {
  // 0-3 and 3-4 are one part of the contact graph at t*, 1-2 another; 2-4 comes later.
  const auto step =
      truth({pair_at(0, 3, .5), pair_at(1, 2, .5), pair_at(2, 4, .75), pair_at(3, 4, .5)});
  const auto both_parts = collision({.5, .5}, {pair_at(1, 2, .5), pair_at(3, 4, .5)});
  const auto first = judged(both_parts, step, claimable.without({Claim::all_pairs}));
  EXPECT_EQ(first.outcome, Outcome::holds);
  EXPECT_EQ(first.excuses.size(), 2u);
  EXPECT_EQ(judged(both_parts, step).breaches, List{Claim::all_pairs});

  const auto one_part = collision({.5, .5}, {pair_at(3, 4, .5)});
  const auto lost = judged(one_part, step, claimable.without({Claim::all_pairs}));
  EXPECT_EQ(lost.breaches, List{Claim::first_pairs});
  ASSERT_EQ(lost.missing.size(), 1u);
  EXPECT_EQ(lost.missing[0].pair, (detector::TrianglePair{1, 2}));
  // Neither claimed: a detector of times alone.
  EXPECT_EQ(judged(collision({.5, .5}, {}), step, {Claim::first_time}).outcome, Outcome::holds);
}

TEST(Claims, TheContractIsTakenFromTheOraclesSide) {
  // Sharing an edge at 0.25, a vertex at 0.5, nothing at 0.75.
  const auto step = truth({pair_at(0, 1, .25), pair_at(0, 2, .5), pair_at(3, 4, .75)});
  const Claims all = claimable;
  const Contract no_edges = {.adjacency = Adjacency::not_edge_sharing};
  const Contract no_neighbours = {.adjacency = Adjacency::no_shared_vertex};

  const auto a = collision({.5, .5}, {pair_at(0, 2, .5), pair_at(3, 4, .75)});
  EXPECT_EQ(judged(a, step, all, no_edges).outcome, Outcome::holds);
  EXPECT_EQ(judged(a, step, all, no_edges).left_out.size(), 1u);
  EXPECT_TRUE(judged(a, step, all, no_edges).left_out_missed);  // 0.25 is before 0.5
  EXPECT_EQ(judged(a, step).outcome, Outcome::defect);
  // The first time of the contract's pairs is 0.75 here: 0.5 is wrong, and 0-2 is no alarm.
  EXPECT_EQ(judged(a, step, all, no_neighbours).breaches, List{Claim::first_time});
  EXPECT_EQ(judged(a, step, all, no_neighbours).left_out.size(), 2u);

  const auto neighbours_only = truth({pair_at(0, 1, .25)});
  const auto free = judged(answer(Answer::free), neighbours_only, all, no_edges);
  EXPECT_EQ(free.outcome, Outcome::holds);
  EXPECT_TRUE(free.left_out_missed);
  const auto reported = collision({.25, .25}, {pair_at(0, 1, .25)});
  EXPECT_EQ(judged(reported, neighbours_only, all, no_edges).outcome, Outcome::holds);
  EXPECT_FALSE(judged(reported, neighbours_only, all, no_edges).left_out_missed);
}

TEST(Claims, AnErrorIsNoAnswer) {
  EXPECT_EQ(judged(answer(Answer::error), truth({})).breaches, List{Claim::total});
  EXPECT_EQ(judged(answer(Answer::error), truth({}), {Claim::free_sound}).outcome, Outcome::error);
}

TEST(Agreement, StoppedDetectorIsUndecidedAndSpuriousPairsCount) {
  auto stopped_early = collision({.5, .5}, {pair_at(3, 4, .5)});
  stopped_early.answer = Answer::undecided;
  EXPECT_EQ(judged(stopped_early, truth({pair_at(3, 4, .5), pair_at(0, 3, .5)})).outcome,
            Outcome::undecided);
  EXPECT_EQ(judged(stopped_early, truth({pair_at(0, 3, .5)})).outcome, Outcome::defect);
}

TEST(Claims, AStoppedOracleRefutesOnlyWithWhatItFound) {
  const auto judgement = stopped({pair_at(3, 4, .5)});
  EXPECT_EQ(judged(answer(Answer::free), judgement).breaches.front(), Claim::free_sound);
  const auto other = collision({.25, .25}, {pair_at(0, 3, .25), pair_at(3, 4, .5)});
  EXPECT_EQ(judged(other, judgement).outcome, Outcome::undecided);
  const auto late = collision({.75, .75}, {pair_at(0, 3, .75)});
  EXPECT_EQ(judged(late, judgement, {Claim::not_late}).breaches, List{Claim::not_late});
  const auto lost = collision({.5, .5}, {pair_at(0, 3, .5)});
  EXPECT_EQ(judged(lost, judgement).breaches, List{Claim::all_pairs});
  const auto first = judged(collision({.5, .5}, {pair_at(3, 4, .5)}),
                            stopped({pair_at(3, 4, .5), pair_at(0, 1, .75)}),
                            claimable.without({Claim::all_pairs}));
  EXPECT_EQ(first.outcome, Outcome::undecided);
  EXPECT_EQ(first.excuses.size(), 1u);
}

TEST(Claims, Float32RoundsToNearest) {
  detector::Positions x(1, 3);
  x << .1, 1e-60, 1e300;
  const auto rounded = round_to(x, Coordinates::float32);
  EXPECT_EQ(rounded(0, 0), static_cast<double>(.1f));
  EXPECT_EQ(rounded(0, 1), 0);
  EXPECT_EQ(rounded(0, 2), std::numeric_limits<double>::infinity());
  EXPECT_EQ(round_to(x, Coordinates::float64), x);
}

StepErrors read_back(const nlohmann::json& json) {
  StepErrors errors;
  read_fields(json, errors);
  return errors;
}

StepErrors errors_of_step(Answer answered, TimeEnclosure first, std::vector<PairContact> reported,
                          std::vector<PairContact> exact, const Claims& claims = {},
                          bool complete = true) {
  auto result = collision(first, std::move(reported));
  result.answer = answered;
  auto judgement = truth(std::move(exact));
  judgement.complete = complete;
  return errors_of(compare(result, judgement, claims));
}

const std::vector<PairContact> at_half = {pair_at(0, 1, 0.5)};

TEST(StepErrors, EachWordIsMet) {
  const auto missed = errors_of_step(Answer::free, {}, {}, at_half);
  EXPECT_EQ(missed.contact, 1u);
  EXPECT_EQ(missed.missed, 1u);
  EXPECT_EQ(missed.unsafe, 1u);
  EXPECT_EQ(missed.missing, 0u);  // it claims no pairs and reports none
  const auto alarm = errors_of_step(Answer::collision, {0.5, 0.5}, at_half, {});
  EXPECT_EQ(alarm.free, 1u);
  EXPECT_EQ(alarm.false_alarms, 1u);
  EXPECT_EQ(alarm.spurious, 1u);
  EXPECT_EQ(alarm.alarming, 1u);
  EXPECT_EQ(alarm.unsafe, 0u);
  const auto late = errors_of_step(Answer::collision, {0.625, 0.625}, at_half, at_half);
  EXPECT_EQ(late.late.steps, 1u);
  EXPECT_EQ(late.late.worst_share, 0.125);
  EXPECT_EQ(late.unsafe, 1u);
  // A step size, which claims not-late alone.
  const auto early = errors_of_step(Answer::collision, {0.25, 1}, at_half, at_half);
  EXPECT_EQ(early.early.worst_share, 0.25);
  EXPECT_EQ(early.late.steps, 0u);
  EXPECT_EQ(early.unsafe, 0u);
  EXPECT_EQ(early.collisions(), 1u);
}

TEST(StepErrors, AMissingPairIsUnsafeIfPairsAreClaimed) {
  const std::vector<PairContact> two = {pair_at(0, 1, 0.5), pair_at(2, 3, 0.5)};
  const auto claimed =
      errors_of_step(Answer::collision, {0.5, 0.5}, at_half, two, {Claim::first_pairs});
  EXPECT_EQ(claimed.missing, 1u);
  EXPECT_EQ(claimed.unsafe, 1u);
  const auto not_claimed = errors_of_step(Answer::collision, {0.5, 0.5}, at_half, two);
  EXPECT_EQ(not_claimed.missing, 1u);
  EXPECT_EQ(not_claimed.unsafe, 0u);
}

TEST(StepErrors, WithoutAnAnswerOnlyStepsAndUndecidedCount) {
  for (const auto answer : {Answer::undecided, Answer::error}) {
    const auto errors = errors_of_step(answer, {}, {}, at_half);
    StepErrors expected;
    expected.steps = expected.undecided = 1;
    EXPECT_EQ(errors, expected);
  }
  EXPECT_EQ(errors_of_step(Answer::free, {}, {}, at_half, {}, false), StepErrors{});
}

TEST(StepErrors, TimesAreCountedInDoublesToo) {
  const auto errors =
      errors_of_step(Answer::collision, {std::nextafter(0.5, 1), 1}, at_half, at_half);
  EXPECT_EQ(errors.late.worst_ulps, 1);
  EXPECT_EQ(errors.late.worst_share, 0x1p-53);
  EXPECT_EQ(errors.late.quantile(1), 1.2e-16);  // rounded upward
  // Late by the least double: also that share is a number in every report.
  const std::vector<PairContact> at_start = {pair_at(0, 1, 0)};
  const double least = std::numeric_limits<double>::denorm_min();
  const auto late = errors_of_step(Answer::collision, {least, least}, at_start, at_start);
  EXPECT_EQ(late.late.steps, 1u);
  EXPECT_GE(late.late.quantile(1), least);
  EXPECT_LT(late.late.quantile(1), 1e-299);
  EXPECT_EQ(read_back(json_of_fields<nlohmann::json>(late)), late);
}

TEST(StepErrors, AsJsonAndBack) {
  auto errors = errors_of_step(Answer::collision, {0.625, 0.625}, at_half, at_half);
  errors += errors_of_step(Answer::free, {}, {}, {});
  const auto json = json_of_fields<nlohmann::json>(errors);
  EXPECT_EQ(json.at("late").at("worst_share"), 0.125);
  EXPECT_EQ(read_back(nlohmann::json::parse(json.dump())), errors);
  EXPECT_EQ(nlohmann::ordered_json(errors).begin().key(), "steps");
  EXPECT_FALSE(json.contains("limits")) << "it is no limiter";
  errors.limits.free = 3;
  errors.limits.stalls["t inside"] = 2;
  EXPECT_EQ(read_back(json_of_fields<nlohmann::json>(errors)), errors);
  EXPECT_THROW(read_back(nlohmann::json::object()), nlohmann::json::exception);
}

}  // namespace
}  // namespace assay::properties
