// Random small steps with small-integer coordinates: the detector with every culling is compared
// with the oracle, pairs and times bit by bit, and view signs with the oracle's signs. The same
// steps with a relation between pairs, and small worlds of tetrahedra.
#include "properties/worlds/small_steps.h"

#include <fmt/format.h>

#include "corpus/cases/case_file.h"
#include "detector/assembly.h"
#include "detector/detector.h"
#include "detector/search/pair_relation.h"
#include "oracle/view/view_sign.h"
#include "properties/judging/agreement.h"
#include "properties/judging/exam.h"
#include "properties/worlds/tetrahedron_world.h"
#include "tests/asked.h"
#include "tests/curated_cases.h"
#include "tests/properties/worlds/counted_steps.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using detector::Culling, test::CountedSteps, test::CountedTally, test::disagreement;

// ASSAY_SEED and ASSAY_CASES replay other cases; ASSAY_CASE runs a single one.
struct AskedCases {
  AskedCases(std::uint64_t usual_seed, std::uint64_t usual_cases)
      : seed(tests::asked("ASSAY_SEED", usual_seed)),
        cases(tests::asked("ASSAY_CASES", usual_cases)),
        only(tests::asked("ASSAY_CASE", cases)) {}

  // Until one fails, which is told with the line that replays it.
  template <class Check>
  void for_each(const char* test, const Check& check) const {
    for (std::uint64_t i = 0; i < cases && !testing::Test::HasFatalFailure(); ++i) {
      if (only != cases && i != only) continue;
      const testing::ScopedTrace trace(
          __FILE__, __LINE__,
          fmt::format("replay: ASSAY_SEED={} ASSAY_CASE={} ctest --preset law -R {}", seed, i,
                      test));
      check(i);
    }
  }

  std::uint64_t seed, cases, only;
};

struct Variant {
  const char* name;
  Culling culling;
  enum { own, point, line } primitive;
};
constexpr Variant variants[] = {
    {"view-auto, own primitive", Culling::view_auto, Variant::own},
    {"view-auto, given line", Culling::view_auto, Variant::line},
    {"view-point, own point", Culling::view_point, Variant::own},
    {"view-point, given point", Culling::view_point, Variant::point},
    {"view-line, own line", Culling::view_line, Variant::own},
    {"view-line, given line", Culling::view_line, Variant::line},
    {"normal-cone", Culling::normal_cone, Variant::own},
    {"bvh", Culling::bvh, Variant::own},
    {"none", Culling::none, Variant::own},
};

detector::StepResult run(const SmallStep& step, const Variant& variant, detector::Pairs pairs) {
  auto made = detector::Detector::create(step.triangles, step.x_t0,
                                         {variant.culling, detector::Start::verified, pairs});
  std::vector<detector::ViewPrimitive> given;
  if (variant.primitive == Variant::point) given.push_back(step.point);
  if (variant.primitive == Variant::line) given.push_back(step.line);
  return made.value().step(step.x_t0, step.x_t1, given);
}

struct Tally {
  std::uint64_t collisions = 0, at_start = 0, pairs = 0, signs = 0, free_components = 0;
  std::map<std::string, std::uint64_t> families;
};

void check_signs(const SmallStep& step, const detector::Topology& mesh,
                 const detector::StepResult& result, Tally& tally) {
  for (std::size_t c = 0; c < mesh.components.size(); ++c) {
    for (const auto t : mesh.components[c].triangles) {
      const auto corner = [&](int i) {
        return detector::SteppedMesh{step.x_t0, step.x_t1}.path(step.triangles(t, i));
      };
      const auto exact = oracle::view_sign({corner(0), corner(1), corner(2)}, result.primitives[c]);
      ASSERT_EQ(result.signs[static_cast<std::size_t>(t)], exact) << "view sign of triangle " << t;
      ++tally.signs;
    }
  }
}

void check(const SmallStep& step, Tally& tally) {
  const auto judgement = oracle::judge_step({step.x_t0, step.x_t1}, step.triangles, {1, {}});
  ++tally.families[step.family];
  tally.collisions += judgement.pairs.empty() ? 0 : 1;
  tally.at_start += !judgement.pairs.empty() && judgement.first.hi == 0 ? 1 : 0;
  tally.pairs += judgement.pairs.size();
  const auto mesh = detector::make_topology(step.triangles, step.x_t0.rows());
  for (const auto& variant : variants) {
    SCOPED_TRACE(variant.name);
    const auto all = run(step, variant, detector::Pairs::all);
    tally.free_components += all.counts.free_components;
    const auto diff = compare(all, judgement, claims_of({}));
    ASSERT_EQ(diff.outcome, Outcome::holds)
        << diff.missing.size() << " missing, " << diff.spurious.size() << " spurious, "
        << diff.late.size() << " late, " << diff.early.size() << " early";
    const auto first = run(step, variant, detector::Pairs::first);
    ASSERT_EQ(compare(first, judgement, claims_of({.pairs = detector::Pairs::first})).outcome,
              Outcome::holds);
    const bool must_have_views =
        variant.culling == Culling::view_point || variant.culling == Culling::view_line;
    if (must_have_views || !all.signs.empty()) {
      ASSERT_EQ(all.view_positive + all.view_negative + all.view_zero + all.against_all,
                step.triangles.rows());
      check_signs(step, mesh, all, tally);
    }
  }
}

TEST(SmallSteps, L3_L7_L12_EveryCullingAgreesWithTheOracle) {
  const AskedCases asked(20111, 10000);
  const auto [seed, cases, only] = asked;
  Tally tally;
  asked.for_each("EveryCullingAgreesWithTheOracle",
                 [&](std::uint64_t i) { check(make_small_step(seed, i), tally); });
  fmt::print(
      "{} cases, seed {}: {} collide ({} at t=0), {} pairs, {} view signs, {} free components; {} "
      "variants\n",
      cases, seed, tally.collisions, tally.at_start, tally.pairs, tally.signs,
      tally.free_components, std::size(variants));
  for (const auto& [family, n] : tally.families) fmt::print("  {:28} {}\n", family, n);
  if (only == cases) {
    EXPECT_GT(tally.collisions, cases / 4);
    EXPECT_GT(tally.collisions - tally.at_start, cases / 20);
    EXPECT_GT(tally.free_components, cases / 100);
  }
}

// A shorter step, asked after the whole one, is answered as if it were asked alone.
TEST(SmallSteps, L20_AskedAgainIsAnsweredAlike) {
  const std::uint64_t seed = tests::asked("ASSAY_SEED", 20120);
  const std::uint64_t cases = tests::asked("ASSAY_CASES", 10000);
  std::uint64_t kept = 0, collisions = 0;
  for (std::uint64_t i = 0; i < cases; ++i) {
    const auto step = make_small_step(seed, i);
    const double share = static_cast<double>(i % 16 + 1) / 16;
    const detector::Positions x = step.x_t0 + share * (step.x_t1 - step.x_t0);
    const auto pairs = i % 3 == 0 ? detector::Pairs::first : detector::Pairs::all;
    const auto make = [&](bool keeps_near) {
      const auto culling = i % 2 == 0 ? Culling::bvh : Culling::automatic;
      detector::Options options{culling, detector::Start::verified, pairs};
      options.keeps_near = keeps_near;
      return std::move(detector::Detector::create(step.triangles, step.x_t0, options).value());
    };
    auto asked = make(true), fresh = make(false);
    asked.evaluate(step.x_t0, step.x_t1);
    const auto again = asked.evaluate(step.x_t0, x), expected = fresh.evaluate(step.x_t0, x);
    SCOPED_TRACE(fmt::format("seed {}, case {}", seed, i));
    ASSERT_EQ(again.answer, expected.answer);
    ASSERT_EQ(again.first, expected.first);
    const auto is_same = [](const detector::PairContact& a, const detector::PairContact& b) {
      return a.pair == b.pair && a.time == b.time && a.feature.kind == b.feature.kind &&
             a.feature.vertices == b.feature.vertices;
    };
    ASSERT_TRUE(std::equal(again.pairs.begin(), again.pairs.end(), expected.pairs.begin(),
                           expected.pairs.end(), is_same));
    kept += again.counts.search.box_tests == 0;
    collisions += again.answer == detector::Answer::collision;
  }
  EXPECT_GT(kept, cases / 4);
  EXPECT_GT(collisions, cases / 4);
}

// Two steps with the state carried: what the first leaves dirty or clean serves the second.
TEST(SmallSteps, L8_StateIsCarriedSoundly) {
  const std::uint64_t seed = tests::asked("ASSAY_SEED", 20112);
  const std::uint64_t cases = 2000;
  std::uint64_t second_collisions = 0, dirty = 0;
  for (std::uint64_t i = 0; i < cases; ++i) {
    const auto step = make_small_step(seed, i);
    const auto other = make_small_step(seed, i + cases);
    detector::Positions x_t2 = step.x_t1;
    for (Eigen::Index v = 0; v < std::min(x_t2.rows(), other.x_t1.rows()); ++v)
      x_t2.row(v) = other.x_t1.row(v);
    const auto judgement = oracle::judge_step({step.x_t1, x_t2}, step.triangles, {1, {}});
    for (const auto& variant : variants) {
      if (variant.primitive != Variant::own) continue;
      auto made = detector::Detector::create(step.triangles, step.x_t0, {variant.culling});
      made.value().step(step.x_t0, step.x_t1);
      const auto result = made.value().step(step.x_t1, x_t2);
      ASSERT_EQ(compare(result, judgement, claims_of({})).outcome, Outcome::holds)
          << variant.name << ", seed " << seed << ", case " << i;
      second_collisions += judgement.pairs.empty() ? 0 : 1;
      dirty += result.dirty;
    }
  }
  fmt::print("{} cases, seed {}: {} second steps collide, {} dirty triangles carried\n", cases,
             seed, second_collisions, dirty);
  EXPECT_GT(dirty, cases);
}

// Small worlds of tetrahedra: the classes cover every motion, and all of them hold.

const TetrahedronWorld& world_named(std::string_view name) {
  const auto all = tetrahedron_worlds();
  return *std::find_if(all.begin(), all.end(), [&](const auto& w) { return w.name == name; });
}

std::uint64_t sum_of_classes(const TetrahedronMotions& motions) {
  std::uint64_t sum = 0;
  for (std::size_t b = 0; b < motions.blocks(); ++b) {
    motions.for_each(b, [&](const TetrahedronMotion& motion) {
      for (const auto& view : motion.views) sum += motion.stands_for * view.stands_for;
      return true;
    });
  }
  return sum;
}

// Every motion is in exactly one class: the classes' sizes sum up to the motions there are.
TEST(TetrahedronMotions, ClassesStandForAllMotions) {
  for (const TetrahedronGrid& grid :
       {TetrahedronGrid{2, 1, 4}, {3, 1, 4}, {2, 2, 4}, {2, 3, 1}, {2, 3, 2}, {3, 2, 1}}) {
    const TetrahedronMotions motions(grid);
    EXPECT_EQ(sum_of_classes(motions), motions.all()) << grid.side << grid.dimensions;
  }
  // 8 places: at rest 8^4, one of four vertices on one of 56 paths 4 * 56 * 8^3; 27 view-points.
  EXPECT_EQ(TetrahedronMotions({2, 3, 1}).all(), (4096u + 4 * 56 * 512) * 27);
}

// For any number of threads.
TEST(TetrahedronWorld, L3_L4_L5_HoldInTheSmallestWorlds) {
  struct Wanted {
    const char* name;
    int jobs;
    std::uint64_t classes, motions, first_in_k, one_sign, all_positive;
  };
  std::set<std::pair<std::uint64_t, std::uint64_t>> collisions_and_clean_starts;
  for (const Wanted& wanted : {Wanted{"square-2", 2, 4480, 589824, 0, 0, 0},
                               {"cube-2-one", 1, 4432, 3207168, 1390, 2, 1},
                               {"cube-2-one", 3, 4432, 3207168, 1390, 2, 1}}) {
    SCOPED_TRACE(wanted.name);
    const auto r = prove(world_named(wanted.name), {wanted.jobs, 0, {}});
    ASSERT_TRUE(r.complete) << r.explanation << "\n" << corpus::case_text(*r.counterexample);
    EXPECT_EQ(r.classes, wanted.classes);
    EXPECT_EQ(r.motions, wanted.motions);
    EXPECT_EQ(r.motions, r.all);
    collisions_and_clean_starts.emplace(r.collisions, r.clean_starts);
    if (wanted.first_in_k == 0) continue;
    EXPECT_EQ(r.first_in_k, wanted.first_in_k);
    EXPECT_EQ(r.one_sign, wanted.one_sign);
    EXPECT_EQ(r.all_positive, wanted.all_positive);
  }
  EXPECT_EQ(collisions_and_clean_starts.size(), 2u);
}

TEST(TetrahedronWorld, StopsWhenAskedAndSaysSo) {
  const auto result = prove(world_named("cube-2-two"), {2, 0.2, {}});
  EXPECT_FALSE(result.complete);
  EXPECT_FALSE(result.counterexample);
  EXPECT_GT(result.classes, 0u);
  EXPECT_LT(result.motions, result.all);
  EXPECT_LT(result.seconds, 10);
}

// L19: what counts. A plain loop, the oracle and the detector agree on random steps with random
// relations.

template <class Disagreement>
void expect_agreement(const char* test, std::uint64_t usual, const Disagreement& disagree) {
  const AskedCases asked(20119, usual);
  const auto [seed, cases, only] = asked;
  CountedTally tally;
  asked.for_each(test, [&](std::uint64_t i) {
    const auto wrong = disagree(test::make_counted_steps(seed, i), i, tally);
    ASSERT_FALSE(wrong) << *wrong;
  });
  fmt::print(
      "{} steps, seed {}: {} collide, {} pairs count; {} in contact do not, in {} steps, {} of "
      "which "
      "collide\n",
      tally.steps, seed, tally.collisions, tally.pairs, tally.ignored, tally.with_ignored,
      tally.with_both);
  if (only != cases) return;
  EXPECT_GT(tally.with_ignored, tally.steps / 10);
  EXPECT_GT(tally.with_both, tally.steps / 20);
  EXPECT_GT(tally.steps - tally.collisions, tally.steps / 20);
}

TEST(CountedSteps, L19_PlainLoopOracleAndDetectorAgree) {
  expect_agreement(
      "PlainLoopOracleAndDetectorAgree", 1000,
      [](const CountedSteps& steps, auto, auto& tally) { return disagreement(steps, tally); });
}

TEST(CountedSteps, L16_L19_TheyAgreeWithinASeparationToo) {
  constexpr double separations[] = {0.5, 1, 2, 0x1p-30, 1.4142135623730951};
  expect_agreement("TheyAgreeWithinASeparationToo", 150,
                   [&](const CountedSteps& steps, std::uint64_t i, auto& tally) {
                     return test::disagreement_within(steps, separations[i % 5], tally);
                   });
}

// A detector that drops contacts that do not count before the closure: only what counts joins H.
class DropsBeforeTheClosure : public detector::PairRule {
 public:
  DropsBeforeTheClosure(const detector::CountedPairs& counted, const detector::Topology& mesh)
      : mesh_(mesh), relation_(&counted, mesh) {}
  bool joins_closure(const detector::TrianglePair& pair, std::int32_t) const override {
    return relation_.counts(mesh_, pair);
  }

 private:
  const detector::Topology mesh_;
  const detector::PairRelation relation_;
};

// A corner of a tube passes through its own 2-ring, and then meets the far side from the inside.
TEST(CountedSteps, L19_AnIgnoredContactTurnsTriangles) {
  const auto c = tests::curated_case("F_ignored_contact");
  const CountedSteps steps = {c.triangles, c.frames, c.counted->pairs};
  CountedTally tally;
  EXPECT_EQ(disagreement(steps, tally), std::nullopt);
  EXPECT_GT(tally.ignored, 0u);

  detector::Options options;
  options.culling = detector::Culling::view_point;
  options.counted = &c.counted->pairs;
  auto right = detector::Detector::create(c.triangles, c.frames[0], options);
  EXPECT_EQ(right.value().step(c.frames[0], c.frames[1]).answer, detector::Answer::collision);
  detector::Stages stages = detector::standard_stages(options);
  stages.pair_rule = std::make_shared<DropsBeforeTheClosure>(
      c.counted->pairs, detector::make_topology(c.triangles, c.frames[0].rows()));
  auto wrong = detector::assemble(c.triangles, c.frames[0], options, std::move(stages));
  EXPECT_EQ(wrong.value().step(c.frames[0], c.frames[1]).answer, detector::Answer::free);
}

}  // namespace
}  // namespace assay::properties
