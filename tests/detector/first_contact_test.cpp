// Pairs::first and Detector::first_contact: a search that is bounded by the earliest contact found
// so far gives the same first time, and the same pairs at this time, as a search for all pairs.
#include "detector/detector.h"
#include "detector/state/step_state.h"
#include "tests/asked.h"
#include "tests/detector/search/search_meshes.h"

namespace assay::detector {
namespace {

// A mesh of sheets of `size` squares a side that lie above each other at the start, and in the
// opposite order at the end. With `height` 0 they are where SearchMeshes puts them.
struct Moving {
  explicit Moving(const tests::MovingMesh& mesh, int size = 0, double height = 0)
      : triangles(mesh.rows()), x_t0(mesh.x_t0), x_t1(mesh.x_t1) {
    for (Eigen::Index v = 0; v < x_t0.rows(); ++v) {
      const double above = height * static_cast<double>(v / ((size + 1) * (size + 1)));
      x_t0(v, 2) += above;
      x_t1(v, 2) -= above;
    }
  }
  Detector detector(Options options) const {
    return std::move(Detector::create(triangles, x_t0, options).value());
  }
  Triangles triangles;
  Positions x_t0, x_t1;
};

std::vector<PairContact> at_first(const StepResult& all) {
  std::vector<PairContact> pairs;
  for (const auto& contact : all.pairs) {
    if (contact.time == all.first) pairs.push_back(contact);
  }
  return pairs;
}

class FirstContact : public testing::TestWithParam<Culling> {};

TEST_P(FirstContact, L6_IsThatOfAllPairs) {
  tests::SearchMeshes random(23);
  const bool sees_all = !uses_views(GetParam());
  int collisions = 0, inside = 0;
  for (int i = 0; i < tests::usual(24); ++i) {
    const int size = 3 + i % 12;
    const Moving mesh(random.sheets(2 + i % 2, size, i % 3 == 0), size, i % 4 == 0 ? 0 : 9);
    const auto all = mesh.detector({GetParam()}).evaluate(mesh.x_t0, mesh.x_t1);
    auto detector = mesh.detector({GetParam(), Start::verified, Pairs::first});
    const auto first = detector.evaluate(mesh.x_t0, mesh.x_t1);
    ASSERT_EQ(first.answer, all.answer);
    if (all.answer != Answer::collision) continue;
    ++collisions;
    inside += all.first.lo > 0;
    ASSERT_EQ(first.first, all.first);
    ASSERT_FALSE(first.pairs.empty());
    for (const auto& contact : first.pairs) EXPECT_EQ(contact.time, all.first);
    EXPECT_TRUE(!sees_all || first.pairs.size() == at_first(all).size());
  }
  EXPECT_GT(collisions, tests::usual(12));
  EXPECT_GT(inside, tests::usual(10));
}

TEST_P(FirstContact, L6_ByABoundIsThereJustIfItIsNotLater) {
  tests::SearchMeshes random(29);
  int bounded = 0, between = 0;
  for (int i = 0; i < tests::usual(24); ++i) {
    const int size = 3 + i % 6;
    const Moving mesh(random.sheets(2, size, i % 3 == 0), size, i % 4 == 0 ? .5 : 9);
    auto detector = mesh.detector({GetParam()});
    const auto all = detector.evaluate(mesh.x_t0, mesh.x_t1);
    const auto by = [&](double until) {
      return detector.first_contact(mesh.x_t0, mesh.x_t1, until);
    };
    if (all.answer == Answer::free) {
      EXPECT_EQ(by(.5).answer, Answer::free);
      EXPECT_TRUE(detector.commit()) << "nothing is known of the rest of the step";
      EXPECT_EQ(by(1).answer, Answer::free);
      EXPECT_FALSE(detector.commit());
      continue;
    }
    for (const double until : {all.first.hi, 1., .5 * all.first.hi + .5}) {
      const auto result = by(until);
      EXPECT_EQ(result.answer, Answer::collision);
      EXPECT_EQ(result.first, all.first);
    }
    if (all.first.hi == 0) continue;
    ++bounded;
    between += all.first.lo < all.first.hi;
    for (const double until : {std::nextafter(all.first.hi, 0.), all.first.hi / 2, 0.})
      EXPECT_EQ(by(until).answer, Answer::free) << until << " of " << all.first.hi;
  }
  EXPECT_GT(bounded, tests::usual(5));
  EXPECT_GT(between, tests::usual(3));
}

TEST_P(FirstContact, DoesNotDependOnThreads) {
  const Moving mesh(tests::SearchMeshes(11).sheets(2, 20, false));
  const auto result_of = [&](std::uint32_t threads) {
    return mesh.detector({.culling = GetParam(), .pairs = Pairs::first, .threads = threads})
        .evaluate(mesh.x_t0, mesh.x_t1);
  };
  const auto expected = result_of(1);
  ASSERT_EQ(expected.answer, Answer::collision);
  for (const std::uint32_t threads : {2u, 3u})
    tests::expect_same_work(result_of(threads), expected);
}

INSTANTIATE_TEST_SUITE_P(Cullings, FirstContact, testing::ValuesIn(all_values<Culling>),
                         tests::culling_of_test);

// Two sheets of 7,000 triangles each that come flat upon each other, all at the same time.
TEST(FirstContact, OfManyAtOnceIsFoundWithFewTests) {
  constexpr int side = 60;
  const auto flat = [](double height) {
    Positions x(2 * side * side, 3);
    for (Eigen::Index v = 0; v < x.rows(); ++v) {
      const auto i = v % (side * side);
      const bool above = v >= side * side;
      x.row(v) << static_cast<double>(i / side) + (above ? .25 : 0),
          static_cast<double>(i % side) + (above ? .125 : 0), above ? height : 0;
    }
    return x;
  };
  const Triangles sheet = tests::squares(side - 1, side - 1);
  Triangles triangles(2 * sheet.rows(), 3);
  triangles << sheet, sheet.array() + side * side;
  Positions start = flat(1), end = flat(-1);
  end(2 * side * side - 7, 2) = -1.5;  // this vertex comes first
  const auto result_of = [&](Pairs pairs) {
    return Detector::create(triangles, start, {Culling::bvh, Start::verified, pairs})
        .value()
        .evaluate(start, end);
  };
  const auto all = result_of(Pairs::all), first = result_of(Pairs::first);
  ASSERT_EQ(all.answer, Answer::collision);
  EXPECT_GT(all.pairs.size(), 10'000u);
  EXPECT_EQ(first.first, all.first);
  EXPECT_EQ(first.pairs.size(), at_first(all).size());
  EXPECT_LT(first.pairs.size(), 20u);
}

TEST(FirstContact, L15_AfterACollisionNothingIsKnown) {
  const Moving mesh(tests::SearchMeshes(11).sheets(2, 8, false));
  for (const auto culling : all_values<Culling>) {
    auto detector = mesh.detector({culling, Start::verified, Pairs::first});
    ASSERT_EQ(detector.evaluate(mesh.x_t0, mesh.x_t1).answer, Answer::collision);
    ASSERT_FALSE(detector.commit());
    const SavedState saved = detector.state();
    const auto& state = *saved.fields().committed;
    EXPECT_FALSE(state.contacts_are_complete);
    EXPECT_EQ(std::count(state.clean.begin(), state.clean.end(), 1), 0);
  }
}

}  // namespace
}  // namespace assay::detector
