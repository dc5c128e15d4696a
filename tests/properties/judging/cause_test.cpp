#include "properties/judging/cause.h"

#include "oracle/mesh/step.h"
#include "tests/meshes.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

// A vertex of the second triangle falls on the first.
struct Fall {
  detector::Triangles triangles = tests::triangles({{0, 1, 2}, {3, 4, 5}});
  detector::Positions x_t0 = tests::positions_of("0 0 0, 4 0 0, 0 4 0, 1 1 1, 2 1 3, 1 2 3"),
                      x_t1 = x_t0;

  Fall() { x_t1(3, 2) = -1; }

  // The cause behind a contact, or behind a pair that does not meet.
  template <class... Asked>
  std::string cause_behind(const Asked&... asked) const {
    return cause_of(triangles, {x_t0, x_t1}, asked...);
  }
  std::string cause() const {
    const auto judged = oracle::judge_step({x_t0, x_t1}, triangles, {});
    return judged.pairs.size() == 1 ? cause_behind(judged.pairs[0]) : "none";
  }
};

TEST(Cause, SaysWhatIsSpecial) {
  EXPECT_EQ(Fall().cause(), "t inside, moving, generic");
  Fall at_1;
  at_1.x_t1(3, 2) = 0;
  EXPECT_EQ(at_1.cause(), "t at 1, moving, generic");
  at_1.x_t0.col(2).array() += 1;
  at_1.x_t1.col(2).array() += 1;
  at_1.x_t1(3, 2) = 1 - 0x1p-50;
  EXPECT_EQ(at_1.cause(), "t at 1, moving, generic") << "some units beyond";
  const auto cause_after = [](const auto& change) {
    Fall fall;
    change(fall);
    return fall.cause();
  };
  EXPECT_EQ(cause_after([](Fall& f) { f.x_t0(3, 2) = 0; }), "t at 0, moving, generic");
  EXPECT_EQ(cause_after([](Fall& f) { f.x_t0(3, 2) = f.x_t1(3, 2) = 0; }),
            "t at 0, at rest, generic");
  EXPECT_EQ(cause_after([](Fall& f) {
              f.x_t0 *= 0x1p50;
              f.x_t1 *= 0x1p50;
            }),
            "t inside, moving, generic, huge numbers");
  EXPECT_EQ(cause_after([](Fall& f) { f.x_t1(5, 0) = 1e-200; }),
            "t inside, moving, generic, tiny numbers");
  EXPECT_EQ(cause_after([](Fall& f) { f.x_t1.row(5) = f.x_t1.row(4); }),
            "t inside, moving, without area");
  EXPECT_EQ(cause_after([](Fall& f) { f.x_t0(3, 1) = f.x_t1(3, 1) = 0; }),
            "t inside, moving, at the end of a feature");
}

TEST(Cause, NeighboursSayWhatTheyShare) {
  Fall one;
  one.triangles(1, 1) = 1;  // a vertex of the first triangle
  one.x_t0.row(5) << 4, 1, 3;
  one.x_t1.row(5) = one.x_t0.row(5);
  EXPECT_EQ(one.cause(), "t inside, moving, generic, sharing a vertex");
  Fall two;
  two.triangles.row(1) << 3, 1, 2;
  EXPECT_EQ(two.cause(), "t inside, moving, generic, sharing an edge");
}

// The threshold is 1e-5 of the extent, 4 here, by exact distances: 4e-5 is no double.
TEST(Cause, AStartThatIsNearIsACauseOfItsOwn) {
  const double threshold = 4e-5;
  for (const double scale : {0x1p-1000, 1., 0x1p30}) {
    Fall near, apart;
    near.x_t0(3, 2) = std::nextafter(threshold, 0);
    apart.x_t0(3, 2) = std::nextafter(threshold, 1);
    // The fall goes on long enough that its time is not near 0.
    near.x_t1(3, 2) = -near.x_t0(3, 2);
    apart.x_t1(3, 2) = -apart.x_t0(3, 2);
    for (Fall* fall : {&near, &apart}) {
      fall->x_t0 *= scale;
      fall->x_t1 *= scale;
    }
    EXPECT_NE(near.cause().find("moving, generic, near contact at the start"), std::string::npos);
    EXPECT_EQ(apart.cause().find("near contact"), std::string::npos) << scale;
  }
  Fall huge;
  huge.x_t0 *= 0x1p1020;
  huge.x_t1 *= 0x1p1020;
  EXPECT_EQ(huge.cause(), "t inside, moving, generic, huge numbers");
  // Who starts in contact is not near it.
  Fall at_0;
  at_0.x_t0(3, 2) = 0;
  EXPECT_EQ(at_0.cause(), "t at 0, moving, generic");
}

// A far vertex: 1e-5 of the mesh's extent is more than the two triangles are apart.
TEST(Cause, TheExtentIsThatOfTheWholeMesh) {
  Fall fall;
  fall.x_t0.conservativeResize(7, 3);
  fall.x_t0.row(6) << 0, 0, 3e5;
  fall.x_t1.conservativeResize(7, 3);
  fall.x_t1.row(6) = fall.x_t0.row(6);
  EXPECT_EQ(fall.cause(), "t inside, moving, generic, near contact at the start");
}

TEST(Cause, OfAQueryItsFeaturesAloneAreNear) {
  Fall fall;  // the second triangle rests in the first one, but the vertex asked is above it
  const detector::PairContact contact{
      {0, 1}, {0.5, 0.5}, {detector::FeatureKind::vertex_face, {3, 0, 1, 2, -1}}};
  fall.x_t0(4, 2) = fall.x_t1(4, 2) = 0;
  EXPECT_EQ(fall.cause_behind(contact, false, true), "t inside, moving, generic");
  EXPECT_EQ(fall.cause_behind(contact), "t inside, moving, generic, near contact at the start");
  fall.x_t0(3, 2) = 1e-6;
  EXPECT_EQ(fall.cause_behind(contact, false, true),
            "t inside, moving, generic, near contact at the start");
}

// The two triangles share a vertex, and the features asked never meet.
TEST(Cause, OfAQueryThatStaysApartNothingIsShared) {
  Fall one;
  one.triangles(1, 1) = 1;
  one.x_t1 = one.x_t0;
  const detector::Feature features{detector::FeatureKind::vertex_face, {3, 0, 1, 2, -1}};
  EXPECT_EQ(one.cause_behind(detector::TrianglePair{0, 1}, false, std::optional(features)),
            "at rest");
  EXPECT_EQ(one.cause_behind(detector::TrianglePair{0, 1}), "at rest, sharing a vertex");
}

TEST(Cause, AContactSoonAfterTheStartIsOneOfItsOwn) {
  Fall soon;
  soon.x_t1(3, 2) = -2000;
  EXPECT_EQ(soon.cause(), "t near 0, moving, generic");
}

TEST(Cause, OfAPairThatDoesNotMeet) {
  EXPECT_EQ(Fall().cause_behind(detector::TrianglePair{0, 1}), "moving");
}

TEST(Cause, OfADistanceSaysWhereTheNearestPointsLie) {
  Fall fall;
  const auto cause_at = [&](double x, double y) {
    for (auto* at : {&fall.x_t0, &fall.x_t1}) at->row(3).head(2) << x, y;
    const detector::PairContact contact{
        {0, 1}, {0.25, 0.25}, {detector::FeatureKind::vertex_face, {3, 0, 1, 2, -1}}};
    return fall.cause_behind(contact, true);
  };
  const auto& corner = fall.x_t0;
  const auto middle = [&](int axis) {
    return (corner(0, axis) + corner(1, axis) + corner(2, axis)) / 3;
  };
  EXPECT_EQ(cause_at(middle(0), middle(1)), "t inside, moving, distance to a face");
  EXPECT_EQ(cause_at(corner(0, 0) - 1, corner(0, 1) - 1),
            "t inside, moving, distance of two vertices");
  EXPECT_EQ(fall.cause_behind(detector::TrianglePair{0, 1}, true), "moving, beyond the distance");
}

TEST(Cause, TheMostOrdinaryIsTheLeastOdd) {
  const char* ascending[] = {
      "free-sound: answered free, vertex-face, t inside, moving, generic",
      "free-sound: answered free, vertex-face, t at 1, moving, generic",
      "free-sound: answered free, vertex-face, t inside, moving, coplanar throughout",
      "free-sound: answered free, vertex-face, t inside, moving, without area",
      "free-sound: answered free, vertex-face, t at 0, at rest, generic",
      "free-sound: answered free, vertex-face, t inside, moving, generic, sharing a vertex",
      "free-sound: answered free, vertex-face, t inside, moving, generic, sharing an edge",
      "free-sound: answered free, vertex-face, t at 0, moving, generic, sharing an edge",
      "free-sound: answered free, vertex-face, t inside, moving, generic, near contact at the "
      "start",
      "free-sound: answered free, vertex-face, t inside, moving, generic, tiny numbers",
      "free-sound: answered free, vertex-face, t inside, moving, generic, huge numbers",
  };
  for (std::size_t i = 1; i < std::size(ascending); ++i)
    EXPECT_LT(oddity_of(ascending[i - 1]), oddity_of(ascending[i])) << ascending[i];
  EXPECT_EQ(oddity_of("all-pairs: missing pair at view sets, vertex-face"), 0);
}

}  // namespace
}  // namespace assay::properties
