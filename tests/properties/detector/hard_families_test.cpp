// The hard families of the corpus: the oracle finds what the construction of each case promises, at
// every strength and for every kind. Also meshes at rest.
#include "corpus/hard/hard_families.h"

#include "detector/detector.h"
#include "oracle/mesh/step.h"
#include "oracle/referee/second_opinion.h"
#include "oracle/view/view_sign.h"
#include "properties/judging/agreement.h"
#include "tests/properties/small_case.h"

namespace assay::properties {
namespace {

using corpus::HardFamily;

class HardFamilies : public testing::TestWithParam<HardFamily> {};

// All kinds at the ends and at some strengths between; sheets beyond 512 triangles take long.
std::vector<int> strengths_of(const HardFamily& family) {
  if (family.name == "coplanar") return {0, 2, 4};
  const int most = family.strongest;
  const std::set<int> strengths = {0, 1, most / 3, 2 * most / 3, most, family.last_strength()};
  return {strengths.begin(), strengths.end()};
}

TEST_P(HardFamilies, TheConstructedAnswerIsTheOracles) {
  const HardFamily& family = GetParam();
  for (const int strength : strengths_of(family)) {
    for (int variant = 0; variant < 3 * family.kinds_at(strength); ++variant) {
      const auto c = corpus::hard_case(family, strength, variant);
      const auto& known = c.expected.steps.front();
      const auto judged = oracle::judge_step({c.frames[0], c.frames[1]}, c.triangles, {});
      ASSERT_EQ(judged.answer, known.answer) << c.id;
      if (known.first_time) {
        EXPECT_EQ(judged.first, *known.first_time)
            << c.id << ": " << judged.first.lo << ", built for " << known.first_time->lo;
      }
      if (!known.view_signs) continue;
      const auto view = corpus::view_of_step(c, 0);
      ASSERT_TRUE(view) << c.id;
      const auto signs = oracle::view_signs({c.frames[0], c.frames[1]}, c.triangles, {&*view, 1});
      EXPECT_TRUE(
          std::equal(signs.begin(), signs.end(), known.view_signs->begin(), known.view_signs->end(),
                     [](auto a, auto b) { return static_cast<int>(a) == static_cast<int>(b); }))
          << c.id;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, HardFamilies,
                         testing::ValuesIn(corpus::hard_families().begin(),
                                           corpus::hard_families().end()));

// Meshes at rest: detector and oracle find the pairs that CGAL's static tests find one by one, and
// the referee contradicts none.

using detector::TrianglePair;

std::vector<TrianglePair> pairs_of(const std::vector<detector::PairContact>& contacts) {
  std::vector<TrianglePair> pairs;
  for (const auto& contact : contacts) {
    EXPECT_EQ(contact.time, detector::TimeEnclosure{});
    pairs.push_back(contact.pair);
  }
  return pairs;
}

std::uint64_t queries_of_the_referee = 0;  // that it decided

// Returns how many pairs are in contact.
std::size_t expect_agreement(const std::string& id, const detector::Triangles& triangles,
                             const detector::Positions& x) {
  const detector::SteppedMesh rest{x, x};
  std::vector<TrianglePair> met;
  for (std::int32_t a = 0; a < triangles.rows(); ++a)
    for (std::int32_t b = a + 1; b < triangles.rows(); ++b)
      if (oracle::triangles_meet(rest, triangles, {a, b}, 0.0)) met.push_back({a, b});
  const auto judgement = oracle::judge_step(rest, triangles, {});
  EXPECT_EQ(pairs_of(judgement.pairs), met) << id;
  // The referee has no cubic and no roots: it asks for a direction between the features.
  const auto second = oracle::second_opinion(rest, triangles, judgement, {});
  EXPECT_TRUE(second.complete && second.contradictions.empty()) << id;
  queries_of_the_referee += second.contact + second.no_contact;
  const auto answered = detector::Detector::create(triangles, x, {}).value().step(x, x);
  EXPECT_EQ(pairs_of(answered.pairs), met) << id;
  EXPECT_EQ(answered.answer, met.empty() ? detector::Answer::free : detector::Answer::collision)
      << id;
  return met.size();
}

TEST(AtRest, MeshesMeetThemselvesAsStaticTestsSay) {
  std::size_t met = 0, free = 0, met_of_hard = 0, hard = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const auto c = test::small_case(520, i);
    ++(expect_agreement(c.id, c.triangles, c.frames[i % 2]) > 0 ? met : free);
  }
  EXPECT_GT(std::min(met, free), 20U);
  EXPECT_GT(queries_of_the_referee, 2'000U);
  for (const auto& family : corpus::hard_families())
    for (const int strength : {0, family.strongest, family.last_strength()})
      for (int variant = 0; variant < 2; ++variant) {
        const auto c = corpus::hard_case(family, strength, variant);
        if (c.triangles.rows() > 100) continue;
        ++hard;
        met_of_hard += expect_agreement(c.id, c.triangles, c.frames[1]) > 0 ? 1 : 0;
      }
  EXPECT_GE(hard, 60U);
  EXPECT_GT(met_of_hard, 20U);
}

}  // namespace
}  // namespace assay::properties
