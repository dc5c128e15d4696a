// What the peers that test two triangles at a time have in common. Their test is put to every pair
// of triangles whose swept boxes meet, and the step's first time is the least of the pairs'. One
// that is asked for a distance is asked of triangles that share no vertex, and of boxes that may be
// as far apart as that.
#pragma once

#include <optional>

#include "corpus/peers/box_tree.h"
#include "detector/plugin/assay_detector.hpp"

namespace assay::peers {

using Time = std::optional<plugin::Interval>;

// A triangle of the step: the numbers of its vertices, and their places.
struct TrianglePath {
  const std::int32_t* vertex;
  const double* at[2][3];  // at t = 0 and at t = 1

  bool has(std::int32_t v) const { return vertex[0] == v || vertex[1] == v || vertex[2] == v; }
  bool shares_a_vertex_with(const TrianglePath& other) const {
    return other.has(vertex[0]) || other.has(vertex[1]) || other.has(vertex[2]);
  }
};

// `Test` has `static Time first_time(const TrianglePath&, const TrianglePath&)`: when the two
// triangles meet first, or nothing when they do not.
template <class Test>
class TrianglePairs {
 public:
  explicit TrianglePairs(const plugin::Mesh& mesh, double separation = 0)
      : separation_(separation),
        triangles_(mesh.triangles.data(), mesh.triangles.data() + 3 * mesh.triangles.size()),
        tree_(boxes_of(mesh.positions, mesh.positions)) {}

  plugin::Result evaluate(plugin::Positions x_t0, plugin::Positions x_t1) {
    tree_.fit(boxes_of(x_t0, x_t1));
    plugin::Result result;
    tree_.for_each_pair([&](std::int32_t a, std::int32_t b) {
      const auto s = path_of(a, x_t0, x_t1), t = path_of(b, x_t0, x_t1);
      if (separation_ > 0 && s.shares_a_vertex_with(t)) return;
      const Time time = Test::first_time(s, t);
      if (!time) return;
      const bool is_first = result.pairs.empty() || (*time)[0] < result.first[0];
      if (is_first) result.first = *time;
      result.answer = ASSAY_COLLISION;
      result.add(a, b, (*time)[0], (*time)[1]);
    });
    return result;
  }

 private:
  TrianglePath path_of(std::int32_t triangle, plugin::Positions x_t0,
                       plugin::Positions x_t1) const {
    const std::int32_t* v = triangles_.data() + 3 * std::ptrdiff_t{triangle};
    TrianglePath path{v, {}};
    for (int i = 0; i < 3; ++i) {
      path.at[0][i] = x_t0[static_cast<std::size_t>(v[i])];
      path.at[1][i] = x_t1[static_cast<std::size_t>(v[i])];
    }
    return path;
  }

  const std::vector<Box>& boxes_of(plugin::Positions x_t0, plugin::Positions x_t1) {
    boxes_.clear();
    for (std::size_t t = 0; t < triangles_.size() / 3; ++t) {
      const auto path = path_of(static_cast<std::int32_t>(t), x_t0, x_t1);
      Box box = Box::around(path.at[0][0]);
      for (const auto& at : path.at) {
        for (const double* p : at) box.take(p);
      }
      // Half would do but for rounding.
      box.grow(separation_);
      boxes_.push_back(box);
    }
    return boxes_;
  }

  double separation_;
  std::vector<std::int32_t> triangles_;  // three vertices each
  std::vector<Box> boxes_;
  BoxTree tree_;
};

}  // namespace assay::peers
