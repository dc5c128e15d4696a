// Wrong normal cones and contours (L13): what the classical form of the traditional scheme gets
// wrong. See detector/traditional/traditional.cpp.
#include <algorithm>

#include "detector/traditional/traditional.h"
#include "properties/faults/planting.h"

namespace assay::properties {
namespace {

using detector::Contour;
using detector::ContourMaker;
using detector::DirectedEdge;
using detector::DirectionSet;
using detector::MovingContour;
using detector::NormalConeSearch;
using detector::Topology;
using Triangle = std::array<detector::MovingPoint, 3>;

Triangle at_rest(Triangle triangle, bool at_end) {
  for (auto& p : triangle) (at_end ? p.t0 : p.t1) = at_end ? p.t1 : p.t0;
  return triangle;
}

struct NormalsAtEnd : NormalConeSearch {
  DirectionSet faced(const Triangle& triangle) const override {
    return detector::faced_directions(at_rest(triangle, true));
  }
};

struct NormalsAtBothEnds : NormalConeSearch {
  DirectionSet faced(const Triangle& triangle) const override {
    return detector::faced_directions(at_rest(triangle, false)) &
           detector::faced_directions(at_rest(triangle, true));
  }
};

// Tests N.d >= 0 in place of N.d > 0.
struct EdgeOnFaced : NormalConeSearch {
  DirectionSet faced(const Triangle& triangle) const override {
    const auto n = detector::cross(detector::difference(triangle[1], triangle[0]),
                                   detector::difference(triangle[2], triangle[0]));
    DirectionSet set = 0;
    for (int bit = 0; bit < detector::facing_directions; ++bit) {
      const auto d = detector::direction(bit);
      const bool is_faced =
          detector::dot(n.b0, d) >= 0 && detector::dot(n.b1, d) >= 0 && detector::dot(n.b2, d) >= 0;
      set |= DirectionSet{is_faced} << bit;
    }
    return set;
  }
};

struct NoContourTest : NormalConeSearch {
  bool stays_simple(MovingContour&, Contour, int) const override { return true; }
};

struct ContourAtEnd : NormalConeSearch {
  bool stays_simple(MovingContour& moving, Contour contour, int direction_bit) const override {
    const auto& end = moving.motion().vertices_t1;
    return MovingContour({end, end}).stays_simple(contour, direction_bit);
  }
};

// Triangles that are connected at a vertex only are taken for one patch, and the first walk around
// some of them is taken for its contour.
struct FirstWalk : ContourMaker {
  using ContourMaker::ContourMaker;
  void append(std::span<const DirectedEdge> boundary, std::vector<std::int32_t>& out) override {
    if (boundary.empty()) return;
    std::vector<std::int32_t> walk = {from(boundary[0])};
    for (;;) {
      const auto leaves = std::find_if(boundary.begin(), boundary.end(),
                                       [&](DirectedEdge e) { return from(e) == walk.back(); });
      const auto again = std::find(walk.begin(), walk.end(), to(*leaves));
      if (again != walk.end()) {
        out.insert(out.end(), again, walk.end());
        return;
      }
      walk.push_back(to(*leaves));
    }
  }
};

struct JoinedAtVertex : NormalConeSearch {
  std::unique_ptr<ContourMaker> contour_maker(const Topology& mesh) const override {
    return std::make_unique<FirstWalk>(mesh);
  }
};

// Two patches that are each free by itself, and face one direction, are taken to be free together.
struct PatchesOneByOne : NormalConeSearch {
  Contour joined(detector::ContourUnion&, Contour a, Contour b) const override {
    return a.size() < b.size() ? b : a;
  }
};

template <class Search>
Fault cone(std::string_view name, std::string_view about, std::string_view curated, int vertices) {
  return planted<Search>(name, about, "all-pairs (L13)", curated, vertices, with_cones);
}

}  // namespace

std::vector<Fault> cone_faults() {
  return {
      cone<NormalsAtEnd>("cone/normals-at-end", "a normal cone is that of the normals at t=1",
                         "F_cone_normals_at_end", 4),
      cone<NormalsAtBothEnds>("cone/normals-at-both-ends",
                              "a normal cone is that of the normals at t=0 and t=1",
                              "F_cone_normals_at_both_ends", 4),
      cone<EdgeOnFaced>("cone/edge-on-faced", "N.d >= 0 is taken for N.d > 0", "F_cone_edge_on", 4),
      cone<NoContourTest>("cone/no-contour-test",
                          "a patch with a normal cone is held to be free without a contour test",
                          "F_cone_no_contour_test", 5),
      cone<ContourAtEnd>("cone/contour-at-end", "the contour is tested at t=1 only",
                         "F_cone_contour_at_end", 5),
      cone<JoinedAtVertex>("cone/joined-at-a-vertex", "patches that share a vertex only are merged",
                           "F_cone_joined_at_vertex", 4),
      cone<PatchesOneByOne>("cone/patches-one-by-one",
                            "two patches that are each free and face one way are free together",
                            "F_cone_patches_one_by_one", 5),
      planted<PatchesOneByOne>("auto/patches-one-by-one",
                               "what culling auto leaves out are patches that are each free", "L14",
                               "F_auto_patches_one_by_one", 71,
                               {detector::Culling::automatic, detector::Start::verified}),
      planted<NormalsAtEnd>("auto/normals-at-end",
                            "what culling auto leaves out faces one direction at t=1 alone", "L14",
                            "F_auto_normals_at_end", 49,
                            {detector::Culling::automatic, detector::Start::verified}),
  };
}

}  // namespace assay::properties
