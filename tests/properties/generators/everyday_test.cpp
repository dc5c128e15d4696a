// Everyday numbers: sizes, units of the last place, and how often the things come together that a
// detector errs by which rounds on the way in.
#include "properties/generators/everyday.h"

#include <bit>

#include "oracle/mesh/step.h"
#include "oracle/query/contact.h"
#include "properties/generators/families.h"
#include "properties/queries/query_families.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

TEST(EverydayNumbers, SizesAreNoPowersOfTwoAndOfEveryScale) {
  std::map<int, int> scales;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    Random random(1, i);
    const double size = everyday_size(random);
    ASSERT_GT(size, 1e-4);
    ASSERT_LT(size, 1e6);
    EXPECT_NE(std::bit_cast<std::uint64_t>(size) << 12, 0u) << size;
    ++scales[static_cast<int>(std::floor(std::log10(size)))];
  }
  EXPECT_EQ(scales.size(), 10u);
}

TEST(EverydayNumbers, UnitsGoBeyondOrStayShort) {
  EXPECT_EQ(units_beyond(1, 0, -1), 1);
  EXPECT_EQ(units_beyond(1, 2, 5), 1 + 0x1p-51);
  EXPECT_EQ(units_beyond(1, 2, -5), 1 - 0x1p-52);
  EXPECT_EQ(units_beyond(1, -1, 5), 1 - 0x1p-53);
  EXPECT_EQ(units_beyond(0, 1, -1), -0x1p-52);
}

// Whether some coordinate of the step is not x0 + (x1 - x0) where it ends.
bool ends_are_rounded(const detector::Positions& x_t0, const detector::Positions& x_t1) {
  return (x_t0 + (x_t1 - x_t0)).eval() != x_t1;
}

TEST(EverydayNumbers, StepsEndInContactWhereDisplacementsAreRounded) {
  for (const auto& family : families()) {
    if (!family.name.ends_with("-everyday")) continue;
    constexpr int cases = 300;
    int at_end = 0, rounded = 0, at_start = 0;
    for (int i = 0; i < cases; ++i) {
      const auto c =
          make_case(family, "everyday:1:" + std::string(family.name) + ":" + std::to_string(i)).c;
      const auto& [x_t0, x_t1] = std::tie(c.frames[0], c.frames[1]);
      const auto truth = oracle::judge_step({x_t0, x_t1}, c.triangles, {1, {}});
      if (truth.pairs.empty()) continue;
      at_start += truth.first.hi == 0 ? 1 : 0;
      if (truth.first.lo < 0.999999) continue;
      ++at_end;
      rounded += ends_are_rounded(x_t0, x_t1) ? 1 : 0;
    }
    std::printf("%-20s of %d first steps %d meet at the end, %d with rounded ends, %d at start\n",
                std::string(family.name).c_str(), cases, at_end, rounded, at_start);
    EXPECT_GE(at_end, cases / 6) << family.name;
    EXPECT_GE(rounded, cases / 8) << family.name;
    EXPECT_GE(at_start, cases / 40) << family.name;
  }
}

TEST(EverydayNumbers, QueriesEndInContactWhereDisplacementsAreRounded) {
  const auto& everyday = query_generators().back();
  constexpr std::uint64_t queries = 2000;
  int at_end = 0, level = 0, contacts = 0;
  for (std::uint64_t i = 0; i < queries; ++i) {
    const auto q = everyday.make(1, i).query;
    const auto answer = oracle::contact_of(q, detector::Want::first_time);
    if (!answer.contact) continue;
    ++contacts;
    if (answer.first.lo < 0.999999) continue;
    ++at_end;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto is_rounded = [&](const detector::MovingPoint& p) {
        return p.t0[k] + (p.t1[k] - p.t0[k]) != p.t1[k];
      };
      const auto is_level = [&](const detector::MovingPoint& p) {
        return std::abs(p.t1[k] - q.points[0].t1[k]) <= 1e-13 * std::abs(p.t1[k]);
      };
      if (std::all_of(q.points.begin(), q.points.end(), is_level) &&
          std::any_of(q.points.begin(), q.points.end(), is_rounded))
        ++level;
    }
  }
  std::printf("of %d queries %d meet, %d at the end, %d of these level and rounded\n",
              static_cast<int>(queries), contacts, at_end, level);
  EXPECT_GE(at_end, static_cast<int>(queries) / 5);
  EXPECT_GE(level, static_cast<int>(queries) / 20);
  EXPECT_LT(contacts, static_cast<int>(queries) * 9 / 10);
}

}  // namespace
}  // namespace assay::properties
