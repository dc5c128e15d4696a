// What the thesis says of costs, where it can be counted: box tests, candidates, marked nodes, and
// what the view test leaves open. What can only be timed is a micro bench (tests/bench).
#include "corpus/scenes/scenes.h"
#include "detector/assembly.h"
#include "oracle/view/view_sign.h"
#include "properties/random.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using namespace detector;

corpus::Sequence scene_of(const std::string& name, int triangles, int frames) {
  return corpus::make_scene(name, {triangles, frames, {}}).value();
}

constexpr const char* searching_scenes[] = {"dented-sphere", "crumpling-sphere", "bend"};

struct Played {
  SearchCounts counts;
  MarkingCounts marking;
  std::size_t pairs = 0;
};

// The whole scene, from a clean start. The search descends the tree of pairs, as the thesis does.
Played played(const corpus::Sequence& scene, const Options& options,
              TreeSearch::Skipping skipping = TreeSearch::Skipping::on) {
  auto stages = standard_stages(options);
  stages.pair_search = std::make_shared<TreeSearch>(skipping);
  auto detector = assemble(scene.triangles, scene.frames[0], options, stages).value();
  Played out;
  for (std::size_t f = 0; f + 1 < scene.frames.size(); ++f) {
    const auto result = detector.step(scene.frames[f], scene.frames[f + 1]);
    out.counts += result.counts.search;
    out.marking.changed += result.counts.marking.changed;
    out.marking.marked += result.counts.marking.marked;
    out.marking.cleared += result.counts.marking.cleared;
    out.pairs += result.pairs.size();
  }
  return out;
}

Options clean(Culling culling, Arithmetic arithmetic = Arithmetic::exact) {
  return {culling, Start::clean, Pairs::all, arithmetic};
}

TEST(ThesisCosts, PartialTreesNeedFewerBoxTestsThanTheWholeTree) {
  for (const std::string name : searching_scenes) {
    const auto scene = scene_of(name, 2'000, 11);
    const auto whole = played(scene, clean(Culling::bvh));
    for (const auto culling : {Culling::view_point, Culling::view_line}) {
      const auto partial = played(scene, clean(culling), TreeSearch::Skipping::off);
      std::printf("%-16s %-10s %.3f of bvh's %llu box tests, %.3f of its candidates\n",
                  name.c_str(), name_of(culling),
                  static_cast<double>(partial.counts.box_tests) /
                      static_cast<double>(whole.counts.box_tests),
                  static_cast<unsigned long long>(whole.counts.box_tests),
                  static_cast<double>(partial.counts.candidate_pairs) /
                      static_cast<double>(whole.counts.candidate_pairs));
      EXPECT_LT(partial.counts.box_tests, whole.counts.box_tests) << name;
      EXPECT_LT(partial.counts.candidate_pairs, whole.counts.candidate_pairs) << name;
      EXPECT_GT(partial.pairs, 0u) << name;
      EXPECT_EQ(partial.pairs, whole.pairs) << name;
    }
  }
}

TEST(ThesisCosts, PassingOverNodesOfOneChildSavesBoxTests) {
  for (const std::string name : searching_scenes) {
    const auto scene = scene_of(name, 2'000, 11);
    const auto options = clean(Culling::view_point);
    const auto with = played(scene, options),
               without = played(scene, options, TreeSearch::Skipping::off);
    std::printf(
        "%-16s %.3f of the box tests, %llu nodes passed over\n", name.c_str(),
        static_cast<double>(with.counts.box_tests) / static_cast<double>(without.counts.box_tests),
        static_cast<unsigned long long>(with.counts.skipped));
    EXPECT_GT(with.counts.skipped, 0u) << name;
    EXPECT_LT(with.counts.box_tests, without.counts.box_tests) << name;
    EXPECT_EQ(with.pairs, without.pairs) << name;
  }
}

TEST(ThesisCosts, MarkingTouchesFewNodesForATriangleThatChanges) {
  for (const std::string name : {"dented-sphere", "crumpling-sphere"}) {
    const auto marked = played(scene_of(name, 2'000, 41), clean(Culling::view_point)).marking;
    const double touched =
        static_cast<double>(marked.marked + marked.cleared) / static_cast<double>(marked.changed);
    std::printf("%-16s %.2f nodes for each of %llu changes\n", name.c_str(), touched,
                static_cast<unsigned long long>(marked.changed));
    EXPECT_GT(marked.changed, 100u) << name;
    constexpr double depth = 11;  // of a balanced tree of 2,000 leaves
    EXPECT_LT(touched, depth / 2) << name;
  }
}

// Moves every coordinate a little on its own, so that nothing is degenerate.
corpus::Sequence generic(corpus::Sequence scene) {
  Random random(20112, 0);
  for (auto& frame : scene.frames) {
    const double size = 1e-4 * (frame.colwise().maxCoeff() - frame.colwise().minCoeff()).norm();
    for (double& c : frame.reshaped()) c += size * random.signed_unit();
  }
  return scene;
}

TEST(ViewSets, WhatIsLeftOpenIsHardlyMoreThanTheOracleLeaves) {
  for (const auto culling : {Culling::view_point, Culling::view_line}) {
    std::size_t triangles = 0, beyond_exact = 0, beyond_bounded = 0;
    for (const std::string name :
         {"breathing-sphere", "dented-sphere", "crumpling-sphere", "bend", "twist"}) {
      const auto scene = generic(scene_of(name, 800, 11));
      for (const std::size_t s : {1u, 4u}) {
        const auto &x0 = scene.frames[s], &x1 = scene.frames[s + 1];
        const auto look = [&](Arithmetic arithmetic) {
          return Detector::create(scene.triangles, x0, clean(culling, arithmetic))
              .value()
              .evaluate(x0, x1);
        };
        const auto exact = look(Arithmetic::exact), bounded = look(Arithmetic::bounded);
        const auto mesh = make_topology(scene.triangles, x0.rows());
        std::vector<ViewPrimitive> of_triangle;
        for (const auto c : mesh.component_of_triangle)
          of_triangle.push_back(exact.primitives[static_cast<std::size_t>(c)]);
        const auto truth = oracle::view_signs({x0, x1}, scene.triangles, of_triangle, 1);
        for (std::size_t t = 0; t < truth.size(); ++t) {
          for (const auto& [result, beyond] :
               {std::pair(&exact, &beyond_exact), std::pair(&bounded, &beyond_bounded)}) {
            if (result->signs[t] == truth[t]) continue;
            EXPECT_EQ(result->signs[t], ViewSign::zero) << name << ", triangle " << t;
            ++*beyond;
          }
        }
        triangles += truth.size();
      }
    }
    std::printf("%s: bounded arithmetic leaves %zu of %zu triangles open\n", name_of(culling),
                beyond_bounded, triangles);
    EXPECT_GT(triangles, 7'000u);
    EXPECT_EQ(beyond_exact, 0u);
    EXPECT_LE(static_cast<double>(beyond_bounded), 1e-3 * static_cast<double>(triangles));
  }
}

}  // namespace
}  // namespace assay::properties
