// The view test in a thread with a small stack, over the triangles that need most of it.
#include "detector/view/view_signs.h"
#include "tests/detector/points.h"
#include "tests/detector/small_stack.h"

namespace assay::detector {
namespace {

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
