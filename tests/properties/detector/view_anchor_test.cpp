// How good the detector's own view primitives are, on scenes and on a real mesh at rest.
#include "detector/view/view_anchor.h"

#include "corpus/scenes/scenes.h"
#include "detector/detector.h"
#include "detector/geometry/winding.h"
#include "detector/view/view_signs.h"
#include "tests/public_data.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using namespace detector;

struct Share {
  double positive = 0, negative = 0;
};

// Of the triangles of the mesh (and its ghosts) standing still at x.
Share share_of(const Topology& mesh, const Component& component, const Positions& x,
               const ViewPrimitive& primitive) {
  std::vector<ViewSign> signs(mesh.triangles.size());
  ViewCounts counts;
  classify(mesh, component, {x, x}, primitive, signs, counts);
  Share share;
  for (const auto t : component.triangles) {
    share.positive += signs[static_cast<std::size_t>(t)] == ViewSign::positive;
    share.negative += signs[static_cast<std::size_t>(t)] == ViewSign::negative;
  }
  const auto count = static_cast<double>(component.triangles.size());
  return {share.positive / count, share.negative / count};
}

double best_of_samples(const Topology& mesh, const Component& component, const Positions& x) {
  std::mt19937_64 engine(20111);
  const Eigen::RowVector3d lo = x.colwise().minCoeff(), hi = x.colwise().maxCoeff();
  double best = 0;
  for (int i = 0; i < 1000; ++i) {
    MovingPoint q;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      q.t0[k] = q.t1[k] = std::uniform_real_distribution<double>(lo[axis], hi[axis])(engine);
    }
    best = std::max(best, share_of(mesh, component, x, {q, q}).positive);
  }
  return best;
}

struct Judged {
  Share point, line;
  double sampled = 0;
  std::optional<int> winding;
};

Judged judge(const Triangles& triangles, const Positions& x, const char* name) {
  const Topology mesh = make_topology(triangles, x.rows());
  Judged judged;
  for (const auto& component : mesh.components) {
    const auto point = make_view_anchor(ViewKind::point, mesh, component, x.rows(), x);
    const auto line = make_view_anchor(ViewKind::line, mesh, component, x.rows(), x);
    const ViewPrimitive at_point = place_view(point, {x, x});
    judged.point = share_of(mesh, component, x, at_point);
    judged.line = share_of(mesh, component, x, place_view(line, {x, x}));
    judged.sampled = best_of_samples(mesh, component, x);
    if (component.is_cycle) {
      judged.winding = winding_number(mesh, component.triangles, x, at_point.q0.t0);
    }
    std::printf(
        "%-18s %6zu triangles; point V+ %.3f V- %.3f, best V+ of 1,000 sampled %.3f, winding "
        "%s; line V+ %.3f V- %.3f settled %.3f\n",
        name, component.triangles.size(), judged.point.positive, judged.point.negative,
        judged.sampled, judged.winding ? std::to_string(*judged.winding).c_str() : "-",
        judged.line.positive, judged.line.negative, judged.line.positive + judged.line.negative);
    // All but a few negative serves as well (L4).
    EXPECT_GE(std::max(judged.point.positive, judged.point.negative), judged.sampled - 0.05)
        << name;
  }
  return judged;
}

TEST(ViewAnchor, PointIsNearlyTheBestOfAThousandOnEveryScene) {
  for (const auto& info : corpus::scenes()) {
    auto scene = corpus::make_scene(info.name, {});
    ASSERT_TRUE(scene);
    const auto& frames = scene.value().frames;
    for (const std::size_t f : {std::size_t{0}, frames.size() / 2, frames.size() - 1}) {
      const Judged judged = judge(scene.value().triangles, frames[f], info.name.data());
      if (f == 0 && info.closed) {
        EXPECT_EQ(judged.winding, 1) << info.name << ": an embedded solid has an inside";
      }
    }
  }
}

// In contact with themselves, both are seen best from where the solid covers space twice.
TEST(ViewAnchor, IsInsideOnceWhereThatCostsLittle) {
  for (const char* name : {"bend", "crumpling-sphere"}) {
    auto scene = corpus::make_scene(name, {});
    ASSERT_TRUE(scene);
    const auto& x = scene.value().frames.back();
    EXPECT_EQ(judge(scene.value().triangles, x, name).winding, 1) << name;
  }
}

TEST(ViewAnchor, L1_LineSettlesTubes) {
  for (const char* name : {"bend", "twist"}) {
    auto scene = corpus::make_scene(name, {});
    ASSERT_TRUE(scene);
    const Judged judged = judge(scene.value().triangles, scene.value().frames[0], name);
    EXPECT_GE(judged.line.positive + judged.line.negative, 0.95);
  }
}

TEST(ViewAnchor, PublicBunny) {
  const char* data = tests::public_data();
  if (!data) GTEST_SKIP() << "no public data";
  auto bunny = corpus::read_mesh(std::string(data) + "/ipc-toolkit/bunny.ply");
  if (!bunny) GTEST_SKIP() << "no bunny in it";
  const auto& mesh = bunny.value();
  const Judged judged = judge(mesh.triangles, mesh.positions, "bunny");
  EXPECT_GE(judged.point.positive, 0.89);
  EXPECT_GE(judged.line.positive, 0.94);
}

}  // namespace
}  // namespace assay::properties
