#include "detector/boxes/bounding_volume_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <span>

#include "detector/mesh/sort_by_key.h"

namespace assay::detector {

namespace {

Point centre_of(const std::array<std::int32_t, 3>& triangle, const PositionsView& x) {
  Point sum = {0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    // A quarter of each corner: only the order matters, and the sum cannot overflow.
    for (const auto v : triangle) sum[k] += 0.25 * x(v, static_cast<Eigen::Index>(k));
  }
  return sum;
}

// The longest side of the box with these corners. Halves: a side may be longer than the largest
// double.
std::size_t longest_side(const Point& lo, const Point& hi) {
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (.5 * hi[k] - .5 * lo[k] > .5 * hi[axis] - .5 * lo[axis]) axis = k;
  }
  return axis;
}

// The bits of a number that is not -0, in the order of numbers.
std::uint64_t ordered_bits(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  constexpr std::uint64_t sign = std::uint64_t{1} << 63;
  return bits & sign ? ~bits : bits | sign;
}

}  // namespace

// Splits ranges of triangles in halves and numbers the nodes. The triangles are sorted once along
// each axis, and each split keeps all three orders. A node with m triangles has 2m - 2 nodes below
// it, so each range knows the numbers of its nodes, and the workers share the ranges out.
struct BoundingVolumeTree::Builder {
  using Numbers = std::vector<std::int32_t>;
  // The triangles of a node, by their places in the orders.
  struct Range {
    std::int32_t node, below, component;  // below: the first of the nodes below it
    std::size_t begin, end;
    std::size_t size() const { return end - begin; }
  };
  struct Place {
    std::uint64_t key;
    std::int32_t triangle;
  };
  struct Halves {
    std::size_t axis;  // along which it is split
    std::array<Range, 2> ranges;
  };

  BoundingVolumeTree& tree;
  const Topology& mesh;
  PacedStop* pace;
  std::vector<Point> centres;     // by triangle
  std::array<Numbers, 3> orders;  // component after component, each sorted along one axis
  std::array<Numbers, 2> room;
  std::vector<std::uint8_t> is_second;  // by triangle: which half of its range it is in
  std::vector<std::size_t> first_of_component;
  std::vector<Range> large, small;  // that are still to be split

  Builder(BoundingVolumeTree& grown, const Topology& of, PacedStop* asked)
      : tree(grown), mesh(of), pace(asked) {}

  bool run(const PositionsView& x) {
    if (!find_centres(x)) return false;
    std::vector<Place> places(centres.size()), other;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!sort_along(axis, places, other)) return false;
    }
    places = other = {};  // gives their memory back
    for (auto& numbers : room) numbers.resize(mesh.triangles.size());
    is_second.resize(mesh.triangles.size());
    return grow_over_components() && split_large() && grow_small();
  }

  bool has_to_end(std::uint64_t work) { return pace && pace->after(work); }

  bool find_centres(const PositionsView& x) {
    constexpr std::uint64_t work_of_centre = 3;
    centres.resize(mesh.triangles.size());
    return for_all_paced(centres.size(), work_of_centre, pace,
                         [&](std::size_t t) { centres[t] = centre_of(mesh.triangles[t], x); });
  }

  // Those of equal centres are sorted by their numbers.
  bool sort_along(std::size_t axis, std::vector<Place>& places, std::vector<Place>& other) {
    constexpr std::uint64_t work_of_place = 1;
    const auto take = [&](std::size_t t) {
      places[t] = {ordered_bits(centres[t][axis]), static_cast<std::int32_t>(t)};
    };
    const auto key = [](const Place& place) { return place.key; };
    const auto component = [&](const Place& place) {
      return mesh.component_of_triangle[at(place.triangle)];
    };
    if (!for_all_paced(places.size(), work_of_place, pace, take) ||
        !sort_by_key(places, other, ~std::uint64_t{0}, key, pace)) {
      return false;
    }
    const std::size_t components = mesh.components.size();
    if (components > 1 && !sort_by_key(places, other, components - 1, component, pace))
      return false;
    orders[axis].resize(places.size());
    return for_all_paced(places.size(), work_of_place, pace,
                         [&](std::size_t i) { orders[axis][i] = places[i].triangle; });
  }

  Point corner(const std::array<std::int32_t, 3>& triangles) const {
    return {centres[at(triangles[0])][0], centres[at(triangles[1])][1],
            centres[at(triangles[2])][2]};
  }
  Point least(const Range& range) const {
    return corner({orders[0][range.begin], orders[1][range.begin], orders[2][range.begin]});
  }
  Point greatest(const Range& range) const {
    return corner({orders[0][range.end - 1], orders[1][range.end - 1], orders[2][range.end - 1]});
  }

  // Splits the components from each other.
  bool grow_over_components() {
    Numbers numbers(mesh.components.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    std::vector<Point> middles;
    first_of_component = {0};
    for (const auto& component : mesh.components) {
      const std::size_t begin = first_of_component.back();
      first_of_component.push_back(begin + component.triangles.size());
      // The middle of the box; any place that tells components apart would do.
      const Range range = {root, 1, 0, begin, first_of_component.back()};
      const Point lo = least(range), hi = greatest(range);
      middles.push_back(
          {.5 * lo[0] + .5 * hi[0], .5 * lo[1] + .5 * hi[1], .5 * lo[2] + .5 * hi[2]});
      if (has_to_end(1)) return false;
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
      const Range range = {node, below, component, first_of_component[at(component)],
                           first_of_component[at(component) + 1]};
      add(range);
      return below + 2 * static_cast<std::int32_t>(range.size()) - 2;
    }
    tree.component_[at(node)] = mixed_components;
    constexpr std::uint64_t work_of_split = 8;
    if (has_to_end(work_of_split * numbers.size())) return below;
    Point lo = middles[at(numbers[0])], hi = lo;
    for (const auto c : numbers) {
      for (std::size_t k = 0; k < 3; ++k) {
        lo[k] = std::min(lo[k], middles[at(c)][k]);
        hi[k] = std::max(hi[k], middles[at(c)][k]);
      }
    }
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
    constexpr std::size_t worth_sharing = 512;
    (range.size() <= worth_sharing ? small : large).push_back(range);
  }

  // Half of the triangles, as a whole number of wide nodes (WideTree) where there are enough.
  static std::size_t half_of(std::size_t count) {
    constexpr std::size_t wide = box_lanes::width;
    return count <= 2 * wide ? count / 2 : (count / 2 + wide / 2) / wide * wide;
  }

  // Says which triangles are in which half. REQUIRES two triangles or more.
  Halves mark_halves(const Range& range) {
    const std::size_t axis = longest_side(least(range), greatest(range));
    const std::size_t middle = range.begin + half_of(range.size());
    const auto& order = orders[axis];
    for (std::size_t i = range.begin; i < middle; ++i) is_second[at(order[i])] = 0;
    for (std::size_t i = middle; i < range.end; ++i) is_second[at(order[i])] = 1;
    const auto child = range.below, below = child + 2,
               below_second = below + 2 * static_cast<std::int32_t>(middle - range.begin) - 2;
    set_children(range.node, child);
    return {axis,
            {{{child, below, range.component, range.begin, middle},
              {child + 1, below_second, range.component, middle, range.end}}}};
  }

  // Brings the triangles of the first half to the front of one of the two orders along the other
  // axes.
  void divide(const Range& range, std::size_t axis, std::size_t other) {
    auto& order = orders[(axis + 1 + other) % 3];
    auto* first = order.data() + range.begin;
    auto* const begin_of_second = room[other].data() + range.begin;
    auto* second = begin_of_second;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      // Written to both, without a branch, because nobody can foretell it.
      const auto t = order[i];
      const std::size_t goes_second = is_second[at(t)];
      *first = *second = t;
      first += 1 - goes_second;
      second += goes_second;
    }
    std::copy(begin_of_second, second, first);
  }

  static constexpr std::uint64_t work_to_mark = 1, work_to_divide = 1, work_to_split = 3;

  // The workers split the large ranges, one size after the other.
  bool split_large() {
    std::vector<Halves> halves;
    while (!large.empty()) {
      halves.resize(large.size());
      const auto mark = [&](std::size_t i, std::size_t, std::size_t) {
        tree.component_[at(large[i].node)] = large[i].component;
        halves[i] = mark_halves(large[i]);
        return work_to_mark * large[i].size();
      };
      const auto divide_one = [&](std::size_t i, std::size_t, std::size_t) {
        divide(large[i / 2], halves[i / 2].axis, i % 2);
        return work_to_divide * large[i / 2].size();
      };
      if (!for_all_counted(large.size(), 1, pace, mark) ||
          !for_all_counted(2 * large.size(), 1, pace, divide_one)) {
        return false;
      }
      large.clear();
      for (const auto& of_one : halves) {
        for (const auto& range : of_one.ranges) add(range);
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
    tree.component_[at(range.node)] = range.component;
    if (range.size() == 1) {
      const auto triangle = orders[0][range.begin];
      tree.child_[at(range.node)] = ~triangle;
      tree.leaf_[at(triangle)] = range.node;
      return 1;
    }
    const Halves halves = mark_halves(range);
    for (const std::size_t other : {0, 1}) divide(range, halves.axis, other);
    return work_to_split * range.size() + grow(halves.ranges[0]) + grow(halves.ranges[1]);
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
  if (!Builder(*this, mesh, pace).run(x)) return;
  make_blocks();
  wide_ = WideTree(*this, pace);
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
  const FloatLanes by = grid_.margin(separation_ + slack) / 2;
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
