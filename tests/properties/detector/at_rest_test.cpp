// Meshes at rest: detector and oracle find the pairs that CGAL's static tests find one by one, and
// the referee contradicts none.
#include "corpus/hard/hard_families.h"
#include "detector/detector.h"
#include "oracle/mesh/step.h"
#include "oracle/referee/second_opinion.h"
#include "tests/properties/small_case.h"

namespace assay::properties {
namespace {

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
  for (std::int32_t a = 0; a < triangles.rows(); ++a) {
    for (std::int32_t b = a + 1; b < triangles.rows(); ++b) {
      if (oracle::triangles_meet(rest, triangles, {a, b}, 0.0)) met.push_back({a, b});
    }
  }
  const auto judgement = oracle::judge_step(rest, triangles, {});
  EXPECT_EQ(pairs_of(judgement.pairs), met) << id;
  // The referee has no cubic and no roots: it asks for a direction between the features.
  const auto second = oracle::second_opinion(rest, triangles, judgement, {});
  EXPECT_TRUE(second.complete && second.contradictions.empty()) << id;
  queries_of_the_referee += second.contact + second.no_contact;
  auto made = detector::Detector::create(triangles, x, {});
  EXPECT_TRUE(made) << id;
  if (!made) return 0;
  const auto answered = made.value().step(x, x);
  EXPECT_EQ(pairs_of(answered.pairs), met) << id;
  EXPECT_EQ(answered.answer, met.empty() ? detector::Answer::free : detector::Answer::collision)
      << id;
  return met.size();
}

TEST(AtRest, RandomMeshesMeetThemselvesAsStaticTestsSay) {
  std::size_t met = 0, free = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const auto c = test::small_case(520, i);
    const auto pairs = expect_agreement(c.id, c.triangles, c.frames[i % 2]);
    ++(pairs > 0 ? met : free);
  }
  EXPECT_GT(met, 20U);
  EXPECT_GT(free, 20U);
  EXPECT_GT(queries_of_the_referee, 2'000U);
}

TEST(AtRest, HardMeshesMeetThemselvesAsStaticTestsSay) {
  std::size_t met = 0, tried = 0;
  for (const auto& family : corpus::hard_families()) {
    for (const int strength : {0, family.strongest, family.last_strength()}) {
      for (int variant = 0; variant < 2; ++variant) {
        const auto c = corpus::hard_case(family, strength, variant);
        if (c.triangles.rows() > 100) continue;
        ++tried;
        met += expect_agreement(c.id, c.triangles, c.frames[1]) > 0 ? 1 : 0;
      }
    }
  }
  EXPECT_GE(tried, 60U);
  EXPECT_GT(met, 20U);
}

}  // namespace
}  // namespace assay::properties
