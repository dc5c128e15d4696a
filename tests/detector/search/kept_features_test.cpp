// A step that begins where an earlier step began: with the features kept from the earlier step, it
// has the same answer.
#include "detector/search/kept_features.h"

#include "detector/detector.h"
#include "detector/state/step_state.h"
#include "tests/asked.h"
#include "tests/detector/search/search_meshes.h"

namespace assay::detector {
namespace {

// A mesh of sheets that pass through each other or past each other, and steps that begin with it.
class AskedAgain : public testing::TestWithParam<Culling> {
 protected:
  // Of any size, anywhere.
  void make(int i) {
    const int size = 3 + i % 7;
    tests::MovingMesh mesh = random_.sheets(2 + i % 2, size, i % 3 == 0);
    // Above each other at the start, some of them; in the opposite order at the end.
    const double height = i % 4 == 0 ? 0 : i % 4 == 1 ? 9 : 3;
    for (Eigen::Index v = 0; v < mesh.x_t0.rows(); ++v) {
      const double above = height * static_cast<double>(v / ((size + 1) * (size + 1)));
      mesh.x_t0(v, 2) += above;
      mesh.x_t1(v, 2) -= above;
    }
    const double scale = std::ldexp(1, 40 * (i % 5) - 80), away = i % 4 == 0 ? 1e5 : 0;
    triangles_ = mesh.rows();
    x_t0_ = scale * (mesh.x_t0.array() + away);
    x_t1_ = scale * ((i % 2 ? mesh.x_t0 + .1 * (mesh.x_t1 - mesh.x_t0) : mesh.x_t1).array() + away);
    // A quarter of what L20 allows: the share is only as exact as the place of the fastest vertex.
    const FloatGrid grid({x_t0_, x_t1_});
    for (std::size_t k = 0; k < 3; ++k) off_[k] = grid.tolerance()[k] / 4;
  }

  Detector detector(Options options, bool keeps_near = true) const {
    options.keeps_near = keeps_near;
    return std::move(Detector::create(triangles_, x_t0_, options).value());
  }

  // A place on the way, and a little off it: the end of a shorter step as a line search has it.
  Positions end_at(double share, double off) {
    Positions x = x_t0_ + share * (x_t1_ - x_t0_);
    for (Eigen::Index i = 0; i < x.size(); ++i)
      x.data()[i] += off * random_.number(false) * off_[static_cast<std::size_t>(i % 3)];
    return x;
  }

  static bool was_kept(const StepResult& result) {
    return result.counts.search.box_tests + result.counts.search.candidate_pairs == 0 &&
           result.counts.narrow.rungs.axis + result.counts.narrow.elementary_tests > 0;
  }

  tests::SearchMeshes random_{41};
  Triangles triangles_;
  Positions x_t0_, x_t1_;
  Point off_{};
};

TEST_P(AskedAgain, L20_AShorterStepIsAnsweredAsIfItWereTheFirst) {
  int kept_steps = 0, kept_beyond = 0, collisions = 0, inside = 0;
  for (int i = 0; i < tests::usual(60); ++i) {
    make(i);
    Options options{GetParam(), Start::verified, i % 5 < 2 ? Pairs::first : Pairs::all};
    options.threads = i % 7 == 0 ? 3 : 1;
    if (!chooses_views(GetParam()) && i % 6 == 1) options.separation = .05 * std::abs(x_t0_(0, 0));
    CountedPairs counted;
    for (std::int32_t t = 0; t < triangles_.rows() / 2; t += 2)
      counted.triangle_pairs.push_back({t, static_cast<std::int32_t>(triangles_.rows()) - 1 - t});
    counted.rings = 2;
    if (i % 4 == 3) options.counted = &counted;
    Detector older = detector(options);
    const StepResult whole = older.evaluate(x_t0_, x_t1_);
    const bool is_bounded = options.pairs == Pairs::first && whole.answer == Answer::collision;
    const double met = is_bounded ? whole.first.lo : 1;
    for (const double share :
         {met, .99 * met, .7 * met, .5 * met, 1e-3 * met, .1 + .9 * met, 1., 3.}) {
      const Positions x = end_at(share, i % 2);
      const StepResult again = older.evaluate(x_t0_, x);
      Detector fresh = detector(options, false);
      const StepResult expected = fresh.evaluate(x_t0_, x);
      ASSERT_EQ(again.answer, expected.answer) << i << " " << share;
      tests::expect_same_contacts(again, expected);
      kept_steps += was_kept(again);
      kept_beyond += was_kept(again) && share > met;
      collisions += again.answer == Answer::collision;
      inside += again.first.lo > 0;
      if (chooses_views(GetParam())) continue;
      ASSERT_EQ(older.commit().has_value(), fresh.commit().has_value());
      EXPECT_EQ(older.state(), fresh.state());
    }
  }
  EXPECT_GT(kept_steps, tests::usual(100));
  EXPECT_GT(collisions, tests::usual(30));
  EXPECT_GT(inside, tests::usual(20));
  // A step that goes on beyond a first contact meets it again.
  EXPECT_GT(kept_beyond, tests::usual(10));
}

TEST_P(AskedAgain, WhatLeavesTheStepIsSearched) {
  make(9);
  const auto is_searched = [&](const Positions& from, const Positions& to) {
    Detector older = detector({GetParam()});
    EXPECT_FALSE(was_kept(older.evaluate(x_t0_, x_t1_)));
    const StepResult again = older.evaluate(from, to);
    tests::expect_same_contacts(again, detector({GetParam()}, false).evaluate(from, to));
    return !was_kept(again);
  };
  EXPECT_FALSE(is_searched(x_t0_, x_t1_));
  EXPECT_FALSE(is_searched(x_t0_, end_at(.5, 1)));
  EXPECT_TRUE(is_searched(x_t0_, end_at(1.01, 0))) << "farther";
  EXPECT_TRUE(is_searched(x_t0_, end_at(-.1, 0))) << "back";
  EXPECT_TRUE(is_searched(x_t0_, end_at(.5, 9))) << "beside the way";
  EXPECT_TRUE(is_searched(end_at(.1, 0), end_at(.5, 0))) << "from another place";
  Detector older = detector({GetParam()}, false);
  older.evaluate(x_t0_, x_t1_);
  EXPECT_FALSE(was_kept(older.evaluate(x_t0_, end_at(.5, 0)))) << "unless it is asked for";
}

// Boxes that hardly are apart, and a step that ends as far off as it may: below what lies there.
TEST_P(AskedAgain, L20_WhatIsHardlyApartIsKept) {
  const Triangles three = tests::triangles({{0, 1, 2}, {3, 4, 5}, {6, 7, 8}});
  Positions x =
      tests::positions_of("-1 -1 0, 1 -1 0, 0 1 0, -1 -1 0, 1 -1 0, 0 1 0, 9 9 -1, 8 9 1, 9 8 0");
  x.middleRows(3, 3).col(2).setConstant(0x1p-40);
  Positions along = x;
  along.middleRows(3, 3).col(0).array() += .5;
  for (const double below : {0x1p-27, -0x1p-27}) {
    triangles_ = three;
    x_t0_ = x;
    Detector older = detector({GetParam()});
    ASSERT_EQ(older.evaluate(x, along).answer, Answer::free);
    Positions half = .5 * x + .5 * along;
    half.middleRows(3, 3).col(2).array() = -below;
    const StepResult again = older.evaluate(x, half);
    EXPECT_TRUE(was_kept(again));
    EXPECT_EQ(again.answer, below > 0 ? Answer::collision : Answer::free);
  }
}

// A contact ends what the first one is looked for in: later than that nothing is kept.
TEST_P(AskedAgain, L20_BeyondAFirstContactNothingIsKept) {
  int beyond = 0;
  for (int i = 0; i < 40; i += 2) {
    make(i);
    Detector older = detector({GetParam(), Start::verified, Pairs::all});
    const StepResult first = older.first_contact(x_t0_, x_t1_, 1);
    if (first.answer != Answer::collision || first.first.hi >= .25) continue;
    const StepResult all = older.evaluate(x_t0_, end_at(.75, 0));
    tests::expect_same_contacts(all, detector({GetParam()}, false).evaluate(x_t0_, end_at(.75, 0)));
    beyond += !was_kept(all);
  }
  EXPECT_GT(beyond, 3);
}

// The first contact of a part of the step, after the whole step and after a part.
TEST_P(AskedAgain, L20_APartOfTheStepIsAnsweredAsIfItWereTheFirst) {
  int kept_steps = 0, collisions = 0;
  for (int i = 0; i < 40; ++i) {
    make(i);
    Detector older = detector({GetParam(), Start::verified, Pairs::all});
    i % 2 ? older.evaluate(x_t0_, x_t1_) : older.first_contact(x_t0_, x_t1_, .6);
    for (const double until : {.5, .25}) {
      const StepResult again = older.first_contact(x_t0_, x_t1_, until);
      Detector fresh = detector({GetParam(), Start::verified, Pairs::all}, false);
      const StepResult expected = fresh.first_contact(x_t0_, x_t1_, until);
      ASSERT_EQ(again.answer, expected.answer) << i << " " << until;
      EXPECT_EQ(again.first, expected.first);
      kept_steps += was_kept(again);
      collisions += again.answer == Answer::collision;
    }
  }
  EXPECT_GT(kept_steps, 20);
  EXPECT_GT(collisions, 20);
}

// What changes the state, or the mesh's place, between two questions.
TEST_P(AskedAgain, L20_WhatIsBetweenTwoQuestionsChangesNoAnswer) {
  for (int i = 0; i < tests::usual(60); ++i) {
    make(i);
    Detector older = detector({GetParam(), Start::verified, Pairs::all});
    const auto before = older.state();
    older.evaluate(x_t0_, x_t1_);
    const Positions x = end_at(.5, 1);
    Positions start = x_t0_;
    ASSERT_FALSE(i % 4 == 0 && older.commit());
    if (i % 4 == 0) older.reset();
    ASSERT_FALSE(i % 4 == 1 && older.restore(before));
    if (i % 4 == 2 && !older.commit()) start = x_t1_;
    if (i % 4 == 3) older.evaluate(x_t1_, x_t0_);
    Detector fresh = detector({GetParam(), Start::verified, Pairs::all}, false);
    if (start == x_t1_) {
      fresh.evaluate(x_t0_, x_t1_);
      ASSERT_FALSE(fresh.commit().has_value());
    }
    const StepResult again = older.evaluate(start, x), expected = fresh.evaluate(start, x);
    ASSERT_EQ(again.answer, expected.answer) << i;
    tests::expect_same_contacts(again, expected);
  }
}

// Bounded doubles have doubts, which depend on the pairs that are tested. So nothing is kept.
TEST_P(AskedAgain, WithoutExactArithmeticNothingIsKept) {
  make(9);
  const Options options{.culling = GetParam(), .arithmetic = Arithmetic::bounded};
  Detector older = detector(options);
  older.evaluate(x_t0_, x_t1_);
  const Positions half = end_at(.5, 0);
  const StepResult again = older.evaluate(x_t0_, half);
  const StepResult expected = detector(options, false).evaluate(x_t0_, half);
  EXPECT_EQ(again.counts.search.candidate_pairs, expected.counts.search.candidate_pairs);
  EXPECT_EQ(again.doubts, expected.doubts);
}

INSTANTIATE_TEST_SUITE_P(Cullings, AskedAgain,
                         testing::Values(Culling::bvh, Culling::automatic, Culling::none),
                         tests::culling_of_test);

}  // namespace
}  // namespace assay::detector
