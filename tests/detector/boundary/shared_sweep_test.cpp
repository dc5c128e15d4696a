// A sweep of ghosts in parts, by one thread or by several, compared with one sweep of the whole
// mesh.
#include "detector/boundary/boundary_handler.h"
#include "detector/boundary/ghost_sweep.h"
#include "detector/parallel/workers.h"
#include "tests/meshes.h"
#include "tests/test.h"

namespace assay::detector {
namespace {

// A sheet of some 5,000 triangles with a hole in it, which is bent through itself over the step.
class SharedSweep : public testing::Test {
 protected:
  static constexpr int side = 50;
  static constexpr int hole_begin = 20, hole_end = 28;

  SharedSweep() {
    triangles_ = tests::sheet_triangles(side, [](int i, int j) {
      return i >= hole_begin && i < hole_end && j >= hole_begin && j < hole_end;
    });
    start_.resize(side * side, 3);
    end_.resize(side * side, 3);
    for (int v = 0; v < side * side; ++v) {
      const double x = v / side, y = v % side;
      start_.row(v) << x, y, std::sin(.3 * x) + .5 * std::sin(.7 * y);
      end_.row(v) << x, y, 9 * std::sin(.2 * x) - 7 * std::sin(.25 * y + .1 * x);
    }
  }

  struct Swept {
    std::vector<std::uint8_t> touched, near;
    GhostCounts counts;
  };
  // Calls run(sweep, ghosts, result) for the step.
  template <class Run>
  Swept sweep(Run run) const {
    const Surface surface = make_surface(triangles_, start_.rows());
    const BoundaryHandler handler;
    const auto apexes = handler.place_apexes(
        surface, std::vector<ApexRule>(surface.loops.size(), {.25}), {start_, end_});
    const Positions all_t0 = with_apexes(start_, apexes, false),
                    all_t1 = with_apexes(end_, apexes, true);
    const SteppedMesh motion{all_t0, all_t1};
    BoundingVolumeTree tree(surface.mesh, start_);
    tree.refit(surface.mesh, motion);
    tree.join_boxes(nullptr);
    Swept swept;
    swept.touched.assign(surface.mesh.triangles.size(), 0);
    swept.near = swept.touched;
    const ElementaryTest elementary;
    GhostSweep input{surface, tree, motion, elementary};
    input.near = &swept.near;
    std::vector<std::int32_t> ghosts;
    for (auto t = surface.mesh.triangles.size(); t < surface.all().triangles.size(); ++t)
      ghosts.push_back(static_cast<std::int32_t>(t));
    EXPECT_TRUE(run(input, ghosts, swept));
    return swept;
  }
  Swept by_handler(const Workers* workers) const {
    return sweep([&](GhostSweep input, const std::vector<std::int32_t>& ghosts, Swept& swept) {
      input.workers = workers;
      return BoundaryHandler().sweep(input, ghosts, {}, swept.touched, swept.counts);
    });
  }

  Triangles triangles_;
  Positions start_, end_;
};

TEST_F(SharedSweep, TouchesWhatOneSweepOfTheWholeTouches) {
  const Swept whole =
      sweep([](const GhostSweep& input, const std::vector<std::int32_t>& ghosts, Swept& swept) {
        const auto holes =
            make_hole_trees(input.surface.all(), ghosts, input.tree.grid(), input.motion);
        EXPECT_EQ(holes.size(), 2u);
        return std::all_of(holes.begin(), holes.end(), [&](const HoleTree& hole) {
          return sweep_hole(input, hole, {}, swept.touched, swept.counts);
        });
      });
  const auto touched = std::count(whole.touched.begin(), whole.touched.end(), 1);
  EXPECT_GT(touched, 50);
  EXPECT_LT(touched, static_cast<long>(whole.touched.size()) - 50);
  const Swept in_parts = by_handler(nullptr);
  EXPECT_EQ(in_parts.touched, whole.touched);
  EXPECT_EQ(in_parts.near, whole.near);
  EXPECT_EQ(in_parts.counts.pairs, whole.counts.pairs);
  EXPECT_EQ(in_parts.counts.elementary_tests, whole.counts.elementary_tests);
  // Each part begins at the root of each hole.
  EXPECT_LE(in_parts.counts.box_tests, whole.counts.box_tests + 2 * 64);
}

TEST_F(SharedSweep, ThreadsDoNotShow) {
  const Swept alone = by_handler(nullptr);
  for (const std::uint32_t threads : {2u, 3u, 8u}) {
    const Workers workers(threads);
    const Swept shared = by_handler(&workers);
    EXPECT_EQ(shared.touched, alone.touched) << threads;
    EXPECT_EQ(shared.near, alone.near) << threads;
    EXPECT_EQ(shared.counts.box_tests, alone.counts.box_tests) << threads;
    EXPECT_EQ(shared.counts.pairs, alone.counts.pairs) << threads;
    EXPECT_EQ(shared.counts.elementary_tests, alone.counts.elementary_tests) << threads;
  }
}

// Whichever thread is at work when the stop function asks for an end, the sweep says so.
TEST_F(SharedSweep, ThatIsStoppedSaysSo) {
  const Workers workers(2);
  sweep([&](GhostSweep input, const std::vector<std::int32_t>& ghosts, Swept& swept) {
    input.workers = &workers;
    EXPECT_FALSE(BoundaryHandler().sweep(
        input, ghosts, [] { return true; }, swept.touched, swept.counts));
    return true;
  });
}

}  // namespace
}  // namespace assay::detector
