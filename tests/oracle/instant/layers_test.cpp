// Layers of triangles, and the winding numbers from which layers are computed.
#include "oracle/instant/layers.h"

#include "oracle/mesh/mesh_features.h"
#include "tests/oracle/embedding.h"
#include "tests/oracle/random_points.h"
#include "tests/oracle/small_meshes.h"

namespace assay::oracle {
namespace {

using detector::Positions, detector::Triangles, test::positions, test::tetrahedron_triangles,
    test::triangles;
using Flags = std::vector<std::uint8_t>;

const Triangles no_triangles(0, 3);

LayerState closed_layers(const Positions& x, const Triangles& f) {
  return layers_at(Instant(x), f, no_triangles);
}

Positions tetrahedron() { return positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}}); }

TEST(Layers, BoundaryOfASolid) {
  const LayerState state = closed_layers(tetrahedron(), tetrahedron_triangles);
  EXPECT_EQ(state.common, (std::vector<std::optional<Layer>>{Layer{1, 0}}));
  EXPECT_EQ(state.clean, (Flags{1, 1, 1, 1}));
  EXPECT_EQ(state.piece, (std::vector<std::int32_t>{0, 0, 0, 0}));
}

TEST(Layers, TurnedOverSolidIsCleanToo) {
  const auto x = positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, -4}});
  const LayerState state = closed_layers(x, tetrahedron_triangles);
  EXPECT_EQ(state.common[0], (Layer{0, -1}));
  EXPECT_EQ(state.clean, (Flags{1, 1, 1, 1}));
}

TEST(Layers, ContactsMakeDirty) {
  // The collapsed tetrahedron touches itself everywhere: nothing has a layer.
  const auto x = positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}});
  const LayerState state = closed_layers(x, tetrahedron_triangles);
  EXPECT_EQ(state.touched, (Flags{1, 1, 1, 1}));
  EXPECT_EQ(state.common[0], std::nullopt);
  EXPECT_EQ(state.clean, (Flags{0, 0, 0, 0}));
  EXPECT_EQ(state.piece, (std::vector<std::int32_t>{-1, -1, -1, -1}));
}

TEST(Layers, L10_ContactOfTwoComponentsIsNotTheirOwn) {
  // Two tetrahedra through each other: each is embedded.
  const auto x = positions(
      {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {1, 1, -1}, {5, 1, -1}, {1, 5, -1}, {1, 1, 3}});
  Triangles f(8, 3);
  f << tetrahedron_triangles, (tetrahedron_triangles.array() + 4).matrix();
  EXPECT_FALSE(contacts_at(Instant(x), f).empty());
  const LayerState state = closed_layers(x, f);
  EXPECT_EQ(state.component, (std::vector<std::int32_t>{0, 0, 0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(state.clean, (Flags{1, 1, 1, 1, 1, 1, 1, 1}));
}

TEST(Layers, GhostsConnectAndTouch) {
  // Two triangles with one loop each, and a fan whose apex is in the other triangle.
  const auto x = positions(
      {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 3}, {4, 0, 3}, {0, 4, 3}, {1, 1, -1}, {1, 1, 4}});
  const Triangles f = triangles({{0, 1, 2}, {3, 5, 4}});
  const LayerState apart = layers_at(Instant(x), f, ghost_triangles(boundary_loops(f), 6));
  EXPECT_EQ(apart.component[0], 0);
  EXPECT_EQ(apart.component[1], 1);
  EXPECT_EQ(apart.clean, (Flags{1, 1}));
  EXPECT_EQ(apart.layer[0], (Layer{1, 0}));  // the ghosts are behind it
  EXPECT_EQ(apart.layer[1], (Layer{1, 0}));
  // One loop through both: one component.
  const Triangles joined =
      triangles({{1, 0, 6}, {2, 1, 6}, {0, 2, 6}, {5, 3, 6}, {4, 5, 6}, {3, 4, 6}});
  const LayerState one = layers_at(Instant(x), f, joined);
  EXPECT_EQ(one.component[1], 0);
  EXPECT_EQ(one.touched[0], 1);  // the fan of the upper triangle is pierced by the lower one
}

TEST(Layers, RepeatedIndexIsNeverClean) {
  const auto x = positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {9, 9, 9}, {9, 9, 8}});
  Triangles f(5, 3);
  f << tetrahedron_triangles, triangles({{4, 4, 5}});
  EXPECT_EQ(closed_layers(x, f).clean, (Flags{1, 1, 1, 1, 0}));
}

// Of every untouched triangle the layer by its piece is that by its own centroid, in cycles made of
// random triangles and their ghosts.
TEST(Layers, L9_LayersContinueAcrossLinks) {
  test::Random random(51);
  int linked = 0, several = 0;
  for (int i = 0; i < 600; ++i) {
    const int vertices = 7;
    Triangles f = any_triangles(random, vertices, 7);
    if (i % 2 == 0) f.topRows(4) = tetrahedron_triangles;
    const auto loops = boundary_loops(f);
    const Triangles ghosts = ghost_triangles(loops, vertices);
    Positions x(vertices + static_cast<Eigen::Index>(loops.size()), 3);
    for (Eigen::Index v = 0; v < x.rows(); ++v) {
      for (int k = 0; k < 3; ++k) x(v, k) = i % 3 == 0 ? random.integer(9) : random.unit();
    }
    const Instant instant(x);
    const LayerState state = layers_at(instant, f, ghosts);
    Triangles all(f.rows() + ghosts.rows(), 3);
    all << f, ghosts;
    for (std::int32_t t = 0; t < f.rows(); ++t) {
      EXPECT_EQ(state.layer[t].has_value(), state.touched[t] == 0);
      if (!state.layer[t]) continue;
      std::vector<Eigen::Index> own;
      std::int32_t place = 0;
      for (std::size_t s = 0; s < state.component.size(); ++s) {
        if (state.component[s] != state.component[t]) continue;
        if (static_cast<std::int32_t>(s) == t) place = static_cast<std::int32_t>(own.size());
        own.push_back(static_cast<Eigen::Index>(s));
      }
      EXPECT_EQ(*state.layer[t], WindingField(instant, all(own, Eigen::all)).layer_of(place));
      for (std::int32_t s = 0; s < t; ++s) {
        linked += state.piece[s] == state.piece[t];
        several += state.piece[s] >= 0 && state.component[s] == state.component[t] &&
                   state.layer[s] != state.layer[t];
      }
    }
  }
  EXPECT_GT(linked, 50);
  EXPECT_GT(several, 50);
}

// Winding numbers, of which layers are made.

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
  const Instant instant(x);
  EXPECT_EQ(WindingField(instant, tests::octahedron()).at(detector::Point{0, 0, 0}), 1);
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
    const Triangles f = any_triangles(random, vertices, 6);
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
