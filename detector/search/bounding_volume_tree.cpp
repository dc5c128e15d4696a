#include "detector/search/bounding_volume_tree.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "detector/mesh/paced_stop.h"

namespace assay::detector {

// Splits a range of items at the median centre and numbers the nodes.
struct BoundingVolumeTree::Builder {
  using Items = std::span<std::int32_t>;

  BoundingVolumeTree& tree;
  const Topology& mesh;
  std::vector<Point> triangle_centres, component_centres;
  std::vector<std::int32_t> order;  // of the triangles of one component
  PacedStop* pace;

  Builder(BoundingVolumeTree& grown, const Topology& of, const PositionsView& x, PacedStop* asked)
      : tree(grown), mesh(of), pace(asked) {
    constexpr std::uint64_t work_of_centre = 3;
    triangle_centres.reserve(mesh.triangles.size());
    const auto add = [&](std::size_t t) {
      triangle_centres.push_back(centre(mesh.triangles[t], x));
    };
    if (!for_each_paced(mesh.triangles.size(), work_of_centre, pace, add)) return;
    for (const auto& component : mesh.components) {
      if (has_to_end(component.triangles.size())) return;
      // The middle of the box; any place that tells components apart would do.
      Point lo = triangle_centres[at(component.triangles.front())], hi = lo;
      for (const auto t : component.triangles) widen(lo, hi, triangle_centres[at(t)]);
      component_centres.push_back(
          {.5 * lo[0] + .5 * hi[0], .5 * lo[1] + .5 * hi[1], .5 * lo[2] + .5 * hi[2]});
    }
  }

  static Point centre(const std::array<std::int32_t, 3>& triangle, const PositionsView& x) {
    Point sum = {0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
      // A quarter of each corner: only the order matters, and the sum cannot overflow.
      for (const auto v : triangle) sum[k] += 0.25 * x(v, static_cast<Eigen::Index>(k));
    }
    return sum;
  }

  static void widen(Point& lo, Point& hi, const Point& p) {
    for (std::size_t k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
    }
  }

  static std::size_t split(Items items, const std::vector<Point>& centres) {
    Point lo = centres[at(items[0])], hi = lo;
    for (const auto i : items) widen(lo, hi, centres[at(i)]);
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      // Halves: a side may be longer than the largest double.
      if (.5 * hi[k] - .5 * lo[k] > .5 * hi[axis] - .5 * lo[axis]) axis = k;
    }
    const std::size_t middle = items.size() / 2;
    std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(middle),
                     items.end(), [&](std::int32_t a, std::int32_t b) {
                       const double p = centres[at(a)][axis], q = centres[at(b)][axis];
                       return p != q ? p < q : a < b;
                     });
    return middle;
  }

  bool has_to_end(std::uint64_t work) { return pace && pace->after(work); }
  // A split looks at each item some eight times.
  bool has_to_end(Items items) { return has_to_end(8 * items.size()); }

  std::int32_t add_children(std::int32_t node) {
    const auto first = static_cast<std::int32_t>(tree.child_.size());
    tree.child_[at(node)] = first;
    tree.child_.resize(tree.child_.size() + 2);
    tree.component_.resize(tree.component_.size() + 2);
    tree.parent_.push_back(node);
    return first;
  }

  void grow_over_components(std::int32_t node, Items components) {
    if (components.size() == 1) {
      tree.component_root_[at(components[0])] = node;
      order = mesh.components[at(components[0])].triangles;
      grow_over_triangles(node, order, components[0]);
      return;
    }
    tree.component_[at(node)] = mixed_components;
    if (has_to_end(components)) return;
    const std::size_t middle = split(components, component_centres);
    const auto first = add_children(node);
    grow_over_components(first, components.first(middle));
    grow_over_components(first + 1, components.subspan(middle));
  }

  void grow_over_triangles(std::int32_t node, Items triangles, std::int32_t component) {
    tree.component_[at(node)] = component;
    if (triangles.size() == 1) {
      tree.child_[at(node)] = ~triangles[0];
      tree.leaf_[at(triangles[0])] = node;
      return;
    }
    if (has_to_end(triangles)) return;
    const std::size_t middle = split(triangles, triangle_centres);
    const auto first = add_children(node);
    grow_over_triangles(first, triangles.first(middle), component);
    grow_over_triangles(first + 1, triangles.subspan(middle), component);
  }
};

BoundingVolumeTree::BoundingVolumeTree(const Topology& mesh, const PositionsView& x,
                                       PacedStop* pace) {
  const std::size_t nodes = 2 * mesh.triangles.size() - 1;
  child_.reserve(nodes);
  component_.reserve(nodes);
  parent_.reserve(mesh.triangles.size());
  child_.resize(1);
  component_.resize(1);
  leaf_.resize(mesh.triangles.size());
  component_root_.resize(mesh.components.size());
  boxes_.reserve(nodes);
  constexpr std::uint64_t work_of_room = 5;  // the system clears it
  const auto add_box = [this](std::size_t) { boxes_.emplace_back(); };
  if (!for_each_paced(nodes, work_of_room, pace, add_box)) return;
  std::vector<std::int32_t> components(mesh.components.size());
  std::iota(components.begin(), components.end(), 0);
  Builder builder(*this, mesh, x, pace);
  if (!(pace && pace->stopped())) builder.grow_over_components(root, components);
  if (!(pace && pace->stopped())) make_blocks();
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
  constexpr std::uint64_t work_of_node = 4;
  forget_fit();
  RoundedPositions points;  // given back before the search takes room for its own
  if (!points.assign(motion, pace)) return false;
  grid_ = points.grid();
  const FloatLanes by = grid_.margin(separation_ + slack) / 2;
  const bool completed = for_each_upward(work_of_node, &pace, [&](std::int32_t node) {
    const std::int32_t child = child_[at(node)];
    boxes_[at(node)] = child < 0 ? grown(points.box(mesh.triangles[at(~child)]), by)
                                 : join(boxes_[at(child)], boxes_[at(child) + 1]);
  });
  if (completed && slack == 0) fitted_to_ = Arrays(motion);
  return completed;
}

bool BoundingVolumeTree::fit_once(const Topology& mesh, const SteppedMesh& motion,
                                  PacedStop& pace) {
  return fitted_to_ == Arrays(motion) || refit(mesh, motion, pace);
}

}  // namespace assay::detector
