// Each pass of the reducer by itself, with judges that say what must stay.
#include <Eigen/Geometry>

#include "corpus/scenes/shapes.h"
#include "properties/reducer/case_edits.h"
#include "properties/reducer/mesh_size.h"
#include "properties/reducer/passes/passes.h"
#include "tests/properties/reducer/resting_cases.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using namespace toys;

// Both meshes, the second moved along x by 10 and named behind the first.
Case together(const Case& a, const Case& b) {
  Case c = a;
  const auto n = a.frames.front().rows();
  c.triangles.conservativeResize(a.triangles.rows() + b.triangles.rows(), Eigen::NoChange);
  c.triangles.bottomRows(b.triangles.rows()) = b.triangles.array() + static_cast<std::int32_t>(n);
  for (std::size_t f = 0; f < c.frames.size(); ++f) {
    c.frames[f].conservativeResize(n + b.frames[f].rows(), Eigen::NoChange);
    c.frames[f].bottomRows(b.frames[f].rows()) = b.frames[f];
    c.frames[f].bottomRows(b.frames[f].rows()).col(0).array() += 10;
  }
  return c;
}

template <class Holds>
Judge fails_when(Holds holds) {
  return [holds](const Case& c) {
    return holds(c) ? std::optional(Finding{"planted", {0, 1}, 0}) : std::nullopt;
  };
}

// What one pass makes of a case.
Case after(void (*pass)(ReductionSearch&), const Case& c, const Judge& judge) {
  const ReduceLimits limits;
  const OnBetter nobody;
  ReductionSearch search(c, judge, limits, nobody);
  EXPECT_TRUE(search.found());
  pass(search);
  EXPECT_TRUE(is_valid(search.best()));
  return search.best();
}

TEST(StepPasses, OnlyTheStepsThatMatterStay) {
  Case c = octahedron(7);
  for (std::size_t f = 0; f < 7; ++f) c.frames[f](0, 0) = static_cast<double>(f);
  const auto steps = [](const Case& x) {
    std::set<std::pair<double, double>> found;
    for (const auto& s : corpus::steps_of(x)) {
      found.insert({x.frames[static_cast<std::size_t>(s.from)](0, 0),
                    x.frames[static_cast<std::size_t>(s.to)](0, 0)});
    }
    return found;
  };
  const auto dropped = after(drop_steps, c, fails_when([&](const Case& x) {
                               return steps(x).contains({1, 2}) && steps(x).contains({4, 5});
                             }));
  EXPECT_EQ(steps(dropped), (std::set<std::pair<double, double>>{{1, 2}, {4, 5}}));
  const auto merged = after(merge_steps, c, fails_when([&](const Case& x) {
                              return x.frames.front()(0, 0) == 0 && x.frames.back()(0, 0) == 6;
                            }));
  EXPECT_EQ(merged.frames.size(), 2u);
  const auto truncated = after(drop_later_steps, c, fails_when([](const Case&) { return true; }));
  EXPECT_EQ(truncated.frames.size(), 2u);
}

TEST(FacePasses, ComponentsAndFacesThatDoNotMatterGo) {
  Case many = tetrahedron();
  for (int i = 0; i < 4; ++i) many = together(many, tetrahedron());
  const auto one = after(drop_components, many, fails_when([](const Case& c) {
                           return c.frames.front().col(0).maxCoeff() == 11 && is_closed(c);
                         }));
  EXPECT_EQ(one.triangles.rows(), 4);

  const auto two = after(drop_faces, octahedron(), fails_when([](const Case& c) {
                           const auto& x = c.frames.front().col(2);
                           return x.maxCoeff() == 2 && x.minCoeff() == -2;
                         }));
  EXPECT_EQ(two.triangles.rows(), 2);

  const auto near = after(keep_rings, octahedron(), fails_when([](const Case&) { return true; }));
  EXPECT_EQ(near.triangles.rows(), 2);  // the reported pair
}

TEST(ClosedPasses, EachMakesAClosedMeshSmallerAndKeepsItClosed) {
  const Judge closed = fails_when(is_closed);
  const auto sphere = corpus::sphere_shape(80);
  Case large;
  large.triangles = sphere.triangles;
  large.frames.assign(2, sphere.positions);
  ASSERT_TRUE(is_closed(large));
  for (const auto pass :
       {cone_outside, cut_and_close, merge_balls, collapse_to_parents, collapse_edges,
        remove_and_close, try_spheres_of_pair, try_small_spheres}) {
    const Case smaller = after(pass, large, closed);
    EXPECT_LT(smaller.triangles.rows(), 80);
    EXPECT_TRUE(is_closed(smaller));
  }
  EXPECT_EQ(after(collapse_edges, large, closed).triangles.rows(), 4);
  EXPECT_EQ(after(try_small_spheres, large, closed).triangles.rows(), 4);
  EXPECT_LT(after(merge_twice, octahedron(), closed).triangles.rows(), 8);
}

TEST(MotionPasses, VerticesComeToRest) {
  Case c = octahedron(3);
  for (std::size_t f = 1; f < 3; ++f) c.frames[f].array() += static_cast<double>(f);
  const auto still = after(freeze_vertices, c, fails_when([](const Case& x) {
                             // The third vertex must move in the second step.
                             return x.frames[1].row(2) != x.frames[2].row(2);
                           }));
  EXPECT_EQ(size_of(still).moving, 1u);
}

TEST(ViewPasses, AFixedPointAtTheOrigin) {
  Case c = octahedron();
  c.view = corpus::CaseView{{{1, 2, 3}, {3, 2, 1}}, {{4, 5, 6}, {6, 5, 4}}};
  const auto simple =
      after(simplify_view, c, fails_when([](const Case& x) { return x.view.has_value(); }));
  EXPECT_EQ(simple.view->q0, std::vector<detector::Point>(2, {0, 0, 0}));
  EXPECT_TRUE(simple.view->q1.empty());
  EXPECT_FALSE(after(drop_view, c, fails_when([](const Case&) { return true; })).view);
}

TEST(NumberPasses, CoordinatesBecomeSmallIntegers) {
  Case c = tetrahedron();
  for (auto& frame : c.frames) {
    frame.array() *= 0.123456;
    frame.array() += 77.7;
  }
  // A volume stays, whatever its size.
  const Judge solid = fails_when([](const Case& x) {
    const auto& p = x.frames[0];
    const Eigen::Vector3d a = p.row(1) - p.row(0), b = p.row(2) - p.row(0), d = p.row(3) - p.row(0);
    return std::abs(a.dot(b.cross(d))) > 1e-9;
  });
  const auto total = [](const Case& x) { return size_of(x).numbers; };
  EXPECT_LT(total(after(translate, c, solid)), total(c));
  EXPECT_LT(total(after(round_all, c, solid)), total(c));
  EXPECT_LT(total(after(round_vertices, c, solid)), total(c));
  Case integers = c;
  for (auto& frame : integers.frames) frame = (frame.array() * 10).round().matrix();
  ASSERT_TRUE(solid(integers));
  const auto simple = after(simplify_numbers, integers, solid);
  EXPECT_LE(total(simple), 2 * 12u);
  EXPECT_LT(total(after(simplify_together, integers, solid)), total(integers));
}

TEST(NumberPasses, SimplerValuesCostLessAndComeInOrder) {
  for (const double value : {0.7, -123.456, 1e300, -5e-324, 42.0, -7.0, 1.0}) {
    std::uint64_t last = 0;
    for (const double simpler : simpler_values(value)) {
      EXPECT_LT(number_cost(simpler), number_cost(value));
      EXPECT_GE(number_cost(simpler), last);
      last = number_cost(simpler);
    }
  }
  EXPECT_TRUE(simpler_values(0).empty());
  EXPECT_EQ(rounded_to_digits(-123.456, 2), -120);
}

TEST(OrderPass, NumberedByUseWithTheLowestCornerFirst) {
  const Case c = still_case({{3, 1, 2}, {0, 3, 2}, {1, 3, 0}, {2, 1, 0}},
                            {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  const auto ordered = after(canonical_order, c, fails_when(is_closed));
  EXPECT_EQ(ordered.triangles, (detector::Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}));
  EXPECT_EQ(size_of(ordered), size_of(c));
  EXPECT_EQ(ordered.frames[0].row(0), c.frames[0].row(3));
}

TEST(Escape, LeavesALocalMinimum) {
  // Fails with an octahedron, and with a tetrahedron whose first vertex is somewhere else: no
  // single merge leads there.
  const Judge judge = fails_when([](const Case& c) {
    return is_closed(c) && (c.triangles.rows() == 8 || c.frames[0].row(0).sum() == 5);
  });
  const Case stuck = octahedron();
  EXPECT_EQ(after(collapse_edges, stuck, judge).triangles.rows(), 8);
  EXPECT_LT(after(escape, stuck, judge).triangles.rows(), 8);
}

}  // namespace
}  // namespace assay::properties
