// Small worlds of tetrahedra: the classes cover every motion, and all of them hold.
#include "properties/worlds/tetrahedron_world.h"

#include "properties/judging/case_check.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

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

void print(const char* name, const TetrahedronWorldResult& r) {
  std::printf(
      "%s: %llu classes proved for %llu of %llu motions%s, %.1f s; %llu collide, L3 %llu, L4 %llu, "
      "L5 %llu\n",
      name, static_cast<unsigned long long>(r.classes), static_cast<unsigned long long>(r.motions),
      static_cast<unsigned long long>(r.all), r.complete ? "" : " (not complete)", r.seconds,
      static_cast<unsigned long long>(r.collisions), static_cast<unsigned long long>(r.first_in_k),
      static_cast<unsigned long long>(r.one_sign), static_cast<unsigned long long>(r.all_positive));
}

TEST(TetrahedronWorld, L3_L4_L5_HoldInTheSmallestWorlds) {
  struct Wanted {
    const char* name;
    std::uint64_t classes, motions;
  };
  for (const Wanted& wanted : {Wanted{"square-2", 4480, 589824}, {"cube-2-one", 4432, 3207168}}) {
    const auto result = prove(world_named(wanted.name), {2, 0, {}});
    print(wanted.name, result);
    ASSERT_TRUE(result.complete) << result.explanation << "\n"
                                 << corpus::case_text(*result.counterexample);
    EXPECT_EQ(result.classes, wanted.classes);
    EXPECT_EQ(result.motions, wanted.motions);
    EXPECT_EQ(result.motions, result.all);
  }
}

TEST(TetrahedronWorld, PremisesAreMetAndCountsDoNotDependOnThreads) {
  const auto one = prove(world_named("cube-2-one"), {1, 0, {}});
  const auto three = prove(world_named("cube-2-one"), {3, 0, {}});
  EXPECT_EQ(one.first_in_k, 1390u);
  EXPECT_EQ(one.one_sign, 2u);
  EXPECT_EQ(one.all_positive, 1u);
  EXPECT_EQ(one.classes, three.classes);
  EXPECT_EQ(one.collisions, three.collisions);
  EXPECT_EQ(one.first_in_k, three.first_in_k);
  EXPECT_EQ(one.clean_starts, three.clean_starts);
}

TEST(TetrahedronWorld, StopsWhenAskedAndSaysSo) {
  const auto result = prove(world_named("cube-3-two"), {2, 0.2, {}});
  print("cube-3-two", result);
  EXPECT_FALSE(result.complete);
  EXPECT_FALSE(result.counterexample);
  EXPECT_GT(result.classes, 0u);
  EXPECT_LT(result.motions, result.all);
  EXPECT_LT(result.seconds, 10);
}

}  // namespace
}  // namespace assay::properties
