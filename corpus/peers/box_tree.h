// Finds which triangles come near each other in a step, by a tree of boxes that is made once and
// fitted to each step, as any detector has one. Peers share it, so the time by which they differ
// is that of their elementary tests.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

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

// Halves the boxes at the median of their centres along the widest axis until each is alone.
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Box>& boxes) {
    if (boxes.empty()) return;
    std::vector<std::int32_t> items(boxes.size());
    std::iota(items.begin(), items.end(), 0);
    nodes_.reserve(2 * boxes.size());
    grow(boxes, items.data(), items.data() + items.size());
  }

  // Fits the same tree to other boxes of the same items.
  void fit(const std::vector<Box>& boxes) {
    for (std::size_t i = nodes_.size(); i-- > 0;) {  // children stand behind their parents
      Node& node = nodes_[i];
      node.box = node.is_leaf() ? boxes[static_cast<std::size_t>(node.item)] : nodes_[i + 1].box;
      if (!node.is_leaf()) node.box.take(nodes_[node.right].box);
    }
  }

  // Calls visit(a, b) for every two items whose boxes meet, a < b, each once.
  template <class Visit>
  void for_each_pair(const Visit& visit) const {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (!nodes_[i].is_leaf()) between(i + 1, nodes_[i].right, visit);
    }
  }

 private:
  struct Node {
    Box box;
    std::size_t right = 0;   // the left child stands right behind its parent
    std::int32_t item = -1;  // of a leaf
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

}  // namespace assay::peers
