#include "properties/judging/cause.h"

#include <gtest/gtest.h>

#include "oracle/mesh/step.h"

namespace assay::properties {
namespace {

// A vertex of the second triangle falls on the first.
struct Fall {
  detector::Triangles triangles{2, 3};
  detector::Positions x_t0{6, 3}, x_t1{6, 3};

  Fall() {
    triangles << 0, 1, 2, 3, 4, 5;
    x_t0 << 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 1, 2, 1, 3, 1, 2, 3;
    x_t1 = x_t0;
    x_t1(3, 2) = -1;
  }

  std::string cause() const {
    const auto judged = oracle::judge_step({x_t0, x_t1}, triangles, {});
    if (judged.pairs.size() != 1) return "none";
    return text_of(cause_of(triangles, {x_t0, x_t1}, judged.pairs[0]));
  }
};

TEST(Cause, SaysWhatIsSpecial) {
  EXPECT_EQ(Fall().cause(), "t inside, moving, generic");
  Fall at_1;
  at_1.x_t1(3, 2) = 0;
  EXPECT_EQ(at_1.cause(), "t at 1, moving, generic");
  Fall at_0;
  at_0.x_t0(3, 2) = 0;
  EXPECT_EQ(at_0.cause(), "t at 0, moving, generic");
  Fall rests;
  rests.x_t0(3, 2) = rests.x_t1(3, 2) = 0;
  EXPECT_EQ(rests.cause(), "t at 0, at rest, generic");
  Fall huge;
  huge.x_t0 *= 0x1p50;
  huge.x_t1 *= 0x1p50;
  EXPECT_EQ(huge.cause(), "t inside, moving, generic, huge numbers");
  Fall tiny;
  tiny.x_t1(5, 0) = 1e-200;
  EXPECT_EQ(tiny.cause(), "t inside, moving, generic, tiny numbers");
  Fall flat;
  flat.x_t1.row(5) = flat.x_t1.row(4);
  EXPECT_EQ(flat.cause(), "t inside, moving, without area");
  Fall at_edge;
  at_edge.x_t0(3, 1) = at_edge.x_t1(3, 1) = 0;
  EXPECT_EQ(at_edge.cause(), "t inside, moving, at the end of a feature");
}

TEST(Cause, OfAPairThatDoesNotMeet) {
  const Fall fall;
  EXPECT_EQ(text_of(cause_of(fall.triangles, {fall.x_t0, fall.x_t1}, detector::TrianglePair{0, 1})),
            "moving");
}

TEST(Cause, TheMostOrdinaryIsTheLeastOdd) {
  const char* ascending[] = {
      "free-sound: answered free, vertex-face, t inside, moving, generic",
      "free-sound: answered free, vertex-face, t at 1, moving, generic",
      "free-sound: answered free, vertex-face, t inside, moving, coplanar throughout",
      "free-sound: answered free, vertex-face, t inside, moving, without area",
      "free-sound: answered free, vertex-face, t at 0, at rest, generic",
      "free-sound: answered free, vertex-face, t inside, moving, generic, tiny numbers",
      "free-sound: answered free, vertex-face, t inside, moving, generic, huge numbers",
  };
  for (std::size_t i = 1; i < std::size(ascending); ++i)
    EXPECT_LT(oddity_of(ascending[i - 1]), oddity_of(ascending[i])) << ascending[i];
  EXPECT_EQ(oddity_of("all-pairs: missing pair at view sets, vertex-face"), 0);
}

}  // namespace
}  // namespace assay::properties
