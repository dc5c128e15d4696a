#include "corpus/scenes/scenes.h"

#include <Eigen/Geometry>

#include "corpus/scenes/shapes.h"
#include "tests/problem_words.h"

namespace assay::corpus {
namespace {

using Vector = Eigen::RowVector3d;

// The three corners of a triangle.
std::array<Vector, 3> corners(const detector::Positions& x, const detector::Triangles& triangles,
                              Eigen::Index t) {
  return {x.row(triangles(t, 0)), x.row(triangles(t, 1)), x.row(triangles(t, 2))};
}

struct Facts {
  int unmatched_edges = 0;
  int most_at_an_edge = 0;  // triangles
  double volume = 0;
  double least_sine = 1;  // of the angles, a measure of degenerate triangles
  bool repeats = false;
};

Facts facts_of(const detector::Positions& x, const detector::Triangles& triangles) {
  Facts facts;
  std::map<std::pair<int, int>, int> directed, undirected;
  for (Eigen::Index i = 0; i < triangles.rows(); ++i) {
    const auto p = corners(x, triangles, i);
    for (int k = 0; k < 3; ++k) {
      const int u = triangles(i, k), v = triangles(i, (k + 1) % 3);
      facts.repeats = facts.repeats || u == v;
      ++directed[{u, v}];
      --directed[{v, u}];
      ++undirected[{std::min(u, v), std::max(u, v)}];
    }
    facts.volume += p[0].dot(p[1].cross(p[2])) / 6;
    for (int k = 0; k < 3; ++k) {
      const Vector a = p[(k + 1) % 3] - p[k], b = p[(k + 2) % 3] - p[k];
      facts.least_sine = std::min(facts.least_sine, a.cross(b).norm() / (a.norm() * b.norm()));
    }
  }
  for (const auto& [edge, n] : directed) facts.unmatched_edges += n > 0 ? n : 0;
  for (const auto& [edge, n] : undirected)
    facts.most_at_an_edge = std::max(facts.most_at_an_edge, n);
  return facts;
}

TEST(Scenes, EverySceneAtSeveralSizes) {
  for (const SceneInfo& info : scenes()) {
    for (const int size : {1, 300, 2000, info.default_size}) {
      SCOPED_TRACE(std::string(info.name) + " " + std::to_string(size));
      const auto& [triangles, frames, unused] = value_of(make_scene(info.name, {size, 5, {}}));
      ASSERT_EQ(frames.size(), 5U);
      EXPECT_LT(triangles.maxCoeff(), frames[0].rows());
      const Facts facts = facts_of(frames[0], triangles);
      EXPECT_FALSE(facts.repeats);
      EXPECT_LE(facts.most_at_an_edge, 2);
      EXPECT_GT(facts.least_sine, 0.02);
      EXPECT_EQ(facts.unmatched_edges == 0, info.closed);
      EXPECT_TRUE(!info.closed || facts.volume > 0);
      EXPECT_TRUE(size < 300 || std::abs(triangles.rows() - size) <= 0.35 * size);
      EXPECT_TRUE(frames[0] != frames[2]) << "nothing moves";
    }
  }
}

TEST(Scenes, DefaultsAndDeterminism) {
  for (const SceneInfo& info : scenes()) {
    SCOPED_TRACE(info.name);
    const auto a = make_scene(info.name, {}), b = make_scene(info.name, {});
    ASSERT_TRUE(a && b);
    EXPECT_EQ(static_cast<int>(a.value().frames.size()), info.default_frames);
    EXPECT_NEAR(a.value().triangles.rows(), info.default_size, 0.15 * info.default_size);
    EXPECT_EQ(a.value().frames, b.value().frames);
    EXPECT_FALSE(info.about.empty());
    // The rest shape does not depend on the number of frames.
    const auto one = value_of(make_scene(info.name, {0, 1, {}}));
    ASSERT_EQ(one.frames.size(), 1U);
    EXPECT_EQ(one.frames[0], a.value().frames[0]);
  }
}

TEST(Scenes, BreathingSphereStaysPositiveFromItsCentre) {
  const auto scene = value_of(make_scene("breathing-sphere", {320, 21, {}}));
  for (const detector::Positions& x : scene.frames) {
    for (Eigen::Index i = 0; i < scene.triangles.rows(); ++i) {
      const auto p = corners(x, scene.triangles, i);
      EXPECT_GT(p[0].dot(p[1].cross(p[2])), 0);
    }
  }
}

TEST(Scenes, AUsersMeshIsDeformed) {
  const Mesh sheet = sheet_shape(200);
  for (const SceneInfo& info : scenes()) {
    SCOPED_TRACE(info.name);
    const auto scene = make_scene(info.name, {0, 3, sheet});
    ASSERT_EQ(scene.has_value(), info.takes_mesh);
    if (!scene) {
      EXPECT_TRUE(says(scene, "it takes no other mesh"));
      continue;
    }
    EXPECT_EQ(scene.value().triangles, sheet.triangles);
    EXPECT_EQ(scene.value().frames[0], sheet.positions);
    EXPECT_TRUE(scene.value().frames[2] != sheet.positions);
    EXPECT_TRUE(scene.value().frames[2].allFinite());
  }
}

TEST(Scenes, DeformationsFollowTheMeshToAnyPlaceAndScale) {
  Mesh tube = tube_shape(400, true);
  const auto here = make_scene("bend", {0, 3, tube});
  // A power of two and a shift that is exact: the same picture, moved.
  tube.positions *= 1024;
  const auto there = make_scene("bend", {0, 3, tube});
  ASSERT_TRUE(here && there);
  EXPECT_TRUE(there.value().frames[2].isApprox(1024 * here.value().frames[2], 1e-12));
}

TEST(Scenes, Problems) {
  const auto unknown = make_scene("nonsense", {});
  EXPECT_TRUE(says(unknown, "no scene is named nonsense; scenes: "));
  EXPECT_TRUE(says(unknown, "arm-in-box"));
  const auto expect = [](std::string_view words, const SceneOptions& options) {
    EXPECT_TRUE(says(make_scene("bend", options), words)) << words;
  };
  expect("triangles, not -1", {-1, 0, {}});
  expect("need more than 8 GB", {2'000'000'000, 0, {}});
  expect("frames, not -1", {0, -1, {}});
  expect("need more than 8 GB", {0, 1'000'000'000, {}});
  expect("the mesh has no triangle", {0, 0, Mesh{}});
  Mesh mesh = sheet_shape(2);
  mesh.triangles(0, 0) = 99;
  expect("an index out of range", {0, 0, mesh});
  mesh = sheet_shape(2);
  mesh.positions(0, 0) = std::nan("");
  expect("an index out of range", {0, 0, mesh});
  mesh = sheet_shape(2);
  mesh.positions *= 1.7e308;
  expect("too large to be deformed", {0, 3, mesh});
}

TEST(Scenes, PassagesEndWhereTheyBegan) {
  for (const char* name :
       {"arm-in-box", "ball-in-tube", "inverted-sleeve", "crossing-fans", "winding-spiral"}) {
    SCOPED_TRACE(name);
    const auto scene = value_of(make_scene(name, {400, 9, {}}));
    EXPECT_EQ(scene.frames.front(), scene.frames.back());
    EXPECT_TRUE(scene.frames.front() != scene.frames[4]);
  }
}

TEST(Scenes, SleeveIsInsideOutInTheMiddle) {
  const auto scene = value_of(make_scene("inverted-sleeve", {400, 3, {}}));
  // Seen from its axis the tube faces away; inside out it faces the axis.
  const auto facing = [&](const detector::Positions& x) {
    int outward = 0, inward = 0;
    for (Eigen::Index i = 0; i < scene.triangles.rows(); ++i) {
      const auto p = corners(x, scene.triangles, i);
      const Vector n = (p[1] - p[0]).cross(p[2] - p[0]);
      (p[0].head<2>().dot(n.head<2>()) > 0 ? outward : inward) += 1;
    }
    return std::pair(outward, inward);
  };
  const int all = static_cast<int>(scene.triangles.rows());
  EXPECT_EQ(facing(scene.frames[0]), std::pair(all, 0));
  EXPECT_EQ(facing(scene.frames[1]), std::pair(0, all));
}

TEST(Scenes, ArmStaysClearOfTheRim) {
  const BoxWithArm box(2000);
  const detector::Positions deep = box.with_tip(BoxWithArm::deepest_tip);
  EXPECT_EQ(box.with_tip(BoxWithArm::tip_outside), box.mesh.positions);
  int below_the_lid = 0;
  for (Eigen::Index v = 0; v < deep.rows(); ++v) {
    const bool moved = deep(v, 2) != box.mesh.positions(v, 2);
    if (moved && deep(v, 2) < 1) ++below_the_lid;
    if (moved) {
      EXPECT_LE(std::abs(deep(v, 0)), 0.1 + 1e-15);
      EXPECT_LE(std::abs(deep(v, 1)), 0.1 + 1e-15);
    }
  }
  EXPECT_GT(below_the_lid, 0);
}

TEST(Scenes, OwnSineAndCosine) {
  // The reference must round its argument far finer than the doubles compared.
  constexpr long double two_pi = 6.283185307179586476925286766559L;
  for (int i = -4000; i <= 4000; ++i) {
    const double x = i / 1000.0;
    EXPECT_NEAR(sin_turn(x), static_cast<double>(std::sin(two_pi * x)), 4e-16) << x;
    EXPECT_NEAR(cos_turn(x), static_cast<double>(std::cos(two_pi * x)), 4e-16) << x;
  }
  EXPECT_EQ(sin_turn(0), 0);
  EXPECT_EQ(sin_turn(0.25), 1);
  EXPECT_EQ(sin_turn(-0.25), -1);
  EXPECT_EQ(sin_turn(0.5), 0);
  EXPECT_EQ(cos_turn(0.25), 0);
  EXPECT_EQ(cos_turn(0.5), -1);
  EXPECT_EQ(sin_turn(1e6), 0);
}

TEST(Scenes, NearestResolution) {
  const auto squares = [](int n) { return n * n; };
  EXPECT_EQ(nearest_resolution(1, 2, squares), 2);
  EXPECT_EQ(nearest_resolution(16, 2, squares), 4);
  EXPECT_EQ(nearest_resolution(20, 2, squares), 4);
  EXPECT_EQ(nearest_resolution(21, 2, squares), 5);
}

}  // namespace
}  // namespace assay::corpus
