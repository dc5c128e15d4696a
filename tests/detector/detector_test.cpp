// Steps of a detector on small meshes: answers, states and refusals.
#include "detector/detector.h"

#include "detector/mesh/mesh_checks.h"
#include "detector/state/step_state.h"
#include "tests/detector/points.h"

namespace assay::detector {
namespace {

using tests::expect_same_contacts, tests::octahedron, tests::octahedron_positions,
    tests::pushed_octahedron, tests::side_by_side, tests::two_octahedra;

Detector make(const Triangles& t, const Positions& x, Culling culling = Culling::view_point,
              Start start = Start::verified, Pairs pairs = Pairs::all) {
  auto result = Detector::create(t, x, {culling, start, pairs});
  EXPECT_TRUE(result.has_value());
  return std::move(result.value());
}

InputError create_error(const Triangles& t, const Positions& x) {
  auto result = Detector::create(t, x, {});
  EXPECT_FALSE(result.has_value());
  return result.error().error;
}

// A simulation writes each step into the same two arrays.
TEST(Detector, L3_StepsMayComeInTheSameArrays) {
  const Positions x = side_by_side(octahedron_positions(1), octahedron_positions(1), 8);
  for (const auto culling : all_values<Culling>) {
    Positions now = x, next = x;
    Detector detector = make(two_octahedra(), now, culling);
    ASSERT_EQ(detector.step(now, next).answer, Answer::free);
    now = next;
    next.bottomRows(6).col(0).array() -= 7;
    EXPECT_EQ(detector.step(now, next).answer, Answer::collision) << static_cast<int>(culling);
  }
}

TEST(Detector, L12_NamedErrors) {
  const Positions x = octahedron_positions(1);
  EXPECT_EQ(create_error(Triangles(0, 3), x), InputError::no_triangles);
  EXPECT_EQ(create_error(tests::triangles({{0, 1, 6}}), x), InputError::index_out_of_range);
  EXPECT_EQ(create_error(tests::triangles({{0, 1, -1}}), x), InputError::index_out_of_range);
  EXPECT_EQ(create_error(tests::triangles({{0, 1, 1}}), x), InputError::repeated_index);
  EXPECT_EQ(create_error(tests::triangles({{0, 1, 2}, {2, 1, 0}}), x),
            InputError::same_vertices_twice);
  Positions nan = x;
  nan(3, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(create_error(octahedron(), nan), InputError::non_finite_coordinate);
  EXPECT_EQ(create_error(tests::triangles({{0, 1, 2}, {1, 2, 0}}), nan),
            InputError::same_vertices_twice);
}

// The edges of a mesh tell whether triangles have to be compared: wherever the two that repeat
// stand, turned or not, and however many others share their edges.
TEST(Detector, L12_RepeatedTrianglesAreFoundAnywhere) {
  const Positions x = octahedron_positions(1);
  const Triangles whole = octahedron();
  for (Eigen::Index t = 0; t < whole.rows(); ++t) {
    for (const bool is_turned : {false, true}) {
      Triangles more(whole.rows() + 1, 3);
      more << whole, whole(t, 1), whole(t, is_turned ? 0 : 2), whole(t, is_turned ? 2 : 0);
      EXPECT_EQ(create_error(more, x), InputError::same_vertices_twice) << t;
    }
  }
  EXPECT_EQ(create_error(tests::triangles({{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {1, 0, 3}}), x),
            InputError::same_vertices_twice);
  EXPECT_TRUE(Detector::create(tests::triangles({{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}), x, {}));
}

// The number of triangles is looked at before any triangle is, so that no memory stands behind it.
TEST(Detector, L12_MeshesBeyondTheIndicesAreRefused) {
  const std::int32_t corner = 0;
  const double coordinate = 0;
  using Rows = Eigen::Index;
  const auto many_triangles = [&](Rows count) {
    return Eigen::Map<const Triangles>(&corner, count, 3);
  };
  const auto too_large = [](const TrianglesView& t, const PositionsView& x) {
    const auto result = Detector::create(t, x, {});
    EXPECT_FALSE(result.has_value());
    EXPECT_EQ(result.error().error, InputError::mesh_too_large);
    EXPECT_TRUE(says(result.error().message, "178956970"));
  };
  too_large(many_triangles(most_triangles + 1), octahedron_positions(1));
  too_large(many_triangles(715'827'883), octahedron_positions(1));
  too_large(octahedron(), Eigen::Map<const Positions>(&coordinate, most_vertices + 1, 3));
  const Rows corners_of_all = 3 * (most_triangles + 3 * most_triangles);
  EXPECT_LE(corners_of_all, std::numeric_limits<std::int32_t>::max());
  EXPECT_GT(corners_of_all + 12, std::numeric_limits<std::int32_t>::max());
}

TEST(Detector, BadFramesAreErrorsAndLeaveTheState) {
  const Positions x = octahedron_positions(1);
  Detector detector = make(octahedron(), x);
  ASSERT_EQ(detector.step(x, octahedron_positions(2)).answer, Answer::free);
  Positions infinite = octahedron_positions(2);
  infinite(0, 0) = std::numeric_limits<double>::infinity();
  const StepResult refused = detector.step(octahedron_positions(2), infinite);
  EXPECT_EQ(refused.answer, Answer::error);
  ASSERT_TRUE(refused.problem.has_value());
  EXPECT_EQ(refused.problem->error, InputError::non_finite_coordinate);
  EXPECT_EQ(detector.step(octahedron_positions(2), x.topRows(5)).problem->error,
            InputError::wrong_frame_size);
  const StepResult next = detector.step(octahedron_positions(2), octahedron_positions(3));
  EXPECT_EQ(next.answer, Answer::free);
  EXPECT_EQ(next.counts.winding_numbers, 0u) << "still known from the first step";
}

TEST(Detector, L5_BreathingIsFreeWithoutAnyBoxTest) {
  for (const auto culling : {Culling::view_auto, Culling::view_point, Culling::view_line}) {
    Detector detector = make(octahedron(), octahedron_positions(1), culling);
    std::uint64_t windings = 0;
    for (int step = 0; step < 5; ++step) {
      const auto result =
          detector.step(octahedron_positions(1 + step), octahedron_positions(2 + step));
      EXPECT_EQ(result.answer, Answer::free);
      EXPECT_EQ(result.view_positive, 8u);
      EXPECT_EQ(result.counts.search.box_tests, 0u);
      windings += result.counts.winding_numbers;
    }
    EXPECT_EQ(windings, 1u) << "kept from step to step";
  }
}

TEST(Detector, L8_AFreeStepLeavesNothingInDoubt) {
  const Positions x = octahedron_positions(2), larger = octahedron_positions(3);
  Detector detector = make(octahedron(), x);
  EXPECT_EQ(detector.step(x, larger).counts.free_components, 1u);
  Positions in = larger;
  in.row(0) << -1, .25, .5;
  const auto next = detector.step(larger, in);
  EXPECT_EQ(next.counts.free_components, 0u);
  EXPECT_EQ(next.counts.release.in_doubt, 0u);
  EXPECT_EQ(next.dirty, 0u);
}

// Without views no ghosts are swept: nothing is known afterwards of components that have some, be
// they before or behind those that have none.
TEST(Detector, L11L15_AfterAStepWithoutViewsNothingUnclosedIsClean) {
  Triangles t(22, 3);
  t << octahedron().bottomRows(7), octahedron().array() + 6,
      octahedron().bottomRows(7).array() + 12;
  for (const int row : {0, 2, 4, 15, 17, 19}) t.row(row).tail<2>().reverseInPlace();
  Positions x(18, 3);
  for (int i = 0; i < 3; ++i) {
    x.middleRows<6>(6 * i) = octahedron_positions(1);
    x.middleRows<6>(6 * i).col(0).array() += 10 * i;
  }
  Detector detector = make(t, x, Culling::view_auto, Start::clean);
  Positions hit = x;
  hit.row(16) << 20.25, .125, -3;
  const auto result = detector.step(x, hit);
  EXPECT_EQ(result.answer, Answer::collision);
  EXPECT_TRUE(result.signs.empty()) << "turned triangles: no view pays";
  const auto clean = detector.state().fields().committed->clean;
  const auto clean_in = [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    return std::count(clean.begin() + begin, clean.begin() + end, 1);
  };
  EXPECT_EQ(clean_in(0, 7), 0);
  EXPECT_EQ(clean_in(15, 22), 0);
  EXPECT_EQ(clean_in(7, 15), 8) << "closed, and vouched for";
}

// The vertices that a contact names: two features without a common vertex, one of each triangle.
void expect_own_feature(const Triangles& t, const PairContact& contact) {
  const auto& v = contact.feature.vertices;
  const auto holds = [&](std::int32_t triangle, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if ((t.row(triangle).array() != v[i]).all()) return false;
    }
    return true;
  };
  const auto kind = contact.feature.kind;
  const std::size_t first = kind == FeatureKind::vertex_face ? 1 : 2;
  const std::size_t last = kind == FeatureKind::piercing ? 5 : 4;
  const auto [a, b] = contact.pair;
  EXPECT_TRUE((holds(a, 0, first) && holds(b, first, last)) ||
              (holds(b, 0, first) && holds(a, first, last)));
  for (std::size_t i = 0; i < last; ++i) {
    for (std::size_t j = i + 1; j < last; ++j) EXPECT_NE(v[i], v[j]);
  }
}

TEST(Detector, AContactNamesFeaturesOfItsTriangles) {
  const Triangles two = tests::triangles({{0, 1, 2}, {3, 4, 5}});
  const Positions pierced =
      tests::positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1.25, 1}, {1.25, 1, 1}});
  Positions above = pierced;
  for (const int i : {3, 4, 5}) above.row(i)[2] += 5;
  std::set<FeatureKind> kinds;
  for (const auto& [from, to] : {std::pair(pierced, pierced), std::pair(above, pierced)}) {
    const auto result = make(two, from, Culling::bvh).step(from, to);
    ASSERT_EQ(result.pairs.size(), 1u);
    expect_own_feature(two, result.pairs[0]);
    kinds.insert(result.pairs[0].feature.kind);
  }
  EXPECT_TRUE(kinds.count(FeatureKind::piercing));
  EXPECT_TRUE(kinds.count(FeatureKind::vertex_face));
  const auto pulled = make(octahedron(), octahedron_positions(2))
                          .step(octahedron_positions(2), pushed_octahedron());
  for (const auto& contact : pulled.pairs) expect_own_feature(octahedron(), contact);
}

TEST(Detector, L8_ContactsMakeDirtyAndL5Releases) {
  Detector detector = make(octahedron(), octahedron_positions(2));
  EXPECT_EQ(detector.step(octahedron_positions(2), pushed_octahedron()).dirty, 0u);
  const auto still_in = detector.step(pushed_octahedron(), pushed_octahedron());
  EXPECT_GT(still_in.dirty, 0u);
  EXPECT_EQ(still_in.answer, Answer::collision);
  EXPECT_EQ(still_in.first, (TimeEnclosure{0, 0}));
  EXPECT_EQ(detector.step(pushed_octahedron(), octahedron_positions(2)).answer, Answer::collision);
  const auto out = detector.step(octahedron_positions(2), octahedron_positions(3));
  EXPECT_EQ(out.answer, Answer::free);
  EXPECT_EQ(out.dirty, 0u);
}

TEST(Detector, L8_StateBelongsToExactPositions) {
  Detector detector =
      make(octahedron(), octahedron_positions(2), Culling::view_point, Start::unknown);
  Positions moved = octahedron_positions(3);
  ASSERT_EQ(detector.step(octahedron_positions(2), moved).answer, Answer::free);
  // All positive over the next steps too, but a start elsewhere is not the committed one.
  moved(0, 0) += 0x1p-50;
  EXPECT_EQ(detector.evaluate(moved, octahedron_positions(2)).counts.winding_numbers, 1u);
}

TEST(Detector, L8_PositionsAreTheSameWhateverTheirStride) {
  const Positions x = octahedron_positions(2), end = pushed_octahedron();
  Eigen::Matrix<double, 6, 5, Eigen::RowMajor> wide;
  wide.setConstant(7);
  wide.leftCols<3>() = end;
  Detector packed = make(octahedron(), x), strided = make(octahedron(), x);
  packed.step(x, end);
  strided.step(x, wide.leftCols<3>());
  wide.rightCols<2>().setConstant(8);
  const auto expected = packed.step(end, x), from_packed = strided.evaluate(end, x);
  EXPECT_GT(expected.counts.release.in_doubt, 0u);
  EXPECT_EQ(from_packed.counts.release.in_doubt, expected.counts.release.in_doubt);
  EXPECT_EQ(strided.evaluate(wide.leftCols<3>(), x).counts.release.in_doubt,
            expected.counts.release.in_doubt);
}

TEST(Detector, PairsFirstHasTheFirstTime) {
  const auto all = make(octahedron(), octahedron_positions(2))
                       .evaluate(octahedron_positions(2), pushed_octahedron());
  Detector first = make(octahedron(), octahedron_positions(2), Culling::view_point, Start::verified,
                        Pairs::first);
  const auto result = first.step(octahedron_positions(2), pushed_octahedron());
  EXPECT_EQ(result.first, all.first);
  EXPECT_LE(result.pairs.size(), all.pairs.size());
  const auto next = first.evaluate(pushed_octahedron(), pushed_octahedron());
  EXPECT_EQ(next.counts.release.in_doubt, 8u) << "nothing is known after it (L8)";
  const auto anew = make(octahedron(), octahedron_positions(2))
                        .evaluate(pushed_octahedron(), pushed_octahedron());
  EXPECT_EQ(next.dirty, anew.dirty) << "and so what a new start finds is released (L9)";
}

// Where K holds no contact there is none (L3): nothing is missing from the pairs that were found.
TEST(Detector, L8_AFreeStepByFirstPairsLeavesNothingInDoubt) {
  const Positions x = octahedron_positions(2);
  Positions dented = x;
  dented.row(4) << 0, 0, -.5;
  Detector first = make(octahedron(), x, Culling::view_point, Start::verified, Pairs::first);
  const auto result = first.step(x, dented);
  EXPECT_EQ(result.answer, Answer::free);
  EXPECT_EQ(result.counts.free_components, 0u);
  const auto next = first.evaluate(dented, dented);
  EXPECT_EQ(next.counts.free_components, 0u);
  EXPECT_EQ(next.counts.release.in_doubt, 0u);
  EXPECT_EQ(next.dirty, 0u);
}

TEST(Detector, AllCullingsFindTheSamePairsWhateverTheRowStride) {
  using Wide = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;
  const Positions x = octahedron_positions(2);
  Wide wide_t0 = Wide::Constant(6, 6, 77), wide_t1 = wide_t0;
  wide_t0.leftCols<3>() = x;
  wide_t1.leftCols<3>() = pushed_octahedron();
  const auto reference = make(octahedron(), x, Culling::none).evaluate(x, pushed_octahedron());
  ASSERT_EQ(reference.answer, Answer::collision);
  for (const auto culling : all_values<Culling>)
    expect_same_contacts(
        make(octahedron(), x, culling).evaluate(wide_t0.leftCols<3>(), wide_t1.leftCols<3>()),
        reference);
}

TEST(Detector, GreatestCoordinatesAreAnswered) {
  // The mean of many equal greatest doubles must not round up to infinity.
  constexpr int sides = 9;
  Triangles t(2 * sides, 3);
  Positions x(sides + 2, 3);
  for (int i = 0; i < sides; ++i) {
    const int j = (i + 1) % sides;
    t.row(2 * i) << i, j, sides;
    t.row(2 * i + 1) << j, i, sides + 1;
    x.row(i) << std::numeric_limits<double>::max(), i, i * i;
  }
  x.row(sides) << std::numeric_limits<double>::max(), 1, -1;
  x.row(sides + 1) << std::numeric_limits<double>::max(), 2, 100;
  for (const auto culling : {Culling::view_auto, Culling::view_point, Culling::view_line})
    EXPECT_NE(make(t, x, culling).evaluate(x, x).answer, Answer::error);
}

// View primitives that the caller gives: points and lines, fixed and moving, one for all components
// or one for each. The answer is the same from anywhere (L3, L10).

constexpr ViewPrimitive fixed_point = {{{.25, 0, 0}, {.25, 0, 0}}, {{.25, 0, 0}, {.25, 0, 0}}};
constexpr ViewPrimitive moving_point = {{{.25, 0, 0}, {-.5, .25, 0}}, {{.25, 0, 0}, {-.5, .25, 0}}};
constexpr ViewPrimitive fixed_line = {{{-1, 0, 0}, {-1, 0, 0}}, {{1, 0, 0}, {1, 0, 0}}};
constexpr ViewPrimitive moving_line = {{{-1, 0, 0}, {-.5, .5, 0}}, {{1, 0, 0}, {1, .25, -.25}}};
constexpr ViewPrimitive far_line = {{{9, 9, 9}, {9, 9, 8}}, {{9, 9, 11}, {9, 8, 11}}};
constexpr ViewPrimitive all_primitives[] = {fixed_point, moving_point, fixed_line, moving_line,
                                            far_line};

// Two octahedra: the first breathes, the apex of the second is pulled out through its side.
Positions two_octahedra(double radius, const Positions& second) {
  Positions x(12, 3);
  x << octahedron_positions(radius), second.rowwise() + Eigen::RowVector3d(0, 8, 0);
  return x;
}

bool same(const ViewPrimitive& a, const ViewPrimitive& b) {
  return a.q0.t0 == b.q0.t0 && a.q0.t1 == b.q0.t1 && a.q1.t0 == b.q1.t0 && a.q1.t1 == b.q1.t1;
}

class Given : public testing::TestWithParam<Culling> {
 protected:
  // The step from these primitives, and the same without any views.
  StepResult run(std::vector<ViewPrimitive> input) {
    const Positions x_t0 = two_octahedra(2, octahedron_positions(2)),
                    x_t1 = two_octahedra(3, pushed_octahedron());
    const auto step = [&](Culling culling, std::span<const ViewPrimitive> primitives) {
      auto detector = Detector::create(two_octahedra(), x_t0, {culling, Start::verified});
      return detector.value().step(x_t0, x_t1, primitives);
    };
    const auto expected = step(Culling::none, {});
    auto result = step(GetParam(), input);
    EXPECT_EQ(result.answer, Answer::collision);
    expect_same_contacts(result, expected);
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
  Detector detector = make(octahedron(), octahedron_positions(2), GetParam(), Start::clean);
  const Positions x = octahedron_positions(2);
  EXPECT_EQ(detector.step(x, x, {&moving_line, 1}).counts.winding_numbers, 1u);
  // It starts where it ended: nothing to count. It starts elsewhere: counted again.
  const ViewPrimitive on = {{moving_line.q0.t1, {0, 0, 0}}, {moving_line.q1.t1, {.5, 0, 0}}};
  EXPECT_EQ(detector.step(x, x, {&on, 1}).counts.winding_numbers, 0u);
  EXPECT_EQ(detector.step(x, x, {&moving_line, 1}).counts.winding_numbers, 1u);
  EXPECT_EQ(detector.step(x, x).counts.winding_numbers, 1u) << "its own";
}

TEST_P(Given, MustBeFiniteAndAsManyAsComponents) {
  const Positions x = two_octahedra(2, octahedron_positions(2));
  auto result = Detector::create(two_octahedra(), x, {GetParam()});
  ViewPrimitive infinite = moving_line;
  infinite.q1.t1[2] = INFINITY;
  EXPECT_EQ(result.value().evaluate(x, x, {&infinite, 1}).problem->error,
            InputError::non_finite_coordinate);
  const std::vector<ViewPrimitive> three(3, fixed_point);
  EXPECT_EQ(result.value().evaluate(x, x, three).problem->error, InputError::wrong_primitive_count);
}

INSTANTIATE_TEST_SUITE_P(Cullings, Given,
                         testing::Values(Culling::view_auto, Culling::view_point,
                                         Culling::view_line),
                         tests::culling_of_test);

}  // namespace
}  // namespace assay::detector
