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

  void scale(double by) {
    x_t0 *= by;
    x_t1 *= by;
  }

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
  using Change = void (*)(Fall&);
  const std::pair<const char*, Change> causes[] = {
      {"t inside, moving, generic", [](Fall&) {}},
      {"t at 1, moving, generic", [](Fall& f) { f.x_t1(3, 2) = 0; }},
      // Some units beyond.
      {"t at 1, moving, generic",
       [](Fall& f) {
         for (auto* x : {&f.x_t0, &f.x_t1}) x->col(2).array() += 1;
         f.x_t1(3, 2) = 1 - 0x1p-50;
       }},
      {"t near 0, moving, generic", [](Fall& f) { f.x_t1(3, 2) = -2000; }},
      // Who starts in contact is not near it.
      {"t at 0, moving, generic", [](Fall& f) { f.x_t0(3, 2) = 0; }},
      {"t at 0, at rest, generic", [](Fall& f) { f.x_t0(3, 2) = f.x_t1(3, 2) = 0; }},
      {"t inside, moving, generic, huge numbers", [](Fall& f) { f.scale(0x1p50); }},
      {"t inside, moving, generic, huge numbers", [](Fall& f) { f.scale(0x1p1020); }},
      {"t inside, moving, generic, tiny numbers", [](Fall& f) { f.x_t1(5, 0) = 1e-200; }},
      {"t inside, moving, without area", [](Fall& f) { f.x_t1.row(5) = f.x_t1.row(4); }},
      {"t inside, moving, at the end of a feature",
       [](Fall& f) { f.x_t0(3, 1) = f.x_t1(3, 1) = 0; }},
      {"t inside, moving, generic, sharing a vertex",
       [](Fall& f) {
         f.triangles(1, 1) = 1;
         for (auto* x : {&f.x_t0, &f.x_t1}) x->row(5) << 4, 1, 3;
       }},
      {"t inside, moving, generic, sharing an edge",
       [](Fall& f) { f.triangles.row(1) << 3, 1, 2; }},
      // A far vertex: 1e-5 of the mesh's extent is more than the two triangles are apart.
      {"t inside, moving, generic, near contact at the start", [](Fall& f) {
         for (auto* x : {&f.x_t0, &f.x_t1}) {
           x->conservativeResize(7, 3);
           x->row(6) << 0, 0, 3e5;
         }
       }}};
  for (const auto& [cause, change] : causes) {
    Fall fall;
    change(fall);
    EXPECT_EQ(fall.cause(), cause);
  }
  EXPECT_EQ(Fall().cause_behind(detector::TrianglePair{0, 1}), "moving") << "it does not meet";
}

// The threshold is 1e-5 of the extent, 4 here, by exact distances: 4e-5 is no double.
TEST(Cause, AStartThatIsNearIsACauseOfItsOwn) {
  const double threshold = 4e-5;
  for (const double scale : {0x1p-1000, 1., 0x1p30}) {
    Fall near, apart;
    near.x_t0(3, 2) = std::nextafter(threshold, 0);
    apart.x_t0(3, 2) = std::nextafter(threshold, 1);
    // The fall goes on long enough that its time is not near 0.
    for (Fall* fall : {&near, &apart}) {
      fall->x_t1(3, 2) = -fall->x_t0(3, 2);
      fall->scale(scale);
    }
    EXPECT_TRUE(says(near.cause(), "moving, generic, near contact at the start"));
    EXPECT_FALSE(says(apart.cause(), "near contact")) << scale;
  }
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

TEST(Cause, OfADistanceSaysWhereTheNearestPointsLie) {
  Fall fall;
  const auto cause_at = [&](double x, double y) {
    for (auto* at : {&fall.x_t0, &fall.x_t1}) at->row(3).head(2) << x, y;
    const detector::PairContact contact{
        {0, 1}, {0.25, 0.25}, {detector::FeatureKind::vertex_face, {3, 0, 1, 2, -1}}};
    return fall.cause_behind(contact, true);
  };
  EXPECT_EQ(cause_at(1.5, 1.5), "t inside, moving, distance to a face");
  EXPECT_EQ(cause_at(-1, -1), "t inside, moving, distance of two vertices");
  EXPECT_EQ(fall.cause_behind(detector::TrianglePair{0, 1}, true), "moving, beyond the distance");
}

TEST(Cause, TheMostOrdinaryIsTheLeastOdd) {
  const char* ascending[] = {"t inside, moving, generic",
                             "t at 1, moving, generic",
                             "t inside, moving, coplanar throughout",
                             "t inside, moving, without area",
                             "t at 0, at rest, generic",
                             "t inside, moving, generic, sharing a vertex",
                             "t inside, moving, generic, sharing an edge",
                             "t at 0, moving, generic, sharing an edge",
                             "t inside, moving, generic, near contact at the start",
                             "t inside, moving, generic, tiny numbers",
                             "t inside, moving, generic, huge numbers"};
  int last = -1;
  for (const std::string cause : ascending) {
    const auto oddity = oddity_of("free-sound: answered free, vertex-face, " + cause);
    EXPECT_LT(std::exchange(last, oddity), oddity) << cause;
  }
  EXPECT_EQ(oddity_of("all-pairs: missing pair at view sets, vertex-face"), 0);
}

}  // namespace
}  // namespace assay::properties
