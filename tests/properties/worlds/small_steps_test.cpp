// Random small steps with small-integer coordinates: the detector with every culling against the
// oracle, pairs and times compared bit by bit, and view signs against the oracle's.
#include "properties/worlds/small_steps.h"

#include "detector/detector.h"
#include "oracle/view/view_sign.h"
#include "properties/judging/agreement.h"
#include "tests/asked.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using detector::Culling;

// ASSAY_SEED and ASSAY_CASES replay other cases; ASSAY_CASE runs a single one.
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
  const std::uint64_t seed = tests::asked("ASSAY_SEED", 20111);
  const std::uint64_t cases = tests::asked("ASSAY_CASES", 10000);
  const std::uint64_t only = tests::asked("ASSAY_CASE", cases);
  Tally tally;
  for (std::uint64_t i = 0; i < cases; ++i) {
    if (only != cases && i != only) continue;
    SCOPED_TRACE(i);
    const auto step = make_small_step(seed, i);
    check(step, tally);
    if (HasFatalFailure()) {
      std::printf("replay: ASSAY_SEED=%llu ASSAY_CASE=%llu ctest --preset law -R %s\n",
                  static_cast<unsigned long long>(seed), static_cast<unsigned long long>(i),
                  "EveryCullingAgreesWithTheOracle");
      return;
    }
  }
  std::printf(
      "%llu cases, seed %llu: %llu collide (%llu at t=0), %llu pairs, %llu view signs, %llu "
      "free components; %zu variants\n",
      static_cast<unsigned long long>(cases), static_cast<unsigned long long>(seed),
      static_cast<unsigned long long>(tally.collisions),
      static_cast<unsigned long long>(tally.at_start), static_cast<unsigned long long>(tally.pairs),
      static_cast<unsigned long long>(tally.signs),
      static_cast<unsigned long long>(tally.free_components), std::size(variants));
  for (const auto& [family, n] : tally.families) {
    std::printf("  %-28s %llu\n", family.c_str(), static_cast<unsigned long long>(n));
  }
  if (only == cases) {
    EXPECT_GT(tally.collisions, cases / 4);
    EXPECT_GT(tally.collisions - tally.at_start, cases / 20);
    EXPECT_GT(tally.free_components, cases / 100);
  }
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
      auto made = detector::Detector::create(
          step.triangles, step.x_t0,
          {variant.culling, detector::Start::verified, detector::Pairs::all});
      made.value().step(step.x_t0, step.x_t1);
      const auto result = made.value().step(step.x_t1, x_t2);
      ASSERT_EQ(compare(result, judgement, claims_of({})).outcome, Outcome::holds)
          << variant.name << ", seed " << seed << ", case " << i;
      second_collisions += judgement.pairs.empty() ? 0 : 1;
      dirty += result.dirty;
    }
  }
  std::printf("%llu cases, seed %llu: %llu second steps collide, %llu dirty triangles carried\n",
              static_cast<unsigned long long>(cases), static_cast<unsigned long long>(seed),
              static_cast<unsigned long long>(second_collisions),
              static_cast<unsigned long long>(dirty));
  EXPECT_GT(dirty, cases);
}

}  // namespace
}  // namespace assay::properties
