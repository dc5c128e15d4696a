
#include <algorithm>
#include <array>

#include "detector/boxes/bounding_volume_tree.h"
#include "detector/mesh/for_all.h"

namespace assay::detector {
namespace {

using box_lanes::width;

// Writes the bounds of a box in the order of the rows, `stride` floats apart; those at t=1 only if
// the mesh moves.
void write_rows(const MovingBox& box, bool moves, float* first, std::size_t stride) {
  const auto three = [&](std::size_t row, FloatLanes bounds) {
    for (std::size_t k = 0; k < 3; ++k) first[(row + k) * stride] = bounds[k];
  };
  three(0, box.lo_t0);
  three(3, box.hi_t0);
  if (!moves) return;
  three(6, box.lo_t1);
  three(9, box.hi_t1);
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
    const bool mixed = is_mixed(top);
    subtrees[0] = top;
    std::size_t count = 1;
    while (count < width) {
      std::size_t largest = width;
      for (std::size_t i = 0; i < count; ++i) {
        // Beside other components, a subtree of one component stays closed: it is a node of its
        // own.
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

  // Adds the triangles. In a node of a few triangles the first half is no larger than the second,
  // so the order of its leaves is that of their numbers.
  void add_triangles(const Subtree& of, std::size_t slot) {
    if (binary.is_leaf(of.top)) wide.slots_[slot] = {of.top, binary.triangle(of.top)};
    for (auto node = of.first; node < of.last; ++node) {
      if (binary.is_leaf(node)) wide.slots_[slot++] = {node, binary.triangle(node)};
    }
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
    if (small) {
      add_triangles(top, first);
    } else {
      for (std::size_t i = 0; i < count; ++i) {
        const auto child = add(subtrees[i]);
        wide.slots_[first + i] = {subtrees[i].top, child};
      }
    }
    return n;
  }
};

WideTree::WideTree(const BoundingVolumeTree& binary, PacedStop* pace) {
  // Enough for a mesh of few components. For other meshes the lists grow, and are cut to size.
  const std::size_t triangles = binary.node_count() / 2 + 1, expected = triangles / 6 + width;
  nodes_.reserve(expected);
  binary_of_.reserve(expected);
  slots_.reserve(triangles + expected);
  Builder builder{*this, binary, pace};
  builder.add({BoundingVolumeTree::root, 1, static_cast<std::int32_t>(binary.node_count())});
  const auto cut = [](auto& list) {
    if (list.capacity() - list.size() > list.size() / 8) list.shrink_to_fit();
  };
  cut(nodes_);
  cut(slots_);
  cut(binary_of_);
  cut(inner_);
}

void WideTree::make_room(bool at_rest) {
  end_ = at_rest ? 0 : box_lanes::rows / 2;
  const std::size_t room = rows() * slots_.size() + width;
  if (boxes_.size() >= room) return;
  boxes_ = LargeArray<float>(room);
  own_ = LargeArray<float>(rows() * nodes_.size());
}

void WideTree::refit_node(std::int32_t n, const Topology& mesh, const RoundedPositions& points,
                          FloatLanes by) {
  const Node& node = nodes_[at(n)];
  float* const first = boxes_.data() + rows() * node.first_slot;
  MovingBox whole;
  for (std::size_t i = 0; i < node.count; ++i) {
    const auto child = slots_[node.first_slot + i].child;
    const MovingBox box_of_child = node.holds_triangles
                                       ? grown(points.box(mesh.triangles[at(child)]), by)
                                       : box_of({box(child), 1, end_}, 0);
    write_rows(box_of_child, end_ != 0, first + i, node.count);
    whole = i == 0 ? box_of_child : join(whole, box_of_child);
  }
  write_rows(whole, end_ != 0, own_.data() + rows() * at(n), 1);
}

bool WideTree::refit(const Topology& mesh, const RoundedPositions& points, FloatLanes by,
                     PacedStop& pace) {
  constexpr std::uint64_t work_of_node = 16;
  constexpr std::size_t nodes_of_piece = 256;
  std::fill_n(boxes_.data() + rows() * slots_.size(), width, 0.0F);
  const auto fit_leaves = [&](std::size_t begin, std::size_t end, std::size_t) {
    for (; begin < end; ++begin) {
      if (nodes_[begin].holds_triangles)
        refit_node(static_cast<std::int32_t>(begin), mesh, points, by);
    }
  };
  if (!for_all_pieces(nodes_.size(), nodes_of_piece, work_of_node, &pace, fit_leaves)) return false;
  const auto fit_inner = [&](std::size_t i) { refit_node(inner_[i], mesh, points, by); };
  // The nodes below a child of the root have consecutive numbers, so threads can share these
  // subtrees. A thread does not stop within a subtree, so that of a large mesh would be too long.
  constexpr std::size_t worth_sharing = 64, too_long = 8192;
  if (!has_workers(&pace) || inner_.size() < worth_sharing || inner_.size() > too_long) {
    return for_each_paced(inner_.size(), work_of_node, &pace,
                          [&](std::size_t i) { fit_inner(inner_.size() - 1 - i); });
  }
  const Node& top = nodes_[at(root)];
  const auto begin_of = [&](std::size_t subtree) {
    const auto end = inner_.end();
    const auto begin = subtree == top.count
                           ? end
                           : std::lower_bound(inner_.begin(), end, child(top.first_slot + subtree));
    return static_cast<std::size_t>(begin - inner_.begin());
  };
  const auto fit_subtree = [&](std::size_t subtree, std::size_t, std::size_t) {
    const std::size_t begin = begin_of(subtree), end = begin_of(subtree + 1);
    for (std::size_t i = end; i-- > begin;) fit_inner(i);
    return work_of_node * static_cast<std::uint64_t>(end - begin);
  };
  if (!for_all_counted(top.count, 1, &pace, fit_subtree)) return false;
  fit_inner(0);
  return true;
}

}  // namespace assay::detector
