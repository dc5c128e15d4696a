#include "detector/search/sheets.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "detector/geometry/orientation.h"
#include "detector/mesh/for_all.h"

namespace assay::detector {
namespace {

// An edge of a contour, in the plane of its projection: from its left end to its right end, or
// upward if it is upright.
struct ContourEdge {
  Point left, right;  // the third coordinate is 0
  std::int32_t left_vertex, right_vertex;
  std::int32_t way;        // 1 if its triangle is above it, -1 if below, 0 if it stands upright
  std::int32_t below = 0;  // how many triangles of the sheet lie below its left end
  bool passes(double place) const { return left[0] <= place && place < right[0]; }
  // On which side of its line a point lies; 0 if that is not sure, `own_end` for its own ends.
  static constexpr int own_end = 2;
  int side_of(const Point& point, std::int32_t vertex) const {
    if (vertex == left_vertex || vertex == right_vertex) return own_end;
    return sure_side(left, right, point, 2);
  }
  // Returns the side of another edge; 0 for an edge that is on both sides, or has both ends in
  // common.
  int side_of(const ContourEdge& edge) const {
    const int l = side_of(edge.left, edge.left_vertex), r = side_of(edge.right, edge.right_vertex);
    return l == own_end ? r % own_end : r == own_end || r == l ? l : 0;
  }
};

// Notes whether one of two edges passes below the left end of the other. Returns false if they may
// meet anywhere but at a common vertex. Where one ends, to the right or upward, another may begin.
bool compare(ContourEdge& a, ContourEdge& b) {
  const auto [lo_a, hi_a] = std::minmax(a.left[1], a.right[1]);
  const auto [lo_b, hi_b] = std::minmax(b.left[1], b.right[1]);
  int order = lo_a > hi_b ? 1 : lo_b > hi_a ? -1 : b.side_of(a);
  if (order == 0) order = -a.side_of(b);
  if (order > 0 && b.passes(a.left[0])) a.below += b.way;
  if (order < 0 && a.passes(b.left[0])) b.below += a.way;
  return order != 0 || a.left_vertex == b.right_vertex || a.right_vertex == b.left_vertex;
}

}  // namespace

struct Sheets::Builder {
  const Topology& mesh;
  const PositionsView& x;
  PacedStop* pace;
  LargeArray<Places>& places;
  // By triangle: the sides from which it is seen and for which it is in no proved sheet yet.
  std::vector<std::uint8_t> open_sides;
  std::size_t comparisons;  // that may still be made
  int level = 0;
  std::size_t most_edges = 0;                           // of a contour
  std::vector<std::vector<ContourEdge>> contours = {};  // of this level, by region and direction

  // Finds the sides of a triangle. It is seen from a side if that component of its normal is not
  // small beside the greatest one. So where a sheet ends, a sheet of another side goes on.
  void look(std::size_t t) {
    const auto& [u, v, w] = mesh.triangles[t];
    const Point a = point_of(x, u), b = point_of(x, v), c = point_of(x, w);
    std::array<int, 3> sure;
    const Vector normal = normal_and_sides(a, b, c, sure);
    const auto size = [&](std::size_t axis) { return std::abs(normal[axis]); };
    const double least = .4 * std::max({size(0), size(1), size(2)});
    unsigned sides = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int side = sure[axis] * int{size(axis) >= least};
      sides |= unsigned{side > 0} << axis | unsigned{side < 0} << (3 + axis);
    }
    open_sides[t] = static_cast<std::uint8_t>(sides);
  }

  // Gives the triangles below a node their regions.
  void place(const WideTree& tree, std::int32_t n, int depth, Places region) {
    const WideTree::Node& node = tree.node(n);
    for (std::uint32_t i = 0; i < node.count; ++i) {
      const auto child = tree.child(node.first_slot + i);
      const Places below = depth == 0 ? i << of_lower : depth == 1 ? region | i : region;
      if (node.holds_triangles) {
        places[at(child)] = below;
      } else {
        place(tree, child, depth + 1, below);
      }
    }
  }

  std::size_t region_of(std::int32_t t) const {
    if (level == 0) return 0;
    return (places[at(t)] & (sheets_bit - 1)) >> of_lower * (levels - 1 - level);
  }

  void add(std::int32_t t, std::int32_t edge, unsigned sides) {
    const auto& edges = mesh.triangle_edges[at(t)];
    const std::size_t i = edges[0] == edge ? 0 : edges[1] == edge ? 1 : 2;
    const auto u = mesh.triangles[at(t)][(i + 1) % 3], v = mesh.triangles[at(t)][(i + 2) % 3];
    for (; sides != 0; sides &= sides - 1) {
      const auto direction = static_cast<Eigen::Index>(std::countr_zero(sides));
      auto& contour = contours[directions * region_of(t) + static_cast<std::size_t>(direction)];
      if (contour.size() > most_edges) continue;
      const auto p = (direction + 1) % 3, q = (direction + 2) % 3;
      const Point from = {x(u, p), x(u, q), 0}, to = {x(v, p), x(v, q), 0};
      const bool runs_right = from < to, is_above = runs_right == (direction < 3);
      const std::int32_t way = from[0] == to[0] ? 0 : is_above ? 1 : -1;
      contour.push_back(runs_right ? ContourEdge{from, to, u, v, way}
                                   : ContourEdge{to, from, v, u, way});
    }
  }

  void find_edge(std::int32_t edge) {
    const auto holders = mesh.edge_triangles.row(edge);
    const bool are_two = holders.size() == 2 && region_of(holders[0]) == region_of(holders[1]);
    const unsigned both = are_two ? open_sides[at(holders[0])] & open_sides[at(holders[1])] : 0;
    for (const auto t : holders) {
      if (const unsigned sides = open_sides[at(t)] & ~both; sides != 0) add(t, edge, sides);
    }
  }

  // Returns whether the contour is as L13 requires. A sweep compares each edge with those that
  // reach as far to the right as its left end.
  bool is_simple(std::vector<ContourEdge>& contour) {
    std::sort(contour.begin(), contour.end(),
              [](const auto& a, const auto& b) { return a.left[0] < b.left[0]; });
    std::vector<ContourEdge*> open;
    for (auto& edge : contour) {
      std::erase_if(open, [&](const auto* other) { return other->right[0] < edge.left[0]; });
      if (open.size() > comparisons) return false;
      comparisons -= open.size();
      if (!std::all_of(open.begin(), open.end(), [&](auto* o) { return compare(edge, *o); }))
        return false;
      open.push_back(&edge);
    }
    return std::all_of(contour.begin(), contour.end(), [](const ContourEdge& edge) {
      return edge.way == 0 || edge.below == (edge.way < 0);
    });
  }

  // Finds the sheets of this level. Returns false if nothing is left to look for, or if it was
  // stopped.
  bool find_sheets() {
    constexpr std::size_t few = 256, share = 16, work_of_holders = 1, work_of_contour_edge = 8;
    const std::size_t regions = std::size_t{1} << of_lower * level;
    most_edges = few + open_sides.size() / share / regions;
    contours.assign(directions * regions, {});
    if (!for_each_paced(mesh.edges.size(), work_of_holders, pace,
                        [&](std::size_t e) { find_edge(static_cast<std::int32_t>(e)); })) {
      return false;
    }
    std::vector<std::uint8_t> proved(regions);
    for (std::size_t i = 0; i < contours.size(); ++i) {
      if (contours[i].size() <= most_edges && is_simple(contours[i]))
        proved[i / directions] |= static_cast<std::uint8_t>(1 << i % directions);
      if (pace && pace->after(work_of_contour_edge * contours[i].size())) return false;
    }
    unsigned left = 0;
    for (std::size_t t = 0; t < open_sides.size(); ++t) {
      const std::size_t region = region_of(static_cast<std::int32_t>(t));
      places[t] |= Places(open_sides[t] & proved[region]) << (region_bits + directions * level);
      left |= open_sides[t] &= static_cast<std::uint8_t>(~proved[region]);
    }
    return ++level < levels && left != 0;
  }
};

Sheets::Sheets(const Topology& mesh, const WideTree& tree, const PositionsView& x, PacedStop* pace)
    : of_triangle_(mesh.triangles.size(), 0), of_node_(tree.node_count()) {
  constexpr std::size_t work_of_look = 4, few_comparisons = 10'000, few_triangles = 16;
  const std::size_t count = mesh.triangles.size();
  Builder builder{
      mesh, x, pace, of_triangle_, std::vector<std::uint8_t>(count), few_comparisons + 2 * count};
  if (!for_all_paced(count, work_of_look, pace, [&](std::size_t t) { builder.look(t); })) return;
  builder.place(tree, WideTree::root, 0, 0);
  // Triangles at an edge that two triangles pass the same way are left out of all sheets.
  for (const auto& [edge, surplus] : mesh.unmatched) {
    const auto holders = mesh.edge_triangles.row(edge);
    for (const auto t : holders) builder.open_sides[at(t)] &= holders.size() == 1 ? 0xff : 0;
  }
  while (builder.find_sheets()) {
  }
  for (auto n = static_cast<std::int32_t>(of_node_.size()); n-- > 0;) {
    const WideTree::Node& node = tree.node(n);
    for (std::size_t slot = node.first_slot; slot < node.first_slot + node.count; ++slot) {
      const auto child = at(tree.child(slot));
      const Places of_child = node.holds_triangles ? of_triangle_[child] : of_node_[child];
      of_node_[at(n)] = slot == node.first_slot ? of_child : common(of_node_[at(n)], of_child);
    }
  }
  const auto in_some = std::count_if(of_triangle_.begin(), of_triangle_.end(),
                                     [](Places of_one) { return of_one >= sheets_bit; });
  hold_most_ = static_cast<std::size_t>(in_some) > count - count / few_triangles;
}

}  // namespace assay::detector
