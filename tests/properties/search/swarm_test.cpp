// A swarm depends on its name, and suits the detector.
#include <gtest/gtest.h>

#include <set>

#include "properties/search/search.h"

namespace assay::properties {
namespace {

class Swarms : public testing::Test {
 protected:
  static SearchSpace space(bool gives_views) {
    static const Contract contract;
    return {contract, case_sources({true, false, "", {}}), {}, gives_views};
  }
};

TEST_F(Swarms, HaveAllThemes) {
  const auto of_views = space(true), without = space(false);
  std::set<Theme> themes, themes_without;
  for (std::uint64_t begin = 0; begin < 100; ++begin) {
    themes.insert(Swarm("lane", of_views, begin).theme);
    themes_without.insert(Swarm("lane", without, begin).theme);
  }
  EXPECT_EQ(themes.size(), 6);
  EXPECT_EQ(themes_without,
            (std::set<Theme>{Theme::everything, Theme::fresh, Theme::degeneracies}));
}

TEST_F(Swarms, MoveNoViewThatIsNotGiven) {
  const auto without = space(false);
  for (std::uint64_t begin = 0; begin < 50; ++begin) {
    for (const Move* move : Swarm("lane", without, begin).moves)
      EXPECT_NE(move->kind, MoveKind::view) << begin << " " << move->name;
  }
}

TEST_F(Swarms, AreDrawnByTheirNames) {
  const auto of_views = space(true);
  for (std::uint64_t begin = 0; begin < 20; ++begin) {
    const Swarm one("lane", of_views, begin), again("lane", of_views, begin);
    EXPECT_EQ(one.theme, again.theme);
    EXPECT_EQ(one.moves, again.moves);
    EXPECT_EQ(one.sources, again.sources);
    EXPECT_EQ(one.most_triangles, again.most_triangles);
    EXPECT_FALSE(one.moves.empty());
    EXPECT_GE(one.most_frames, 2);
  }
  std::vector<Theme> here, elsewhere;
  for (std::uint64_t begin = 1; begin < 20; ++begin) {
    here.push_back(Swarm("lane", of_views, begin).theme);
    elsewhere.push_back(Swarm("other", of_views, begin).theme);
  }
  EXPECT_NE(here, elsewhere);
}

}  // namespace
}  // namespace assay::properties
