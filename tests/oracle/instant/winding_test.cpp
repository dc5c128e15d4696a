#include "oracle/instant/layers.h"
#include "oracle/mesh/loops.h"
#include "tests/oracle/random_points.h"
#include "tests/oracle/small_meshes.h"

namespace assay::oracle {
namespace {

using detector::Positions, detector::Triangles, test::positions, test::tetrahedron_triangles,
    test::triangles;

Positions tetrahedron() { return positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}}); }

TEST(Winding, InsideOutsideOnTheSurface) {
  const Instant instant(tetrahedron());
  const WindingField field(instant, tetrahedron_triangles);
  EXPECT_EQ(field.at(detector::Point{0.5, 0.5, 0.5}), 1);
  EXPECT_EQ(field.at(detector::Point{-1, 0.5, 0.5}), 0);
  EXPECT_EQ(field.at(detector::Point{3, 3, 3}), 0);
  EXPECT_EQ(field.at(detector::Point{1e300, 0, 0}), 0);
  EXPECT_EQ(field.at(detector::Point{1, 1, 0}), std::nullopt);  // in a face
  EXPECT_EQ(field.at(detector::Point{2, 0, 0}), std::nullopt);  // on an edge
  EXPECT_EQ(field.at(detector::Point{4, 0, 0}), std::nullopt);  // a vertex
  EXPECT_EQ(field.at(detector::Point{5e-324, 5e-324, 5e-324}), 1);
  EXPECT_EQ(field.at(detector::Point{-5e-324, 5e-324, 5e-324}), 0);
}

TEST(Winding, RationalPoints) {
  const Instant instant(tetrahedron());
  const WindingField field(instant, tetrahedron_triangles);
  const mpq_class third(1, 3), four_thirds(4, 3);
  EXPECT_EQ(field.at(RationalPoint{third, third, third}), 1);
  EXPECT_EQ(field.at(RationalPoint{four_thirds, four_thirds, four_thirds}), std::nullopt);
  EXPECT_EQ(field.at(RationalPoint{four_thirds, four_thirds, four_thirds + mpq_class(1, 1000)}), 0);
}

TEST(Winding, TurnedOverIsNegative) {
  Triangles turned = tetrahedron_triangles;
  turned.col(0).swap(turned.col(1));
  const Instant instant(tetrahedron());
  EXPECT_EQ(WindingField(instant, turned).at(detector::Point{0.5, 0.5, 0.5}), -1);
  EXPECT_EQ(WindingField(instant, turned).layer_of(0), (Layer{0, -1}));
}

TEST(Winding, RaysThatMeetEdgesAndVerticesAreTurned) {
  // From the centre of a symmetric octahedron every simple direction meets an edge or a vertex.
  const Positions x = positions(
      {{1048576, 1, 1}, {-1048576, -1, -1}, {0, 4, 0}, {0, -4, 0}, {0, 0, 4}, {0, 0, -4}});
  const Triangles f = triangles(
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
  const Instant instant(x);
  EXPECT_EQ(WindingField(instant, f).at(detector::Point{0, 0, 0}), 1);
}

TEST(Winding, ZeroAreaTrianglesBoundNothing) {
  // A closed mesh that is flat: every point off it is outside, points on it are on the surface.
  const Positions x = positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {1, 1, 0}});
  const Triangles f = triangles({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {3, 4, 4}});
  const Instant instant(x);
  const WindingField field(instant, f);
  EXPECT_EQ(field.at(detector::Point{1, 1, 1}), 0);
  EXPECT_EQ(field.at(detector::Point{-1, 1, 0}), 0);
  EXPECT_EQ(field.at(detector::Point{1, 1, 0}), std::nullopt);
}

// The winding number of a random cycle is that of the sum of its tetrahedra from any vertex.
TEST(Winding, IsTheSumOfTetrahedra) {
  test::Random random(21);
  int inside = 0;
  for (int i = 0; i < 300; ++i) {
    const int vertices = 7;
    Triangles f(6, 3);
    for (int t = 0; t < f.rows(); ++t) {
      for (int k = 0; k < 3; ++k) f(t, k) = random.below(vertices);
    }
    const Triangles ghosts = ghost_triangles(boundary_loops(f), vertices);
    Triangles cycle(f.rows() + ghosts.rows(), 3);
    cycle << f, ghosts;
    Positions x(vertices + 20, 3);
    for (Eigen::Index v = 0; v < x.rows(); ++v) {
      for (int k = 0; k < 3; ++k) x(v, k) = random.integer(6);
    }
    const Instant instant(x);
    const WindingField field(instant, cycle);
    const detector::Point q = {random.unit() * 3, random.unit() * 3, random.unit() * 3};
    const auto w = field.at(q);
    int sum = 0;
    bool degenerate = !w;
    for (Eigen::Index t = 0; t < cycle.rows(); ++t) {
      const Triangles cone = triangles({{cycle(t, 0), cycle(t, 1), cycle(t, 2)},
                                        {cycle(t, 1), cycle(t, 0), 0},
                                        {cycle(t, 2), cycle(t, 1), 0},
                                        {cycle(t, 0), cycle(t, 2), 0}});
      const auto part = WindingField(instant, cone).at(q);
      degenerate |= !part;
      sum += part.value_or(0);
    }
    if (degenerate) continue;
    EXPECT_EQ(*w, sum);
    inside += *w != 0;
  }
  EXPECT_GT(inside, 20);
}

}  // namespace
}  // namespace assay::oracle
