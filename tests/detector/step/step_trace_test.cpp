// The order in which a step calls its stages: that of the pseudo-code in detector/step/step.cpp.
// What a step need not do must not be called at all.
#include "detector/assembly.h"
#include "detector/detector.h"
#include "tests/detector/points.h"
#include "tests/detector/step/noted_stages.h"

namespace assay::detector {
namespace {

using tests::octahedron, tests::octahedron_positions, tests::pushed_octahedron;

using namespace tests_of_steps;

// A detector whose stages note their calls, and what it takes to step it.
class Traced {
 public:
  Traced(const Triangles& triangles, const Positions& x, Options options = {}) {
    auto made = assemble(triangles, x, options, noted_stages(options, trace_));
    EXPECT_TRUE(made.has_value());
    detector_ = std::make_unique<Detector>(std::move(made.value()));
    detector_->state();  // makes what the first step with views would make
    trace_.taken();
  }
  Notes step(const Positions& x_t0, const Positions& x_t1, Answer expected) {
    result = detector_->step(x_t0, x_t1, view_);
    EXPECT_EQ(result.answer, expected);
    return trace_.taken();
  }
  // Whatever the search for a view primitive would choose.
  void view_from(const Point& q) { view_ = {{{q, q}, {q, q}}}; }

  StepResult result;

 private:
  Trace trace_;
  std::unique_ptr<Detector> detector_;
  std::vector<ViewPrimitive> view_;
};

constexpr Options clean_with_points = {Culling::view_point, Start::clean};

TEST(StepTrace, L5_FreeClosedStepEndsAfterTheViewTest) {
  Traced traced(octahedron(), octahedron_positions(1), clean_with_points);
  traced.view_from({0, 0, 0});
  EXPECT_EQ(traced.step(octahedron_positions(1), octahedron_positions(2), Answer::free),
            (Notes{"view test", "free?", "settle"}));
  EXPECT_EQ(traced.step(octahedron_positions(2), octahedron_positions(3), Answer::free),
            (Notes{"known?", "view test", "free?", "settle"}));
}

TEST(StepTrace, L3L7_ClosedStepWithAContact) {
  Traced traced(octahedron(), octahedron_positions(2), clean_with_points);
  traced.view_from({0, 0, 0});
  // Every triangle at the apex loses its sign; the others are reached by the closure.
  EXPECT_EQ(traced.step(octahedron_positions(2), pushed_octahedron(), Answer::collision),
            (Notes{"view test", "free?", "fit", "mark", "clear", "K", "search", "test", "H", "K",
                   "join", "mark", "search", "clear", "settle"}));
  // From here on with doubt, and L5 asked whether it can be put away.
  EXPECT_EQ(traced.step(pushed_octahedron(), octahedron_positions(2), Answer::collision),
            (Notes{"known?", "view test", "free?", "release", "test", "fit", "mark", "clear", "K",
                   "search", "test", "H", "K", "settle"}));
}

TEST(StepTrace, L9_VerifiedStartComesAfterTheViewTest) {
  Traced traced(octahedron(), octahedron_positions(2), {Culling::view_point, Start::verified});
  traced.view_from({5, 5, 5});
  const Notes notes = traced.step(octahedron_positions(2), octahedron_positions(2), Answer::free);
  ASSERT_GE(notes.size(), 5u);
  EXPECT_EQ(Notes(notes.begin(), notes.begin() + 4),
            (Notes{"view test", "free?", "released?", "layers"}));
  EXPECT_EQ(std::count(notes.begin(), notes.end(), "fit"), 1);
}

TEST(StepTrace, PairsFirstNeverCloses) {
  Traced traced(octahedron(), octahedron_positions(2),
                {Culling::view_point, Start::clean, Pairs::first});
  traced.view_from({0, 0, 0});
  EXPECT_EQ(traced.step(octahedron_positions(2), pushed_octahedron(), Answer::collision),
            (Notes{"view test", "free?", "fit", "mark", "clear", "K", "search", "test", "settle"}));
}

TEST(StepTrace, BvhKnowsNoViewsAndNoStart) {
  Traced traced(octahedron(), octahedron_positions(2), {Culling::bvh});
  EXPECT_EQ(traced.step(octahedron_positions(2), octahedron_positions(3), Answer::free),
            (Notes{"fit", "mark", "clear", "K", "search", "settle"}));
  EXPECT_EQ(traced.step(octahedron_positions(3), pushed_octahedron(), Answer::collision),
            (Notes{"known?", "fit", "K", "search", "test", "settle"}))
      << "no triangle changed its type";
}

// The octahedron without its two faces at the edge 0-2: a hole of four edges.
Triangles open_octahedron() {
  const Triangles all = octahedron();
  Triangles t(6, 3);
  t << all.middleRows(1, 3), all.middleRows(5, 3);
  return t;
}

TEST(StepTrace, L5_UnclosedAllPositiveStepSweepsNoGhosts) {
  Traced traced(open_octahedron(), octahedron_positions(1), clean_with_points);
  traced.view_from({-.125, -.125, 0});
  EXPECT_EQ(traced.step(octahedron_positions(1), octahedron_positions(2), Answer::free),
            (Notes{"apexes", "view test", "free?", "settle"}));
}

TEST(StepTrace, L11_GhostsAreSweptBeforeTheMarking) {
  Traced traced(open_octahedron(), octahedron_positions(2), clean_with_points);
  traced.view_from({-.125, -.125, 0});
  Positions through_the_hole = octahedron_positions(2);
  through_the_hole.row(1) << 2.5, 2.5, 0;  // the vertex -x, opposite the hole
  const Notes notes = traced.step(octahedron_positions(2), through_the_hole, Answer::free);
  EXPECT_GT(traced.result.violated, 0u);
  EXPECT_EQ(notes, (Notes{"apexes", "view test", "free?", "ghosts", "test", "fit", "mark", "clear",
                          "K", "search", "test", "H", "K", "settle"}));
}

TEST(StepTrace, L10_OneFreeComponentOfTwoSavesItsOwnPairsAlone) {
  Triangles t(16, 3);
  t << octahedron(), octahedron().array() + 6;
  const auto both = [](const Positions& a, const Positions& b) {
    Positions x(12, 3);
    x << a, b;
    x.bottomRows(6).col(0).array() += 16;
    return x;
  };
  Traced traced(t, both(octahedron_positions(2), octahedron_positions(2)), clean_with_points);
  // The first breathes, the second collides with itself.
  EXPECT_EQ(
      traced.step(both(octahedron_positions(2), octahedron_positions(2)),
                  both(octahedron_positions(3), pushed_octahedron()), Answer::collision),
      (Notes{"view test", "free?", "view test", "free?", "fit", "mark", "clear", "K", "search",
             "test", "H", "K", "join", "mark", "search", "test", "clear", "settle"}));
  EXPECT_EQ(traced.result.counts.free_components, 1u);
  for (const auto& contact : traced.result.pairs) EXPECT_GE(contact.pair.a, 8);
}

}  // namespace
}  // namespace assay::detector
