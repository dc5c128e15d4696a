// The options that are drawn for cases: for several pairs of factors, such as relation and
// question, all pairs of values occur. Also covering arrays, and the body that is far from the
// mesh.
#include "properties/laws/options/drawn_options.h"

#include <fmt/format.h>

#include "detector/assembly.h"
#include "properties/generators/parts.h"
#include "tests/properties/laws/judged_case.h"

namespace assay::properties {
namespace {

// Of a factor; numbers of threads are 1, 2 and 3.
template <class Factor>
std::size_t number_of_values(Factor) {
  if constexpr (std::is_enum_v<Factor>) return all_values<Factor>.size();
  return 3;
}

TEST(DrawnOptions, MeetEachTwoValues) {
  std::map<std::string, std::set<std::pair<int, int>>> together;
  std::map<std::string, std::size_t> wanted;
  int far_bodies = 0;
  constexpr const char* names[] = {"closed-generic", "unclosed-generic", "broken"};
  for (int i = 0; i < 900; ++i) {
    const auto id = fmt::format("test:1:{}:{}", names[i % 3], i);
    const test::JudgedCase judged(test::case_of(id).c, {});
    const auto facts = judged.facts();
    const auto d = drawn_options(facts);
    const auto with = [&](const char* pair, auto a, auto b) {
      together[pair].emplace(static_cast<int>(a), static_cast<int>(b));
      wanted[pair] = number_of_values(a) * number_of_values(b);
    };
    with("apart and left out", d.apart, d.left_out);
    with("apart and question", d.apart, d.question);
    with("left out and question", d.left_out, d.question);
    with("left out and threads", d.left_out, d.options.threads);
    with("question and threads", d.question, d.options.threads);
    with("left out and culling", d.left_out, d.options.culling);
    with("question and culling", d.question, d.options.culling);
    with("question and state", d.question, d.state);
    far_bodies += d.has_far_body ? 1 : 0;
    const bool answers =
        d.options.culling == detector::Culling::bvh || d.options.culling == detector::Culling::none;
    EXPECT_TRUE(answers || d.apart == Apart::none) << d.text();
  }
  for (const auto& [pair, values] : together) EXPECT_EQ(values.size(), wanted[pair]) << pair;
  EXPECT_GT(far_bodies, 0);
}

const FactorSizes sizes = {7, 2, 3, 2, 3, 5, 2, 3, 3};

// How many pairs of values of these factors stand together.
std::size_t pairs_of(const std::vector<FactorRow>& rows, std::size_t f, std::size_t g) {
  std::set<std::pair<int, int>> together;
  for (const auto& row : rows) together.emplace(row[f], row[g]);
  return together.size();
}

TEST(CoveringRows, HoldEveryTwoValuesOfEveryTwoFactors) {
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    const auto rows = covering_rows(sizes, seed);
    for (std::size_t f = 0; f < sizes.size(); ++f) {
      for (const auto& row : rows) EXPECT_LT(row[f], sizes[f]);
      for (std::size_t g = 0; g < f; ++g)
        EXPECT_EQ(pairs_of(rows, f, g), std::size_t{sizes[f]} * sizes[g]) << f << " and " << g;
    }
    // No fewer than the two largest factors need, and not many more.
    EXPECT_GE(rows.size(), 35u);
    EXPECT_LE(rows.size(), 45u);
  }
}

TEST(CoveringRows, HoldNoTwoValuesThatMayNotMeet) {
  // The last value of the last factor goes only with the first value of the first one.
  const auto may_meet = [](const TwoValues& two) {
    return two.f != 0 || two.g != 8 || two.b != 2 || two.a == 0;
  };
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    const auto rows = covering_rows(sizes, seed, may_meet);
    EXPECT_EQ(pairs_of(rows, 0, 8), 7u * 2 + 1);
    EXPECT_EQ(pairs_of(rows, 5, 8), 15u);
    EXPECT_EQ(pairs_of(rows, 0, 5), 35u);
  }
}

TEST(CoveringRows, AreThoseOfTheirSeed) {
  EXPECT_EQ(covering_rows(sizes, 3), covering_rows(sizes, 3));
  EXPECT_NE(covering_rows(sizes, 3), covering_rows(sizes, 4));
}

// Notes the most pieces of one loop; two lanes take them in turns.
class CountingArena : public detector::ThreadArena {
 public:
  explicit CountingArena(std::size_t& most) : most_(most) {}
  void run(std::size_t count, const Work& work) override {
    for (std::size_t i = 0; i < count; ++i) work.run(i, i % 2);
    most_ = std::max(most_, count);
  }

 private:
  std::size_t& most_;
};

TEST(FarBody, SharesWorkOutAndChangesNoAnswer) {
  int collisions = 0;
  for (int i = 0; i < 20; ++i) {
    const auto small = test::case_of("test:1:unclosed-generic:" + std::to_string(i)).c;
    const auto large = with_far_body(small, 0);
    ASSERT_TRUE(large);
    detector::Options options;
    options.culling = detector::Culling::bvh;
    std::size_t most = 0;
    auto alone = detector::assemble(small.triangles, small.frames[0], options,
                                    detector::standard_stages(options));
    auto shared = detector::assemble(large->triangles, large->frames[0], options,
                                     detector::standard_stages(options), {},
                                     detector::Workers(std::make_unique<CountingArena>(most), 2));
    ASSERT_TRUE(alone && shared);
    most = 0;
    const auto expected = alone.value().step(small.frames[0], small.frames[1]);
    const auto found = shared.value().step(large->frames[0], large->frames[1]);
    EXPECT_EQ(found.answer, expected.answer);
    EXPECT_TRUE(std::equal(
        found.pairs.begin(), found.pairs.end(), expected.pairs.begin(), expected.pairs.end(),
        [](const auto& a, const auto& b) { return a.pair == b.pair && a.time == b.time; }));
    EXPECT_GE(most, 4u);
    collisions += expected.answer == detector::Answer::collision ? 1 : 0;
  }
  EXPECT_GT(collisions, 0);
}

}  // namespace
}  // namespace assay::properties
