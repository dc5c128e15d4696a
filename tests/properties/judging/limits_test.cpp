// L17: the claims of a limiter. Each claim is broken once, without any other. A shortfall for which
// only rounding is to blame is counted, and breaks no claim.
#include "properties/judging/agreement.h"
#include "properties/judging/exam.h"
#include "properties/judging/step_measures.h"
#include "properties/judging/verdict.h"
#include "tests/close_passes.h"
#include "tests/properties/small_case.h"
#include "tests/sinking_corner.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

// The corner sinks from z = 3 to -1, so it is at the plane at t = 3/4.
constexpr double first_time = 0.75;

CaseRun run_of(const LimitAnswer& answer) {
  CaseRun run;
  run.has_answers = false;
  run.steps.resize(1);
  run.steps[0].answer = detector::Answer::undecided;
  run.limits = {answer};
  return run;
}

Positions at(const corpus::Case& c, double share) {
  return c.frames[0] + share * (c.frames[1] - c.frames[0]);
}
LimitAnswer stop_at(const corpus::Case& c, double share) { return {share, at(c, share)}; }

Contract limiter(double separation = 0) {
  Contract contract;
  contract.progress = 0.5;
  contract.separation = separation;
  if (separation > 0) contract.adjacency = Adjacency::no_shared_vertex;
  return contract;
}

Verdict judged(const corpus::Case& c, const LimitAnswer& answer,
               const Contract& contract = limiter(), const Claims& claims = claims_on_limits) {
  return judge_run(c, run_of(answer), judge_case(c, contract), claims, contract);
}
using List = std::vector<Claim>;
List broken_by(const corpus::Case& c, const LimitAnswer& answer,
               const Contract& contract = limiter(), const Claims& claims = claims_on_limits) {
  return judged(c, answer, contract, claims).breaches;
}

TEST(Limits, L17_EachClaimIsBrokenAlone) {
  const auto c = tests::sinking_corner(-1), free = tests::sinking_corner(1);
  EXPECT_EQ(broken_by(c, stop_at(c, 0.5)), List{});
  EXPECT_EQ(broken_by(free, stop_at(free, 1)), List{});
  // Another place than the share says.
  EXPECT_EQ(broken_by(c, {0.5, at(c, 0.8)}), List{Claim::commit_free});
  EXPECT_EQ(broken_by(c, {0.8, at(c, 0.5)}), List{Claim::path_free});
  EXPECT_EQ(broken_by(c, stop_at(c, 0.25)), List{Claim::progress});
  EXPECT_EQ(broken_by(free, stop_at(free, 0.75)), List{Claim::whole});
  EXPECT_EQ(broken_by(free, stop_at(free, 0.25)), (List{Claim::progress, Claim::whole}));
  for (const Claim claim : list_of(claims_on_limits))
    for (const auto& broken :
         broken_by(c, stop_at(c, 0.8), limiter(), claims_on_limits.without({claim})))
      EXPECT_NE(broken, claim);
}

TEST(Limits, L17_AShareIsBelowTheTimeToTheLastBit) {
  const auto c = tests::sinking_corner(-1);
  const double before = std::nextafter(first_time, 0);
  EXPECT_EQ(broken_by(c, {before, at(c, 0.5)}), List{});
  EXPECT_EQ(broken_by(c, {first_time, at(c, 0.5)}), List{Claim::path_free});
  // A time that is no double: 3/(3+2), between two of them.
  const auto between = tests::sinking_corner(-2);
  const auto first = judge_case(between, limiter())[0].first;
  ASSERT_LT(first.lo, first.hi);
  EXPECT_EQ(broken_by(between, {first.lo, at(between, 0.5)}), List{});
  EXPECT_EQ(broken_by(between, {first.hi, at(between, 0.5)}), List{Claim::path_free});
}

TEST(Limits, L17_PositionsAloneAreJudgedByTheStepToThem) {
  const auto c = tests::sinking_corner(-1);
  EXPECT_EQ(broken_by(c, {-1, at(c, 0.7)}), List{});
  EXPECT_EQ(broken_by(c, {-1, at(c, 0.75)}), List{Claim::commit_free}) << "touching counts";
  // The straight way to beyond the plane, beside the triangle, is free.
  Positions beside = c.frames[1];
  beside(3, 0) = -9;
  EXPECT_EQ(broken_by(c, {-1, beside}), List{});
  EXPECT_EQ(broken_by(c, {-1, c.frames[1]}), List{Claim::commit_free}) << "the whole step";
}

TEST(Limits, L17_WithASeparationTheContactIsWhatComesWithinIt) {
  const auto c = tests::sinking_corner(0.5);
  // It comes within 1 when it has sunk by 2 of 2.5.
  EXPECT_EQ(broken_by(c, stop_at(c, 0.75), limiter(1)), List{});
  EXPECT_EQ(broken_by(c, stop_at(c, 0.9), limiter(1)),
            (List{Claim::commit_free, Claim::path_free}));
  EXPECT_EQ(broken_by(c, stop_at(c, 1), limiter()), List{});
  // A slack is for answers alone.
  const auto down = tests::sinking_corner(-1);
  auto slack = limiter(0.25);
  slack.margin = 0.25;
  EXPECT_EQ(broken_by(down, stop_at(down, 0.65), slack), List{}) << "0.4 apart";
  EXPECT_EQ(broken_by(down, stop_at(down, 0.7), slack),
            (List{Claim::commit_free, Claim::path_free}));
}

TEST(Limits, L17_NothingIsJudgedWithoutALimitOrOfAStepThatStartsInContact) {
  auto c = tests::sinking_corner(-1);
  auto run = run_of(stop_at(c, 0.5));
  run.limits[0].reset();
  EXPECT_EQ(judge_run(c, run, judge_case(c, limiter()), claims_on_limits, limiter()).outcome,
            Outcome::undecided);
  c.frames[0](3, 2) = 0;
  const auto verdict = judged(c, stop_at(c, 1));
  EXPECT_EQ(verdict.breaches, List{});
  EXPECT_FALSE(verdict.steps[0].limit);
  EXPECT_TRUE(verdict.steps[0].starts_near) << "it counts for no n";
}

TEST(Limits, L17_WhereNumbersLeaveNoRoomNoProgressIsOwed) {
  // At z = 1 +- a few ulps of 4, the largest coordinate, above the plane z = 1.
  auto c = tests::sinking_corner(-1);
  const double ulp = 0x1p-50;
  for (auto& frame : c.frames) frame.topRows(3).col(2).array() = 1;
  const auto stays_at = [&](double gap) {
    c.frames[0](3, 2) = 1 + gap * ulp;
    return broken_by(c, stop_at(c, 0));
  };
  EXPECT_EQ(stays_at(63), List{});
  EXPECT_EQ(stays_at(65), List{}) << "the way until the contact is as short";
  EXPECT_EQ(stays_at(8192), List{Claim::progress});
}

// A step with its mesh, and how far its contact is.
std::pair<corpus::Case, double> case_of(const tests::ClosePass& pass) {
  corpus::Case c;
  c.triangles = pass.triangles;
  c.frames = {pass.x_t0, pass.x_t1};
  return {c, judge_case(c)[0].first.lo};
}

TEST(Limits, L17_WhereRoundingClosesTheWayNoProgressIsOwed) {
  auto contract = limiter();
  contract.progress = 0.9;
  for (const auto& pass : tests::known_close_passes()) {
    const auto [c, time] = case_of(pass);
    const auto verdict = judged(c, stop_at(c, 0.451 * time), contract);
    EXPECT_EQ(verdict.breaches, List{}) << pass.name;
    EXPECT_EQ(errors_of(verdict.steps[0]).limits.excused, 1u) << pass.name;
    EXPECT_TRUE(verdict.steps[0].limit->stall.empty());
    // Nobody asks who does not claim it.
    const auto others = claims_on_limits.without({Claim::progress});
    EXPECT_FALSE(judged(c, stop_at(c, 0), contract, others).steps[0].limit->is_excused);
  }
}

TEST(Limits, L17_ACloseWayIsNoExcuseWhereItsPlacesAreFree) {
  std::size_t owed = 0, excused = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const auto [c, time] = case_of(tests::drawn_close_pass(seed));
    const auto verdict = judged(c, stop_at(c, 0.25 * time));
    const bool is_owed = verdict.breaches == List{Claim::progress};
    ++(is_owed ? owed : excused);
    EXPECT_NE(is_owed, verdict.steps[0].limit->is_excused) << seed;
  }
  EXPECT_GT(owed, 150u);
  EXPECT_GT(excused, 2u);
}

TEST(Limits, L17_TheRoomIsThatOfPairsThatCount) {
  // Two resting neighbours, far away and nearer to each other than any gap that is wanted.
  auto c = tests::sinking_corner(-1);
  const auto with_needles = [&](double height) {
    auto more = c;
    more.triangles = tests::triangles({{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {7, 6, 9}});
    for (auto& frame : more.frames) {
      frame.conservativeResize(10, 3);
      frame.bottomRows(4) =
          tests::positions({{90, 0, 0}, {91, 0, 0}, {90.5, height, 0}, {90.5, -height, 0}});
    }
    return broken_by(more, stop_at(more, 0), limiter(0.001));
  };
  EXPECT_EQ(with_needles(1), List{Claim::progress});
  EXPECT_EQ(with_needles(0.0005), List{Claim::progress});
  // The greatest double has no unit in its last place that could be multiplied.
  auto greatest = tests::sinking_corner(-1);
  for (auto& frame : greatest.frames) frame(1, 0) = std::numeric_limits<double>::max();
  EXPECT_EQ(broken_by(greatest, stop_at(greatest, 0)), List{});
}

TEST(Limits, L17_AShareBesidePositionsThatStayIsNoProgress) {
  const auto c = tests::sinking_corner(-1);
  EXPECT_EQ(broken_by(c, {0.7, c.frames[0]}), List{Claim::progress});
  EXPECT_EQ(broken_by(c, {0.7, at(c, 0.1)}), List{Claim::progress});
  const auto use = errors_of(judged(c, {0.7, c.frames[0]}).steps[0]).limits;
  EXPECT_EQ(use.share(0), 0);
  EXPECT_EQ(use.stalled(), 1u);
}

// Where one vertex has much larger numbers than the others, its rounding is most of the way.
TEST(Limits, L17_RoundingOfPositionsIsNoLackOfProgress) {
  auto c = tests::sinking_corner(-1);
  for (auto& frame : c.frames) frame(1, 0) = 0x1p60;
  c.frames[1](1, 0) = 0x1p60 + 0x1p8;  // the next double
  LimitAnswer answer = stop_at(c, 0.4);
  ASSERT_EQ(answer.positions(1, 0), 0x1p60) << "0.4 of an ulp is none";
  EXPECT_EQ(broken_by(c, answer), List{});
  const auto used = [&](const LimitAnswer& a) { return errors_of(judged(c, a).steps[0]).limits; };
  EXPECT_NEAR(used(answer).share(0), 0.4 / first_time, 0.01);
  EXPECT_EQ(used({0.4, c.frames[0]}).share(0), 0) << "nothing moved";
}

TEST(Limits, L17_RoomIsMeasuredInTheNumbersOfTheContract) {
  // 2^-18 above the plane at z = 1: 2^34 doubles of 1, 32 float32 numbers.
  auto c = tests::sinking_corner(-1);
  for (auto& frame : c.frames) frame.topRows(3).col(2).array() = 1;
  c.frames[0](3, 2) = 1 + 0x1p-18;
  auto contract = limiter();
  EXPECT_EQ(broken_by(c, stop_at(c, 0)), List{Claim::progress});
  contract.coordinates = Coordinates::float32;
  EXPECT_EQ(broken_by(c, stop_at(c, 0), contract), List{});
  c.frames[0](3, 2) = 1.5;
  EXPECT_EQ(broken_by(c, stop_at(c, 0), contract), List{Claim::progress});
}

// A triangle rests below the plane; the corner sinks from 3 above it.
TEST(Limits, L17_RoomIsLeftByTheGapBeyondTheSeparation) {
  auto c = tests::sinking_corner(-1);
  const auto n = c.frames[0].rows();
  c.triangles.conservativeResize(3, 3);
  c.triangles.row(2) << n, n + 1, n + 2;
  for (const double below : {2 + 0x1p-46, 2.5}) {
    for (auto& frame : c.frames) {
      frame.conservativeResize(n + 3, 3);
      frame.bottomRows(3) = frame.topRows(3);
      frame.bottomRows(3).col(2).array() = -below;
    }
    const auto broken = broken_by(c, stop_at(c, 0), limiter(2));
    EXPECT_EQ(broken, below > 2.25 ? List{Claim::progress} : List{}) << below;
  }
}

TEST(Limits, L17_TheEndOfADisplacementIsTheExactOneOrItsRounding) {
  auto free = tests::sinking_corner(1);
  free.frames[1](3, 0) = 1 + 0x1p-30;  // no float32
  auto contract = limiter();
  contract.coordinates = Coordinates::float32;
  contract.motion = MotionGiven::displacement;
  EXPECT_EQ(broken_by(free, {1, free.frames[1]}, contract), List{});
  EXPECT_EQ(broken_by(free, {1, round_to(free.frames[1], contract.coordinates)}, contract), List{});
  Positions other = free.frames[1];
  other(3, 0) = 1 + 0x1p-20;
  EXPECT_EQ(broken_by(free, {1, other}, contract), List{Claim::whole});
}

TEST(Limits, L17_UseAndStallsAreCountedWhateverIsClaimed) {
  const auto c = tests::sinking_corner(-1), free = tests::sinking_corner(1);
  const auto use_of = [](const corpus::Case& of, const LimitAnswer& answer) {
    return errors_of(judged(of, answer, limiter(), {Claim::total}).steps[0]).limits;
  };
  LimitUse all = use_of(c, stop_at(c, 0.375));
  EXPECT_EQ(all.share(0), 0.5);
  EXPECT_EQ(all.stalled(), 0u);
  all += use_of(c, stop_at(c, 0));
  all += use_of(c, {-1, at(c, 0.6)});
  all += use_of(free, stop_at(free, 0.75));
  all += use_of(free, stop_at(free, 1));
  EXPECT_EQ(all.free, 2u);
  EXPECT_EQ(all.cut, 1u);
  EXPECT_EQ(all.contact, 3u);
  EXPECT_EQ(all.share(0), 0);
  EXPECT_EQ(all.share(0.5), 0.5);
  EXPECT_NEAR(all.share(1), 0.8, 0.01);
  EXPECT_EQ(all.stalls, (std::map<std::string, std::uint64_t>{{"t inside, moving, generic", 1}}));
}

TEST(Limits, L17_AFailureTellsHowFarItWouldHaveBeenFree) {
  const auto c = tests::sinking_corner(-1);
  DetectorUnderTest detector;
  detector.built_in = false;
  detector.claims = claims_on_limits;
  detector.contract = limiter();
  const auto failure_of = [&](const LimitAnswer& answer) {
    const auto verdict = test::verdict_on(c, {}, run_of(answer), {"limiter", {}}, detector);
    EXPECT_TRUE(verdict.failure);
    return verdict.failure.value_or(Failure{});
  };
  const auto hit = failure_of(stop_at(c, 0.8));
  EXPECT_EQ(hit.signature(),
            "commit-free: contact on the way, vertex-face, t inside, moving, generic");
  EXPECT_TRUE(says(hit.explanation, "allowed a share of 0.8"));
  const auto large = failure_of({0.8, at(c, 0.5)});
  EXPECT_EQ(large.kind, "share too large");
  EXPECT_EQ(large.pair, (detector::TrianglePair{0, 1}));
  EXPECT_TRUE(says(large.explanation, "triangles 0 and 1 meet at t = 0.75"));
  const auto small = failure_of(stop_at(c, 0.25));
  EXPECT_EQ(small.kind, "share too small");
  EXPECT_TRUE(says(small.explanation, "promised 0.5"));
}

}  // namespace
}  // namespace assay::properties
