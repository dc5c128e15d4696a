#include "detector/boxes/bounding_volume_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <span>

#include "detector/mesh/for_all.h"

namespace assay::detector {

namespace {

// The longest side of the box with these corners. Halves: a side may be longer than the largest
// double.
std::size_t longest_side(const Point& lo, const Point& hi) {
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (.5 * hi[k] - .5 * lo[k] > .5 * hi[axis] - .5 * lo[axis]) axis = k;
  }
  return axis;
}

}  // namespace

// Splits ranges of triangles in halves and numbers the nodes. What is split are spots: the centre
// of a triangle in integers, on a grid over its component with 2^27 cells along the longest side,
// and the triangle's number. A split finds the cell along one axis that holds the median by
// counting, and brings the spots on both sides of it to the other of two lists. A node with m
// triangles has 2m - 2 nodes below it, so each range knows the numbers of its nodes, and the
// workers share the ranges out. Which spots come first does not depend on where they stood: those
// of equal places are in the order of their numbers.
struct BoundingVolumeTree::Builder {
  using Numbers = std::vector<std::int32_t>;
  using Spot = std::array<std::int32_t, 4>;
  using Spots = std::unique_ptr<Spot[]>;
  // The triangles of a node, by their places in the lists.
  struct Range {
    std::int32_t node, below, component;  // below: the first of the nodes below it
    std::uint32_t begin, end;
    std::uint32_t list;  // that holds them
    std::uint32_t size() const { return end - begin; }
  };
  using Halves = std::array<Range, 2>;

  BoundingVolumeTree& tree;
  const Topology& mesh;
  const PositionsView& x;
  PacedStop* pace;
  std::array<Spots, 2> lists;       // component after component
  Numbers order;                    // the triangles in the order of the leaves
  std::vector<Bounds> bounds;       // by component
  std::uint32_t placed = 0;         // the triangles of the components that have their ranges
  std::vector<Range> large, small;  // that are still to be split

  bool run() {
    order.resize(mesh.triangles.size());
    for (auto& list : lists) list = std::make_unique_for_overwrite<Spot[]>(order.size());
    return grow_over_components() && find_spots(large) && find_spots(small) && split_large() &&
           grow_small();
  }

  bool has_to_end(std::uint64_t work) { return pace && pace->after(work); }

  // Splits the components from each other.
  bool grow_over_components() {
    Numbers numbers(mesh.components.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    std::vector<Point> middles;
    for (const auto& component : mesh.components) {
      const auto vertex = [&](std::size_t i) { return point_of(x, component.vertices[i]); };
      const auto& [lo, hi] =
          bounds.emplace_back(bounds_of(component.vertices.size(), vertex, pace));
      if (has_to_end(1)) return false;
      // The middle of the box; any place that tells components apart would do.
      middles.push_back(
          {.5 * lo[0] + .5 * hi[0], .5 * lo[1] + .5 * hi[1], .5 * lo[2] + .5 * hi[2]});
    }
    grow_over_components(root, 1, numbers, middles);
    return !has_to_end(1);
  }

  // Returns the first number behind those of the nodes below.
  std::int32_t grow_over_components(std::int32_t node, std::int32_t below,
                                    std::span<std::int32_t> numbers,
                                    const std::vector<Point>& middles) {
    if (numbers.size() == 1) {
      const auto component = numbers[0];
      tree.component_root_[at(component)] = node;
      const auto count =
          static_cast<std::uint32_t>(mesh.components[at(component)].triangles.size());
      add({node, below, component, placed, placed + count, 0});
      placed += count;
      return below + 2 * static_cast<std::int32_t>(count) - 2;
    }
    tree.component_[at(node)] = mixed_components;
    constexpr std::uint64_t work_of_split = 8;
    if (has_to_end(work_of_split * numbers.size())) return below;
    const auto [lo, hi] = bounds_of(
        numbers.size(), [&](std::size_t i) { return middles[at(numbers[i])]; }, nullptr);
    const std::size_t axis = longest_side(lo, hi), middle = numbers.size() / 2;
    std::nth_element(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(middle),
                     numbers.end(), [&](std::int32_t a, std::int32_t b) {
                       const double p = middles[at(a)][axis], q = middles[at(b)][axis];
                       return p != q ? p < q : a < b;
                     });
    set_children(node, below);
    const auto end = grow_over_components(below, below + 2, numbers.first(middle), middles);
    return grow_over_components(below + 1, end, numbers.subspan(middle), middles);
  }

  void set_children(std::int32_t node, std::int32_t first) {
    tree.child_[at(node)] = first;
    tree.parent_[at((first - 1) / 2)] = node;
  }

  void add(const Range& range) {
    constexpr std::size_t worth_sharing = 4096;
    (range.size() <= worth_sharing ? small : large).push_back(range);
  }

  // Finds the spots of these ranges, each of a whole component. Sums of eighths do not overflow. In
  // a component of a few units in the last place they are rounded by up to three times its size, so
  // a place has up to 29 bits and a sign.
  bool find_spots(const std::vector<Range>& ranges) const {
    constexpr std::uint64_t work_of_spot = 3;
    constexpr int cell_bits = 27, least_exponent = -990;
    for (const auto& range : ranges) {
      const auto& triangles = mesh.components[at(range.component)].triangles;
      const auto& [lo, hi] = bounds[at(range.component)];
      int exponent = least_exponent;
      for (std::size_t k = 0; k < 3; ++k) {
        int of_side = 0;
        std::frexp(.375 * hi[k] - .375 * lo[k], &of_side);
        exponent = std::max(exponent, of_side);
      }
      const double cells = std::ldexp(1.0, cell_bits - exponent);
      const Point origin = {.375 * lo[0], .375 * lo[1], .375 * lo[2]};
      const auto find = [&](std::size_t i) {
        const auto t = triangles[i];
        const auto& [u, v, w] = mesh.triangles[at(t)];
        Spot spot = {0, 0, 0, t};
        for (std::size_t k = 0; k < 3; ++k) {
          const auto axis = static_cast<Eigen::Index>(k);
          const double sum = .125 * x(u, axis) + .125 * x(v, axis) + .125 * x(w, axis);
          spot[k] = static_cast<std::int32_t>((sum - origin[k]) * cells);
        }
        lists[0][range.begin + i] = spot;
      };
      if (!for_all_paced(triangles.size(), work_of_spot, pace, find)) return false;
    }
    return true;
  }

  // Half of the triangles, as a whole number of wide nodes (WideTree) where there are enough.
  static std::uint32_t half_of(std::uint32_t count) {
    constexpr std::uint32_t wide = box_lanes::width;
    return count <= 2 * wide ? count / 2 : (count / 2 + wide / 2) / wide * wide;
  }

  // The order along an axis.
  static std::uint64_t place_along(const Spot& spot, std::size_t axis) {
    constexpr std::int64_t lowest = 1 << 30;
    return static_cast<std::uint64_t>(spot[axis] + lowest) << 32 |
           static_cast<std::uint32_t>(spot[3]);
  }

  // Splits a range in two. REQUIRES two triangles or more.
  Halves split(const Range& range) {
    const Spot* const from = lists[range.list].get() + range.begin;
    Spot* const to = lists[1 - range.list].get() + range.begin;
    const std::uint32_t count = range.size(), half = half_of(count);
    Spot lo = from[0], hi = from[0];
    for (std::size_t i = 1; i < count; ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        lo[k] = std::min(lo[k], from[i][k]);
        hi[k] = std::max(hi[k], from[i][k]);
      }
    }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (hi[k] - lo[k] > hi[axis] - lo[axis]) axis = k;
    }
    if (count <= few) {
      rank(from, to, count, axis);
    } else {
      divide(from, to, count, axis, half, lo[axis], hi[axis] - lo[axis]);
    }
    const auto child = range.below, below = child + 2,
               below_second = below + 2 * static_cast<std::int32_t>(half) - 2;
    tree.component_[at(range.node)] = range.component;
    set_children(range.node, child);
    const std::uint32_t middle = range.begin + half, list = 1 - range.list;
    return {{{child, below, range.component, range.begin, middle, list},
             {child + 1, below_second, range.component, middle, range.end, list}}};
  }

  // Sorts a few spots along the axis: each goes to the place that says how many come before it.
  static constexpr std::size_t few = 8;
  static void rank(const Spot* from, Spot* to, std::size_t count, std::size_t axis) {
    std::uint64_t places[few];
    for (std::size_t i = 0; i < count; ++i) places[i] = place_along(from[i], axis);
    for (std::size_t i = 0; i < count; ++i) {
      std::size_t before = 0;
      for (std::size_t j = 0; j < count; ++j) before += places[j] < places[i];
      to[before] = from[i];
    }
  }

  // Brings the first half to the front.
  static void divide(const Spot* from, Spot* to, std::size_t count, std::size_t axis,
                     std::size_t half, std::int32_t lo, std::int32_t side) {
    constexpr int least_bits = 5, most_bits = 10;
    const int bits = std::clamp(static_cast<int>(std::bit_width(count)), least_bits, most_bits);
    const int shift = std::max(0, static_cast<int>(std::bit_width(unsigned(side))) - bits);
    std::array<std::uint32_t, 1 << most_bits> counts;
    std::fill_n(counts.begin(), std::size_t{1} << bits, 0);
    const auto part_of = [&](std::size_t i) { return unsigned(from[i][axis] - lo) >> shift; };
    for (std::size_t i = 0; i < count; ++i) ++counts[part_of(i)];
    // The part that holds the last spot of the first half.
    std::size_t before = 0;
    unsigned part = 0;
    while (before + counts[part] < half) before += counts[part++];
    Spot* const middle = to + before;
    Spot* const behind = middle + counts[part];
    std::array<Spot*, 3> next = {to, middle, behind};  // below the part, in it, above
    for (std::size_t i = 0; i < count; ++i) {
      const unsigned p = part_of(i);
      *next[std::size_t{p >= part} + std::size_t{p > part}]++ = from[i];
    }
    if (to + half == behind) return;
    std::nth_element(middle, to + half, behind, [axis](const Spot& a, const Spot& b) {
      return place_along(a, axis) < place_along(b, axis);
    });
  }

  static constexpr std::uint64_t work_to_split = 3;

  // The workers split the large ranges, one size after the other.
  bool split_large() {
    std::vector<Halves> halves;
    while (!large.empty()) {
      halves.resize(large.size());
      const auto split_one = [&](std::size_t i, std::size_t, std::size_t) {
        halves[i] = split(large[i]);
        return work_to_split * large[i].size();
      };
      if (!for_all_counted(large.size(), 1, pace, split_one)) return false;
      large.clear();
      for (const auto& of_one : halves) {
        for (const auto& range : of_one) add(range);
      }
    }
    return true;
  }

  bool grow_small() {
    const std::size_t of_piece = 1 + small.size() / 1024;  // components may be tiny
    return for_all_counted(small.size(), of_piece, pace,
                           [&](std::size_t i, std::size_t end, std::size_t) {
                             std::uint64_t work = 0;
                             for (; i < end; ++i) work += grow(small[i]);
                             return work;
                           });
  }

  // Returns the work that it took.
  std::uint64_t grow(const Range& range) {
    if (range.size() == 1) {
      const auto triangle = lists[range.list][range.begin][3];
      tree.component_[at(range.node)] = range.component;
      tree.child_[at(range.node)] = ~triangle;
      tree.leaf_[at(triangle)] = range.node;
      order[range.begin] = triangle;
      return 1;
    }
    const Halves halves = split(range);
    return work_to_split * range.size() + grow(halves[0]) + grow(halves[1]);
  }
};

BoundingVolumeTree::BoundingVolumeTree(const Topology& mesh, const PositionsView& x,
                                       PacedStop* pace) {
  const std::size_t nodes = 2 * mesh.triangles.size() - 1;
  child_.resize(nodes);
  component_.resize(nodes);
  parent_.resize(mesh.triangles.size() - 1);
  leaf_.resize(mesh.triangles.size());
  component_root_.resize(mesh.components.size());
  Builder builder{*this, mesh, x, pace, {}, {}, {}, 0, {}, {}};
  if (!builder.run()) return;
  builder.lists = {};  // gives their memory back
  make_blocks();
  wide_ = WideTree(*this, builder.order, pace);
}

void BoundingVolumeTree::make_blocks() {
  std::vector<Block> open = {{root, 1, static_cast<std::int32_t>(node_count())}};
  while (!open.empty()) {
    const Block block = open.back();
    open.pop_back();
    if (block.last - block.first < nodes_of_block) {
      blocks_.push_back(block);
      continue;
    }
    above_blocks_.push_back(block.top);
    // After the two children come all nodes below the first one, then all below the second.
    const auto child = block.first, below = child + 2;
    const auto middle = is_leaf(child + 1) ? block.last : this->child(child + 1);
    open.push_back({child, below, middle});
    open.push_back({child + 1, middle, block.last});
  }
  std::sort(above_blocks_.begin(), above_blocks_.end());
}

MovingBox BoundingVolumeTree::box_of_triangle(const std::array<std::int32_t, 3>& corners,
                                              const SteppedMesh& motion) const {
  return box_of(grid_(motion, corners[0]), grid_(motion, corners[1]), grid_(motion, corners[2]));
}

void BoundingVolumeTree::refit(const Topology& mesh, const SteppedMesh& motion) {
  PacedStop pace(never_stops);
  refit(mesh, motion, pace);
}

bool BoundingVolumeTree::refit(const Topology& mesh, const SteppedMesh& motion, PacedStop& pace,
                               double slack) {
  forget_fit();
  boxes_are_joined_ = false;
  RoundedPositions points;  // given back before the search takes room for its own
  if (!points.assign(motion, pace)) return false;
  grid_ = points.grid();
  const double distance = separation_ + slack;
  const FloatLanes by =
      motion.is_at_rest() && distance == 0 ? FloatLanes{} : grid_.margin(distance) / 2;
  if (!wide_.refit(mesh, points, by, pace)) return false;
  if (slack == 0) fitted_to_ = Arrays(motion);
  return true;
}

bool BoundingVolumeTree::join_boxes(PacedStop* pace) const {
  if (boxes_are_joined_) return true;
  constexpr std::uint64_t work_of_node = 2;
  constexpr std::size_t nodes_of_piece = 512;
  if (!boxes_) boxes_ = std::make_unique_for_overwrite<MovingBox[]>(node_count());
  const auto take_leaves = [&](std::size_t begin, std::size_t end, std::size_t) {
    for (; begin < end; ++begin) {
      const auto n = static_cast<std::int32_t>(begin);
      const WideTree::Node& node = wide_.node(n);
      if (!node.holds_triangles) continue;
      for (std::size_t i = 0; i < node.count; ++i)
        boxes_[at(wide_.binary(node.first_slot + i))] = box_of(wide_.children(n), i);
    }
  };
  const auto join_children = [&](std::int32_t node) {
    const std::int32_t child = child_[at(node)];
    if (child >= 0) boxes_[at(node)] = join(boxes_[at(child)], boxes_[at(child) + 1]);
  };
  boxes_are_joined_ =
      for_all_pieces(wide_.node_count(), nodes_of_piece, work_of_node, pace, take_leaves) &&
      for_each_upward(work_of_node, pace, join_children);
  return boxes_are_joined_;
}

bool BoundingVolumeTree::fit_once(const Topology& mesh, const SteppedMesh& motion,
                                  PacedStop& pace) {
  return fitted_to_ == Arrays(motion) || refit(mesh, motion, pace);
}

}  // namespace assay::detector
