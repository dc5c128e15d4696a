#include "properties/campaign/clean_starts.h"

#include <gtest/gtest.h>

namespace assay::properties {
namespace {

corpus::Case curated(const std::string& name) {
  return corpus::read_case(ASSAY_SOURCE_DIR "/corpus/curated/" + name + ".json").value();
}

TEST(CleanStarts, OfSimpleBodiesInContactLaterOrNever) {
  EXPECT_TRUE(starts_clean(curated("C1_lost_plus_plus")));
  EXPECT_TRUE(starts_clean(curated("C3_skip_adjacent")));
  // Layers count the own component.
  EXPECT_TRUE(starts_clean(curated("A2_nested_outward")));
}

TEST(CleanStarts, NotOfIntersectingOrDoublyWrappedOnes) {
  EXPECT_FALSE(starts_clean(curated("C5_start_intersecting")));
  EXPECT_FALSE(starts_clean(curated("A1_winding2_allpositive")));
}

TEST(CleanStarts, NotOfUnclosedMeshes) {
  EXPECT_FALSE(starts_clean(curated("D1_open_allplus")));
  EXPECT_FALSE(starts_clean(curated("A5_one_face_flipped")));
}

// Every new start counts: a step that begins elsewhere than the last commit ended.
TEST(CleanStarts, OfEveryNewStart) {
  corpus::Case c = curated("C1_lost_plus_plus");
  const detector::Positions clean = c.frames[0];
  detector::Positions folded = clean;
  folded.row(5) = folded.row(4);
  c.frames = {clean, clean, folded, folded};
  c.script = {{0, 1, true}, {1, 2, true}};
  EXPECT_TRUE(starts_clean(c));
  c.script = {{0, 1, true}, {3, 2, true}};
  EXPECT_FALSE(starts_clean(c));
  // The second one starts where the first ended, in another frame of the same places.
  c.script = {{0, 2, true}, {3, 3, true}};
  EXPECT_TRUE(starts_clean(c));
  // Not committed: the state is still that of no start.
  c.script = {{0, 2, false}, {3, 3, true}};
  EXPECT_FALSE(starts_clean(c));
}

TEST(CleanStarts, OnlyVerifiedOnesAreVouchedFor) {
  using detector::Culling, detector::Start;
  const auto changed = with_clean_start(
      {{"a", {Culling::bvh, Start::verified}}, {"b", {Culling::bvh, Start::unknown}}});
  EXPECT_EQ(changed[0].options.start, Start::clean);
  EXPECT_EQ(changed[1].options.start, Start::unknown);
}

}  // namespace
}  // namespace assay::properties
