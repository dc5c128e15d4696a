// Random meshes, motions and types for the tests of the search.
#pragma once

#include "detector/search/feature_pairs.h"
#include "tests/detector/points.h"

namespace assay::tests {

struct MovingMesh {
  detector::Topology topology;
  detector::Positions x_t0, x_t1;

  detector::SteppedMesh motion() const { return {x_t0, x_t1}; }
  detector::Triangles rows() const { return triangles(topology.triangles); }
};

// A mesh, and a tree that is fitted to its motion. All triangles are in V+.
struct Fitted {
  explicit Fitted(const MovingMesh& of) : mesh(of), tree(of.topology, of.x_t0), marks(tree) {
    tree.refit(mesh.topology, mesh.motion());
  }
  MovingMesh mesh;
  detector::BoundingVolumeTree tree;
  detector::Marks marks;
};

class SearchMeshes {
 public:
  explicit SearchMeshes(std::uint64_t seed) : engine_(seed) {}

  std::int32_t below(std::int32_t n) {
    return static_cast<std::int32_t>(engine_() % static_cast<std::uint64_t>(n));
  }
  // Returns a number in [-1,1]. If `coarse`, it has one of few values, so that boxes touch.
  double number(bool coarse) {
    return coarse ? below(5) - 2 : static_cast<double>(below(1 << 20)) / (1 << 19) - 1;
  }

  // Returns wavy sheets of size x size squares, one above the other, some joined at a vertex. Each
  // sheet moves as a whole, and its vertices move a little besides.
  MovingMesh sheets(int count, int size, bool coarse) {
    const auto side = size + 1;
    std::vector<Corners> rows;
    MovingMesh mesh;
    mesh.x_t0.resize(count * side * side, 3);
    mesh.x_t1.resize(count * side * side, 3);
    for (int s = 0; s < count; ++s) {
      const double shift[3] = {number(coarse), number(coarse), number(coarse)};
      const auto vertex = [&](int i, int j) { return (s * side + i) * side + j; };
      for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
          const double at[3] = {static_cast<double>(i), static_cast<double>(j),
                                coarse ? 0 : .3 * s + .5 * number(false)};
          for (int k = 0; k < 3; ++k) {
            mesh.x_t0(vertex(i, j), k) = at[k];
            mesh.x_t1(vertex(i, j), k) = at[k] + 2 * shift[k] + (coarse ? 0 : .2 * number(false));
          }
          if (i == size || j == size) continue;
          rows.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
          rows.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
        }
      }
      if (s > 0 && below(2) == 0) rows.back()[2] = 0;
    }
    std::shuffle(rows.begin(), rows.end(), engine_);
    mesh.topology = detector::make_topology(triangles(rows), mesh.x_t0.rows());
    return mesh;
  }

  // Returns one of the types that a step starts with, most often V+.
  detector::TriangleType type() {
    constexpr std::int32_t at_start = 5;
    return static_cast<detector::TriangleType>(below(3) ? 0 : below(at_start));
  }

  // Draws a new type for one of `rarity` triangles.
  void change(std::vector<detector::TriangleType>& types, std::int32_t rarity) {
    for (auto& t : types) {
      if (below(rarity) == 0) t = type();
    }
  }

 private:
  std::mt19937_64 engine_;
};

using EdgeEnds = std::array<std::int32_t, 2>;

// Returns whether the detector finds two edges to be apart by more than a margin, and expects the
// same from both instruction sets. An edge of equal ends is a point.
inline bool are_apart(const detector::FeaturePoints& points, const EdgeEnds& a, const EdgeEnds& b,
                      const detector::FeatureMargin& margin) {
  const auto corners = [&](const EdgeEnds& ends, detector::TriangleCorners& out) {
    out[0] = out[1] = points.start(ends[0]).floats();
    out[2] = points.start(ends[1]).floats();
  };
  detector::TriangleCorners of_a, of_b;
  corners(a, of_a);
  corners(b, of_b);
  const auto found = [&](const detector::BoxKernels& kernels) {
    return kernels.compare_features(of_a, of_b, points.floats_to_end(), margin.floats(),
                                    detector::feature_bits::edges(0, 0));
  };
  EXPECT_EQ(found(detector::box_kernels()), found(detector::plain_box_kernels()));
  return found(detector::box_kernels()) == 0;
}

}  // namespace assay::tests
