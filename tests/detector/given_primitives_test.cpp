// View primitives that the caller gives: points and lines, fixed and moving, one for all components
// or one for each. The answer is the same from anywhere (L3, L10).
#include "detector/detector.h"
#include "tests/detector/points.h"

namespace assay::detector {
namespace {

using tests::octahedron, tests::octahedron_positions;

constexpr ViewPrimitive fixed_point = {{{.25, 0, 0}, {.25, 0, 0}}, {{.25, 0, 0}, {.25, 0, 0}}};
constexpr ViewPrimitive moving_point = {{{.25, 0, 0}, {-.5, .25, 0}}, {{.25, 0, 0}, {-.5, .25, 0}}};
constexpr ViewPrimitive fixed_line = {{{-1, 0, 0}, {-1, 0, 0}}, {{1, 0, 0}, {1, 0, 0}}};
constexpr ViewPrimitive moving_line = {{{-1, 0, 0}, {-.5, .5, 0}}, {{1, 0, 0}, {1, .25, -.25}}};
constexpr ViewPrimitive far_line = {{{9, 9, 9}, {9, 9, 8}}, {{9, 9, 11}, {9, 8, 11}}};
constexpr ViewPrimitive all_primitives[] = {fixed_point, moving_point, fixed_line, moving_line,
                                            far_line};

// Two octahedra: the first breathes, the apex of the second is pulled out through its side.
Triangles two_octahedra() {
  Triangles t(16, 3);
  t << octahedron(), octahedron().array() + 6;
  return t;
}
Positions two_octahedra(double radius, bool pushed) {
  Positions x(12, 3);
  x << octahedron_positions(radius), octahedron_positions(2);
  if (pushed) x.row(10) << 3, .5, -.25;
  x.bottomRows(6).col(1).array() += 8;
  return x;
}

bool same(const ViewPrimitive& a, const ViewPrimitive& b) {
  return a.q0.t0 == b.q0.t0 && a.q0.t1 == b.q0.t1 && a.q1.t0 == b.q1.t0 && a.q1.t1 == b.q1.t1;
}

class Given : public testing::TestWithParam<Culling> {
 protected:
  // The step from these primitives, and the same without any views.
  StepResult run(std::vector<ViewPrimitive> given) {
    const Positions x_t0 = two_octahedra(2, false), x_t1 = two_octahedra(3, true);
    const auto step = [&](Culling culling, std::span<const ViewPrimitive> primitives) {
      auto made = Detector::create(two_octahedra(), x_t0, {culling, Start::verified});
      return made.value().step(x_t0, x_t1, primitives);
    };
    const auto expected = step(Culling::none, {});
    auto result = step(GetParam(), given);
    EXPECT_EQ(result.answer, Answer::collision);
    EXPECT_EQ(result.first, expected.first);
    EXPECT_EQ(result.pairs.size(), expected.pairs.size());
    for (std::size_t i = 0; i < std::min(result.pairs.size(), expected.pairs.size()); ++i) {
      EXPECT_EQ(result.pairs[i].pair, expected.pairs[i].pair);
      EXPECT_EQ(result.pairs[i].time, expected.pairs[i].time);
    }
    return result;
  }
};

TEST_P(Given, L3L10_OneForAllComponents) {
  for (const auto& primitive : all_primitives) {
    const auto result = run({primitive});
    if (GetParam() == Culling::view_auto && result.primitives.empty()) continue;  // fell back
    ASSERT_EQ(result.primitives.size(), 2u);
    EXPECT_TRUE(same(result.primitives[0], primitive));
    EXPECT_TRUE(same(result.primitives[1], primitive));
  }
}

TEST_P(Given, L3L10_OneForEachComponent) {
  for (const auto& first : all_primitives) {
    for (ViewPrimitive second : all_primitives) {
      for (auto* q : {&second.q0.t0, &second.q0.t1, &second.q1.t0, &second.q1.t1}) (*q)[1] += 8;
      const auto result = run({first, second});
      if (GetParam() == Culling::view_auto && result.primitives.empty()) continue;  // fell back
      ASSERT_EQ(result.primitives.size(), 2u);
      EXPECT_TRUE(same(result.primitives[0], first));
      EXPECT_TRUE(same(result.primitives[1], second));
      // From inside, fixed or moving, the one that breathes is all positive.
      const bool inside = first.q0.t0[0] < 9;
      EXPECT_EQ(result.counts.free_components, inside ? 1u : 0u);
    }
  }
}

TEST_P(Given, L5_AGivenPrimitiveThatMovesOnIsKnownToBeInside) {
  auto made = Detector::create(octahedron(), octahedron_positions(2), {GetParam(), Start::clean});
  Detector& detector = made.value();
  const Positions x = octahedron_positions(2);
  EXPECT_EQ(detector.step(x, x, {&moving_line, 1}).counts.winding_numbers, 1u);
  // It starts where it ended: nothing to count. It starts elsewhere: counted again.
  const ViewPrimitive on = {{moving_line.q0.t1, {0, 0, 0}}, {moving_line.q1.t1, {.5, 0, 0}}};
  EXPECT_EQ(detector.step(x, x, {&on, 1}).counts.winding_numbers, 0u);
  EXPECT_EQ(detector.step(x, x, {&moving_line, 1}).counts.winding_numbers, 1u);
  EXPECT_EQ(detector.step(x, x).counts.winding_numbers, 1u) << "its own";
}

TEST_P(Given, MustBeFiniteAndAsManyAsComponents) {
  const Positions x = two_octahedra(2, false);
  auto made = Detector::create(two_octahedra(), x, {GetParam()});
  ViewPrimitive infinite = moving_line;
  infinite.q1.t1[2] = INFINITY;
  EXPECT_EQ(made.value().evaluate(x, x, {&infinite, 1}).problem->error,
            InputError::non_finite_coordinate);
  const std::vector<ViewPrimitive> three(3, fixed_point);
  EXPECT_EQ(made.value().evaluate(x, x, three).problem->error, InputError::wrong_primitive_count);
}

INSTANTIATE_TEST_SUITE_P(Cullings, Given,
                         testing::Values(Culling::view_auto, Culling::view_point,
                                         Culling::view_line),
                         [](const auto& culling) -> std::string {
                           return culling.param == Culling::view_auto    ? "view_auto"
                                  : culling.param == Culling::view_point ? "view_point"
                                                                         : "view_line";
                         });

}  // namespace
}  // namespace assay::detector
