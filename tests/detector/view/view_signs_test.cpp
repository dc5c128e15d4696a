// View signs, one triangle at a time.
#include "detector/view/view_signs.h"

#include "tests/detector/points.h"
#include "tests/detector/small_stack.h"

namespace assay::detector {
namespace {

using tests::still;

ViewPrimitive point_at(Point q) { return {still(q), still(q)}; }

// Both ways: exact always, the filter where it decides. In a thread with a small stack.
ViewSign sign(const MovingTriangle& triangle, const ViewPrimitive& primitive) {
  ViewSign exact{};
  tests::on_small_stack([&] {
    exact = exact_view_sign(triangle, primitive);
    EXPECT_EQ(filter_view_sign(triangle, primitive).value_or(exact), exact);
  });
  return exact;
}

const MovingTriangle above = {still({0, 0, 1}), still({1, 0, 1}), still({0, 1, 1})};
const MovingTriangle flipped = {still({0, 0, 1}), still({0, 1, 1}), still({1, 0, 1})};

TEST(ViewTest, PointSigns) {
  EXPECT_EQ(sign(above, point_at({0, 0, 0})), ViewSign::positive);
  EXPECT_EQ(sign(flipped, point_at({0, 0, 0})), ViewSign::negative);
  EXPECT_EQ(sign(above, point_at({5, 5, 1})), ViewSign::zero) << "in the plane of the triangle";
  EXPECT_EQ(sign({still({0, 0, 1}), still({1, 1, 1}), still({2, 2, 1})}, point_at({0, 0, 0})),
            ViewSign::zero)
      << "of no area";
}

// Far from zero doubles decide, whatever the sign and the primitive.
TEST(ViewTest, TheFilterSettlesWhatIsFarFromZero) {
  const ViewPrimitive point = point_at({0, 0, 0}), line = {still({0, 0, 0}), still({.25, 0, 0})};
  const MovingTriangle passes = {MovingPoint{{0, 0, 1}, {0, 0, -1}},
                                 MovingPoint{{1, 0, 1}, {1, 0, -1}},
                                 MovingPoint{{0, 1, 1}, {0, 1, -1}}};
  for (const auto& primitive : {point, line}) {
    EXPECT_EQ(filter_view_sign(above, primitive), ViewSign::positive);
    EXPECT_EQ(filter_view_sign(flipped, primitive), ViewSign::negative);
    EXPECT_EQ(filter_view_sign(passes, primitive), ViewSign::zero);
    ViewCounts counts;
    view_sign(above, primitive, counts);
    EXPECT_EQ(counts.filter, 1u);
    EXPECT_EQ(counts.exact, 0u);
  }
}

// All triangles of a flat fan lie in one plane with the view point, which integers alone can tell.
// One that they decide takes as long as some ten thousand box tests. So few of them are done
// before the stop function is asked.
TEST(ViewTest, AStopIsAskedByTheWorkOfIntegers) {
  constexpr int count = 400;
  Triangles fan(count, 3);
  Positions x(count + 2, 3);
  x.row(0) << 0, 0, 0;
  for (int i = 0; i <= count; ++i) x.row(i + 1) << count, i, 0;
  for (int i = 0; i < count; ++i) fan.row(i) << 0, i + 1, i + 2;
  const Topology mesh = make_topology(fan, x.rows());
  std::vector<ViewSign> signs(count);
  const auto run = [&](const StopFunction& stop, ViewCounts& counts) {
    PacedStop pace(stop);
    return classify(mesh, mesh.components[0], {x, x}, point_at({.25, .5, 0}), signs, counts,
                    best_instruction_set(), Arithmetic::exact, &pace);
  };
  std::uint64_t calls = 0;
  ViewCounts whole, ended;
  ASSERT_TRUE(run([&] { return ++calls, false; }, whole));
  ASSERT_EQ(whole.exact, std::uint64_t{count});
  EXPECT_GE(calls, whole.exact * 20'000 / PacedStop::usual_interval);
  EXPECT_FALSE(run([] { return true; }, ended));
  EXPECT_LT(ended.exact, 20u);
}

TEST(ViewTest, L2_SignsAtTheEndsSayNothing) {
  // Positive at t=0 and t=1; the plane dips below the view point in between.
  const MovingTriangle dips = {MovingPoint{{0, 0, 1}, {0, 0, 1}},
                               MovingPoint{{1, 0, 1}, {-1, 0, 1}},
                               MovingPoint{{0, 1, 1}, {0, -1, 1}}};
  EXPECT_EQ(sign(dips, point_at({0, 0, 0})), ViewSign::zero) << "N vanishes at t = 1/2";
}

TEST(ViewTest, L2_TouchingZeroIsNotPositive) {
  const MovingTriangle touches = {MovingPoint{{0, 0, 1}, {0, 0, 0}},
                                  MovingPoint{{1, 0, 1}, {1, 0, 0}},
                                  MovingPoint{{0, 1, 1}, {0, 1, 0}}};
  EXPECT_EQ(sign(touches, point_at({0, 0, 0})), ViewSign::zero);
  EXPECT_EQ(sign(touches, point_at({0, 0, -0x1p-60})), ViewSign::positive);
}

TEST(ViewTest, L1_EachVertexHasItsOwnNearestPoint) {
  // The three vertices give -1.28, +1.28 and 0: one of them does not speak for all (L1).
  const MovingTriangle t = {still({.4, 1, .1}), still({-.4, 1, .9}), still({0, 5, .5})};
  EXPECT_EQ(sign(t, {still({0, 0, 0}), still({0, 0, 1})}), ViewSign::zero);
}

TEST(ViewTest, L1_LineThatIsAPointIsThePointScheme) {
  for (const auto& triangle : {above, flipped}) {
    for (const Point q : {Point{0, 0, 0}, Point{.3, -.7, 2}, Point{0, 0, 1}}) {
      ViewPrimitive nearly_point = point_at(q);
      nearly_point.q1.t1[2] += 0x1p-80;  // takes the code of lines
      const auto as_point = sign(triangle, point_at(q));
      EXPECT_TRUE(as_point == ViewSign::zero || sign(triangle, nearly_point) == as_point);
    }
  }
}

TEST(ViewTest, LineEndsThatMoveApart) {
  const ViewPrimitive grows = {{{0, 0, 0}, {-2, 0, 0}}, {{0, 0, 0}, {2, 0, 0}}};
  EXPECT_EQ(sign(above, grows), ViewSign::positive);
  EXPECT_EQ(sign(flipped, grows), ViewSign::negative);
  EXPECT_EQ(sign(above, {{{0, 0, 0}, {0, 0, 3}}, {{0, 0, 0}, {1, 0, 0}}}), ViewSign::zero);
}

TEST(ViewTest, LineSeesATubeBetterThanAPoint) {
  // A side wall near one end, leaning in: from the middle it is seen from behind.
  const MovingTriangle wall = {still({9, 1, 0}), still({10, .2, 0}), still({9.5, .6, 1})};
  const ViewSign from_line = sign(wall, {still({0, 0, 0}), still({9, 0, 0})});
  const ViewSign from_point = sign(wall, point_at({4.5, 0, 0}));
  EXPECT_NE(from_line, ViewSign::zero);
  EXPECT_NE(from_point, ViewSign::zero);
}

// In a thread with a small stack, over the triangles that need most of it.

ViewSign sign_by_both_rungs(const MovingTriangle& triangle, const ViewPrimitive& primitive) {
  const ViewSign exact = exact_view_sign(triangle, primitive);
  ViewCounts counts;
  EXPECT_EQ(view_sign(triangle, primitive, counts), exact);
  view_sign(triangle, primitive, counts, Arithmetic::bounded);
  return exact;
}

// An end of the line comes from far away: roots next to 1 that many bits tell apart.
TEST(ViewStack, LineWhoseEndComesFromFarAway) {
  tests::expect_enough_stack("end from far away", [] {
    const double least = std::ldexp(1, -1068);
    const MovingTriangle triangle = {MovingPoint{{0, 0, 0}, {1, 0, 0}},
                                     MovingPoint{{0, 1, 0}, {0, 0, -least}},
                                     MovingPoint{{0, 0, 1}, {0, 0, 0}}};
    for (int big = 0; big <= 1020; big += 60) {
      const ViewPrimitive line = {{{0, 0, std::ldexp(1, big)}, {-least, 0, -least}},
                                  {{1, 0, 0}, {0, 1, 0}}};
      EXPECT_EQ(sign_by_both_rungs(triangle, line), ViewSign::zero) << big;
    }
  });
}

TEST(ViewStack, ExponentsOverAllDoubles) {
  tests::expect_enough_stack("exponents over all doubles", [] {
    std::mt19937_64 engine(20118);
    const auto below = [&engine](int n) { return static_cast<int>(engine() % std::uint64_t(n)); };
    for (int i = 0; i < 300; ++i) {
      std::array<MovingPoint, 5> p;
      for (auto& point : p) {
        for (double* end : {point.t0.data(), point.t1.data()}) {
          for (int k = 0; k < 3; ++k) end[k] = std::ldexp(below(5) - 2, below(2097) - 1074);
        }
      }
      sign_by_both_rungs({p[0], p[1], p[2]}, {p[3], i % 4 == 0 ? p[3] : p[4]});
    }
  });
}

}  // namespace
}  // namespace assay::detector
