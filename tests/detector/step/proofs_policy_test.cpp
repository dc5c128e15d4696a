// Culling auto proves patches apart (L14) where counts say that it pays, and nowhere else.
#include "detector/detector.h"
#include "detector/step/culling_policy.h"
#include "detector/traditional/traditional.h"
#include "tests/detector/contact/same_contacts.h"
#include "tests/detector/points.h"
#include "tests/detector/view/revolved.h"

namespace assay::detector {
namespace {

using tests::revolved, tests::sphere, tests::sphere_rings;

// Squares of unit size, in two triangles each.
struct Sheet {
  explicit Sheet(int squares) : triangles(2 * squares * squares, 3), flat(side(squares), 3) {
    Eigen::Index row = 0;
    for (int i = 0; i <= squares; ++i) {
      for (int j = 0; j <= squares; ++j) {
        const int v = i * (squares + 1) + j;
        flat.row(v) << i, j, 0;
        if (i == squares || j == squares) continue;
        triangles.row(row++) << v, v + squares + 1, v + squares + 2;
        triangles.row(row++) << v, v + squares + 2, v + 1;
      }
    }
  }
  static Eigen::Index side(int squares) {
    return static_cast<Eigen::Index>(squares + 1) * (squares + 1);
  }
  // Each vertex somewhere else: neighbours face all ways.
  Positions crumpled() const {
    Positions x = flat;
    for (Eigen::Index v = 0; v < x.rows(); ++v)
      for (int k = 0; k < 3; ++k)
        x(v, k) += std::fmod(41.3 * (double(v) + 1) * (double(v) + 7 * k), 2.);
    return x;
  }
  Triangles triangles;
  Positions flat;
};

StepResult step(const Triangles& triangles, const Positions& x_t0, const Positions& x_t1,
                Culling culling = Culling::automatic, Start start = Start::clean) {
  return Detector::create(triangles, x_t0, {culling, start}).value().step(x_t0, x_t1);
}

TEST(ProofsPolicy, L14_AFlatSheetIsProvedFreeAtOnce) {
  const Sheet sheet(30);
  const Positions lifted = sheet.flat.rowwise() + Eigen::RowVector3d(0, 0, 1);
  const auto result = step(sheet.triangles, sheet.flat, lifted);
  EXPECT_EQ(result.counts.search.contour_tests, 1u);
  EXPECT_EQ(result.counts.search.candidate_pairs, 0u);
}

TEST(ProofsPolicy, L14_ACrumpledSheetIsNotAskedForProofs) {
  const Sheet sheet(30);
  const Positions x = sheet.crumpled(), moved = x.rowwise() + Eigen::RowVector3d(0, 0, 1);
  const auto result = step(sheet.triangles, x, moved, Culling::automatic, Start::unknown),
             bvh = step(sheet.triangles, x, moved, Culling::bvh, Start::unknown);
  EXPECT_EQ(result.counts.search.contour_tests, 0u);
  EXPECT_EQ(result.counts.search.candidate_pairs, bvh.counts.search.candidate_pairs);
  tests::expect_same_contacts(result, bvh);
}

TEST(ProofsPolicy, WhereAllComponentsAreFreeNothingIsProved) {
  Triangles one = revolved(sphere_rings), two(2 * one.rows(), 3);
  const Positions x = sphere(1);
  two << one, one.array() + static_cast<std::int32_t>(x.rows());
  const auto both = [&](double shift) {
    Positions apart(2 * x.rows(), 3);
    apart << x, x.rowwise() + Eigen::RowVector3d(shift, 0, 0);
    return apart;
  };
  const auto result = step(two, both(5), both(4));
  EXPECT_EQ(result.counts.free_components, 2u);
  EXPECT_EQ(result.counts.search.contour_tests, 0u);
}

// Two triangles are neighbours in one place at most: their proof would leave out one candidate.
TEST(ProofsPolicy, PatchesOfFewerThanFourTrianglesAreNotAskedFor) {
  Triangles strip(2, 3);
  strip << 0, 1, 2, 1, 3, 2;
  Positions x(4, 3);
  x << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0;
  const NormalConeSearch all, few(NormalConeSearch::Asked::of_four_triangles_or_more);
  const Topology mesh = make_topology(strip, 4);
  BoundingVolumeTree tree(mesh, x);
  const Marks marks(tree);
  const PairTables tables = EveryPair().candidates();
  const SteppedMesh motion = {x, x};
  for (const auto* search : {&all, &few}) {
    PacedStop never(never_stops);
    const auto of_mesh = search->prepare(mesh, tree, never);
    of_mesh->fit(tree, mesh, motion, never);
    SearchCounts counts;
    of_mesh->search({mesh, tree, marks, tables, &never}, counts,
                    [](std::int32_t, std::int32_t) { return true; });
    EXPECT_EQ(counts.contour_tests, search == &all ? 1u : 0u);
    EXPECT_EQ(counts.candidate_pairs, search == &all ? 0u : 1u);
  }
}

TEST(ProofsPolicy, WhatIsHopedForIsHeldAgainstTheCostOfCones) {
  const Sheet sheet(10);
  const Surface surface = make_surface(sheet.triangles, sheet.flat.rows());
  const std::uint64_t adjacent = adjacent_pairs(surface.mesh);
  const std::size_t triangles = surface.mesh.triangles.size();
  CostModel policy(surface, adjacent, {});
  EXPECT_TRUE(policy.worth_proving({1, 1, 1}, 1, triangles));
  EXPECT_TRUE(policy.worth_proving({1, 1, .75}, 1, triangles));
  EXPECT_FALSE(policy.worth_proving({1, .75, .5}, 1, triangles))
      << "proofs for small ones cost more";
  EXPECT_FALSE(policy.worth_proving({1, 1, 0}, 1, triangles)) << "no large patch is free";
  EXPECT_FALSE(policy.worth_proving({.4, 1, 1}, 1, triangles)) << "few patches are free";
  EXPECT_FALSE(policy.worth_proving({.7, 0, 0}, 1, triangles)) << "only small patches are free";
  EXPECT_FALSE(policy.worth_proving({1, 1, 1}, .05, triangles)) << "few neighbours are asked for";
  EXPECT_FALSE(policy.worth_proving({1, 1, 1}, 1, 2 * adjacent))
      << "cones cost more than they save";
}

}  // namespace
}  // namespace assay::detector
