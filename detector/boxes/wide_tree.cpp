
#include <algorithm>
#include <array>
#include <cstring>

#include "detector/boxes/bounding_volume_tree.h"
#include "detector/mesh/for_all.h"

namespace assay::detector {
namespace {

using box_lanes::rows;
using box_lanes::width;

// The twelve bounds of a box, in the order of the rows.
std::array<float, rows> bounds_of(const MovingBox& box) {
  const auto& [a, b, c, d] = box;
  return {a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2], d[0], d[1], d[2]};
}

}  // namespace

struct WideTree::Builder {
  // A node of the binary tree; all nodes below it are numbered first .. last - 1.
  struct Subtree {
    std::int32_t top, first, last;
    std::int32_t triangles() const { return (last - first) / 2 + 1; }
  };

  WideTree& wide;
  const BoundingVolumeTree& binary;
  PacedStop* pace;

  bool is_mixed(const Subtree& of) const { return binary.component(of.top) == mixed_components; }
  bool is_small(const Subtree& of) const {
    return !is_mixed(of) && of.triangles() <= static_cast<std::int32_t>(width);
  }

  std::array<Subtree, 2> halves(const Subtree& of) const {
    const auto child = of.first, below = child + 2;
    const auto middle = binary.is_leaf(child + 1) ? of.last : binary.child(child + 1);
    return {Subtree{child, below, middle}, Subtree{child + 1, middle, of.last}};
  }

  // Opens the largest subtrees until there are eight, or none may be opened. They stay in the
  // order of the binary tree.
  std::size_t open(const Subtree& top, std::array<Subtree, width>& subtrees) const {
    const bool small = is_small(top), mixed = is_mixed(top);
    subtrees[0] = top;
    std::size_t count = 1;
    while (count < width) {
      std::size_t largest = width;
      for (std::size_t i = 0; i < count; ++i) {
        // What holds one component is not opened beside others: it is a node of its own.
        const bool may_open = small   ? subtrees[i].triangles() > 1
                              : mixed ? is_mixed(subtrees[i])
                                      : !is_small(subtrees[i]);
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
    constexpr std::uint64_t work_of_node = 60;
    const auto n = static_cast<std::int32_t>(wide.nodes_.size());
    if (pace && pace->after(work_of_node)) return n;
    std::array<Subtree, width> subtrees;
    const std::size_t count = open(top, subtrees);
    const auto first = static_cast<std::uint32_t>(wide.slots_.size());
    const bool small = is_small(top);
    wide.nodes_.push_back({first, static_cast<std::uint16_t>(count), small});
    wide.binary_of_.push_back(top.top);
    if (!small) wide.inner_.push_back(n);
    wide.slots_.resize(first + count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto node = subtrees[i].top;
      const auto child = small ? binary.triangle(node) : add(subtrees[i]);
      wide.slots_[first + i] = {node, child};
    }
    return n;
  }
};

WideTree::WideTree(const BoundingVolumeTree& binary, PacedStop* pace) {
  Builder builder{*this, binary, pace};
  builder.add({BoundingVolumeTree::root, 1, static_cast<std::int32_t>(binary.node_count())});
  nodes_.shrink_to_fit();
  slots_.shrink_to_fit();
  binary_of_.shrink_to_fit();
  inner_.shrink_to_fit();
  boxes_ = std::make_unique_for_overwrite<float[]>(rows * slots_.size() + width);
  std::fill_n(boxes_.get() + rows * slots_.size(), width, 0.0F);
  own_ = std::make_unique_for_overwrite<float[]>(rows * nodes_.size());
}

void WideTree::refit_node(std::int32_t n, const Topology& mesh, const RoundedPositions& points,
                          FloatLanes by) {
  const Node& node = nodes_[at(n)];
  float* const first = boxes_.get() + rows * node.first_slot;
  float* const own = own_.get() + rows * at(n);
  for (std::size_t i = 0; i < node.count; ++i) {
    const auto child = slots_[node.first_slot + i].child;
    std::array<float, rows> bounds;
    if (node.holds_triangles) {
      bounds = bounds_of(grown(points.box(mesh.triangles[at(child)]), by));
    } else {
      std::memcpy(bounds.data(), box(child), sizeof(bounds));
    }
    for (std::size_t row = 0; row < rows; ++row) {
      first[row * node.count + i] = bounds[row];
      const bool is_lower = row / 3 % 2 == 0;
      own[row] = i == 0     ? bounds[row]
                 : is_lower ? std::min(own[row], bounds[row])
                            : std::max(own[row], bounds[row]);
    }
  }
}

bool WideTree::refit(const Topology& mesh, const RoundedPositions& points, FloatLanes by,
                     PacedStop& pace) {
  constexpr std::uint64_t work_of_node = 16;
  constexpr std::size_t nodes_of_piece = 256;
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
