// The common part of the peers that test one pair of triangles at a time. They test every pair of
// triangles whose swept boxes meet, and the first time of the step is the least time of the pairs.
// A peer with a separation tests only triangles that share no vertex, and grows the boxes by the
// separation.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

#include "detector/plugin/assay_detector.hpp"

namespace assay::peers {

struct Box {
  double lo[3], hi[3];

  static Box around(const double* p) { return {{p[0], p[1], p[2]}, {p[0], p[1], p[2]}}; }
  void take(const double* p) {
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
    }
  }
  void take(const Box& box) {
    take(box.lo);
    take(box.hi);
  }
  void grow(double by) {
    for (int k = 0; k < 3; ++k) {
      lo[k] -= by;
      hi[k] += by;
    }
  }
  bool meets(const Box& other) const {
    for (int k = 0; k < 3; ++k) {
      if (hi[k] < other.lo[k] || other.hi[k] < lo[k]) return false;
    }
    return true;
  }
};

// Finds which triangles come near each other in a step, by a tree of boxes that is made once and
// fitted to each step, as is usual in detectors. All peers use this tree, so differences of their
// running times come from their elementary tests.
//
// Splits the boxes at the median of their centres along the widest axis until each leaf has one
// box.
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Box>& boxes) {
    if (boxes.empty()) return;
    std::vector<std::int32_t> items(boxes.size());
    std::iota(items.begin(), items.end(), 0);
    nodes_.reserve(2 * boxes.size());
    grow(boxes, items.data(), items.data() + items.size());
  }

  // Fits the tree to new boxes of the same items.
  void fit(const std::vector<Box>& boxes) {
    for (std::size_t i = nodes_.size(); i-- > 0;) {  // children stand behind their parents
      Node& node = nodes_[i];
      node.box = node.is_leaf() ? boxes[static_cast<std::size_t>(node.item)] : nodes_[i + 1].box;
      if (!node.is_leaf()) node.box.take(nodes_[node.right].box);
    }
  }

  // Calls visit(a, b), a < b, once for every two items whose boxes meet.
  template <class Visit>
  void for_each_pair(const Visit& visit) const {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (!nodes_[i].is_leaf()) between(i + 1, nodes_[i].right, visit);
    }
  }

 private:
  struct Node {
    Box box;
    std::size_t right = 0;   // index of the right child; the left child is the node after this one
    std::int32_t item = -1;  // the item of a leaf; -1: not a leaf
    bool is_leaf() const { return item >= 0; }
    double width() const {
      return std::max({box.hi[0] - box.lo[0], box.hi[1] - box.lo[1], box.hi[2] - box.lo[2]});
    }
  };

  std::size_t grow(const std::vector<Box>& boxes, std::int32_t* begin, std::int32_t* end) {
    const std::size_t place = nodes_.size();
    nodes_.emplace_back();
    const auto box_of = [&](std::int32_t item) { return boxes[static_cast<std::size_t>(item)]; };
    Box all = box_of(*begin);
    for (auto* item = begin; item != end; ++item) all.take(box_of(*item));
    nodes_[place].box = all;
    if (end - begin == 1) {
      nodes_[place].item = *begin;
      return place;
    }
    int axis = 0;
    for (int k = 1; k < 3; ++k) {
      if (all.hi[k] - all.lo[k] > all.hi[axis] - all.lo[axis]) axis = k;
    }
    auto* middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end, [&](std::int32_t a, std::int32_t b) {
      return box_of(a).lo[axis] + box_of(a).hi[axis] < box_of(b).lo[axis] + box_of(b).hi[axis];
    });
    grow(boxes, begin, middle);
    nodes_[place].right = grow(boxes, middle, end);
    return place;
  }

  template <class Visit>
  void between(std::size_t a, std::size_t b, const Visit& visit) const {
    const Node &na = nodes_[a], &nb = nodes_[b];
    if (!na.box.meets(nb.box)) return;
    if (na.is_leaf() && nb.is_leaf()) {
      visit(std::min(na.item, nb.item), std::max(na.item, nb.item));
    } else if (nb.is_leaf() || (!na.is_leaf() && na.width() > nb.width())) {
      between(a + 1, b, visit);
      between(na.right, b, visit);
    } else {
      between(a, b + 1, visit);
      between(a, nb.right, visit);
    }
  }

  std::vector<Node> nodes_;
};

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

// `Test` has `static Time first_time(const TrianglePath&, const TrianglePath&)`, which returns the
// first time at which the two triangles meet, or nothing if they do not meet.
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
      // Without rounding, half of the separation would be enough.
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
