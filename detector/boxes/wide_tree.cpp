
#include <algorithm>
#include <array>

#include "detector/boxes/bounding_volume_tree.h"
#include "detector/mesh/for_all.h"

namespace assay::detector {
namespace {

using box_lanes::width;

// The twelve bounds of a box, in the order of the rows.
std::array<float, box_lanes::rows> bounds_of(const MovingBox& box) {
  const auto& [a, b, c, d] = box;
  return {a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2], d[0], d[1], d[2]};
}

}  // namespace

struct WideTree::Builder {
  // A node of the binary tree; all nodes below it are numbered first .. last - 1. Its triangles
  // stand in the order of the leaves from place `begin` on.
  struct Subtree {
    std::int32_t top, first, last, begin;
    std::int32_t triangles() const { return (last - first) / 2 + 1; }
  };

  WideTree& wide;
  const BoundingVolumeTree& binary;
  std::span<const std::int32_t> order;
  PacedStop* pace;

  bool is_mixed(const Subtree& of) const { return binary.component(of.top) == mixed_components; }
  bool is_small(const Subtree& of) const {
    return !is_mixed(of) && of.triangles() <= static_cast<std::int32_t>(width);
  }

  std::array<Subtree, 2> halves(const Subtree& of) const {
    const auto child = of.first, below = child + 2;
    const auto middle = binary.is_leaf(child + 1) ? of.last : binary.child(child + 1);
    const Subtree first = {child, below, middle, of.begin};
    return {first, Subtree{child + 1, middle, of.last, of.begin + first.triangles()}};
  }

  // Opens the largest subtrees until there are eight, or none may be opened. They stay in the
  // order of the binary tree.
  std::size_t open(const Subtree& top, std::array<Subtree, width>& subtrees) const {
    const bool mixed = is_mixed(top);
    subtrees[0] = top;
    std::size_t count = 1;
    while (count < width) {
      std::size_t largest = width;
      for (std::size_t i = 0; i < count; ++i) {
        // What holds one component is not opened beside others: it is a node of its own.
        const bool may_open = mixed ? is_mixed(subtrees[i]) : !is_small(subtrees[i]);
        if (may_open &&
            (largest == width || subtrees[i].triangles() > subtrees[largest].triangles())) {
          largest = i;
        }
      }
      if (largest == width) break;
      const auto both = halves(subtrees[largest]);
      std::copy_backward(subtrees.begin() + static_cast<std::ptrdiff_t>(largest) + 1,
                         subtrees.begin() + static_cast<std::ptrdiff_t>(count),
                         subtrees.begin() + static_cast<std::ptrdiff_t>(count) + 1);
      subtrees[largest] = both[0];
      subtrees[largest + 1] = both[1];
      ++count;
    }
    return count;
  }

  std::int32_t add(const Subtree& top) {
    constexpr std::uint64_t work_of_node = 60, work_of_small = 8;
    const auto n = static_cast<std::int32_t>(wide.nodes_.size());
    const bool small = is_small(top);
    if (pace && pace->after(small ? work_of_small : work_of_node)) return n;
    std::array<Subtree, width> subtrees;
    const std::size_t count = small ? at(top.triangles()) : open(top, subtrees);
    const auto first = static_cast<std::uint32_t>(wide.slots_.size());
    wide.nodes_.push_back({first, static_cast<std::uint16_t>(count), small});
    wide.binary_of_.push_back(top.top);
    if (!small) wide.inner_.push_back(n);
    wide.slots_.resize(first + count);
    for (std::size_t i = 0; i < count; ++i) {
      if (small) {
        const auto triangle = order[at(top.begin) + i];
        wide.slots_[first + i] = {binary.leaf_of(triangle), triangle};
      } else {
        const auto child = add(subtrees[i]);
        wide.slots_[first + i] = {subtrees[i].top, child};
      }
    }
    return n;
  }
};

WideTree::WideTree(const BoundingVolumeTree& binary, std::span<const std::int32_t> order,
                   PacedStop* pace) {
  // What a mesh of few components needs. Of others the lists grow, and are cut to size.
  const std::size_t expected = order.size() / 6 + width;
  nodes_.reserve(expected);
  binary_of_.reserve(expected);
  slots_.reserve(order.size() + expected);
  Builder builder{*this, binary, order, pace};
  builder.add({BoundingVolumeTree::root, 1, static_cast<std::int32_t>(binary.node_count()), 0});
  const auto cut = [](auto& list) {
    if (list.capacity() - list.size() > list.size() / 8) list.shrink_to_fit();
  };
  cut(nodes_);
  cut(slots_);
  cut(binary_of_);
  cut(inner_);
  own_ = std::make_unique_for_overwrite<float[]>(box_lanes::rows * nodes_.size());
}

void WideTree::refit_node(std::int32_t n, const Topology& mesh, const RoundedPositions& points,
                          FloatLanes by) {
  const Node& node = nodes_[at(n)];
  float* const first = boxes_.get() + rows() * node.first_slot;
  MovingBox whole;
  for (std::size_t i = 0; i < node.count; ++i) {
    const auto child = slots_[node.first_slot + i].child;
    const MovingBox box_of_child = node.holds_triangles
                                       ? grown(points.box(mesh.triangles[at(child)]), by)
                                       : box_of({box(child), 1, end_}, 0);
    const auto bounds = bounds_of(box_of_child);
    for (std::size_t row = 0; row < rows(); ++row) first[row * node.count + i] = bounds[row];
    whole = i == 0 ? box_of_child : join(whole, box_of_child);
  }
  std::copy_n(bounds_of(whole).begin(), rows(), own_.get() + rows() * at(n));
}

bool WideTree::refit(const Topology& mesh, const RoundedPositions& points, FloatLanes by,
                     PacedStop& pace) {
  constexpr std::uint64_t work_of_node = 16;
  constexpr std::size_t nodes_of_piece = 256;
  end_ = points.are_at_rest() ? 0 : box_lanes::rows / 2;
  // A mesh that is only looked at where it rests takes half of the room.
  const std::size_t room = rows() * slots_.size() + width;
  if (room_ < room) boxes_ = std::make_unique_for_overwrite<float[]>(room);
  room_ = std::max(room_, room);
  std::fill_n(boxes_.get() + rows() * slots_.size(), width, 0.0F);
  const auto fit_leaves = [&](std::size_t begin, std::size_t end, std::size_t) {
    for (; begin < end; ++begin) {
      if (nodes_[begin].holds_triangles)
        refit_node(static_cast<std::int32_t>(begin), mesh, points, by);
    }
  };
  return for_all_pieces(nodes_.size(), nodes_of_piece, work_of_node, &pace, fit_leaves) &&
         for_each_paced(inner_.size(), work_of_node, &pace, [&](std::size_t i) {
           refit_node(inner_[inner_.size() - 1 - i], mesh, points, by);
         });
}

}  // namespace assay::detector
