#include "detector/boxes/bounding_volume_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "detector/mesh/for_all.h"

namespace assay::detector {

namespace {

// Returns the axis of the longest side of the box with these corners. It compares halves of the
// sides, because a side may be longer than the largest double.
std::size_t longest_side(const Point& lo, const Point& hi) {
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (.5 * hi[k] - .5 * lo[k] > .5 * hi[axis] - .5 * lo[axis]) axis = k;
  }
  return axis;
}

}  // namespace

// Splits ranges of triangles in halves and numbers the nodes. A spot stands for a triangle: it
// holds the triangle's number, and its centre in integers, on a grid over its component with 2^27
// cells along the longest side. A split counts spots to find the cell along one axis that holds the
// median. Then it moves the spots on both sides of that cell to the other of two lists. A node with
// m triangles has 2m - 2 nodes below it, so each range knows the numbers of its nodes, and the
// workers share the ranges out. Spots of equal places are ordered by their numbers, so their order
// does not depend on where they stood before. In a mesh with a cut component (Cuts) the triangles
// of a wide node stay as they stood. Only ghost sweeps and normal cones look below wide nodes, and
// they need no order. The order is still the same for any number of workers, because lists are made
// in pieces of one size.
struct BoundingVolumeTree::Builder {
  using Numbers = std::vector<std::int32_t>;
  // Places lie between 2^29 and 3 * 2^29. If their bits are read as floats, these are normal
  // numbers in the same order.
  using Spot = LaneTruth;
  using Spots = LargeArray<Spot>;
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
  std::vector<Bounds> bounds;       // by component
  bool is_cut = false;              // some component was cut
  std::uint32_t placed = 0;         // triangles of the components whose ranges are made
  std::vector<Range> large, small;  // that are still to be split

  bool run() {
    for (auto& list : lists) list = Spots(mesh.triangles.size());
    return grow_over_components() && find_spots(large) && find_spots(small) && cut_large() &&
           split_large() && grow_small();
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

  // Returns the number after those of the nodes below.
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
    set_component(node, mixed_components);
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

  void set_component(std::int32_t node, std::int32_t component) {
    if (!tree.component_.empty()) tree.component_[at(node)] = component;
  }

  void set_children(std::int32_t node, std::int32_t first) {
    tree.child_[at(node)] = first;
    tree.parent_[at((first - 1) / 2)] = node;
  }

  void add(const Range& range) {
    constexpr std::size_t worth_sharing = 4096;
    (range.size() <= worth_sharing ? small : large).push_back(range);
  }

  // Finds the spots of these ranges, each of a whole component. It sums eighths of coordinates,
  // which do not overflow. If a component is a few units in the last place wide, the sums are
  // rounded by up to three times its size, so a place has up to 29 bits and a sign.
  bool find_spots(const std::vector<Range>& ranges) {
    constexpr std::uint64_t work_of_spot = 3;
    constexpr int cell_bits = 27, least_exponent = -990, origin_place = 1 << 30;
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
          spot[k] = origin_place + static_cast<std::int32_t>((sum - origin[k]) * cells);
        }
        lists[0][range.begin + i] = spot;
      };
      if (!for_all_paced(triangles.size(), work_of_spot, pace, find)) return false;
    }
    return true;
  }

  // Returns half of the triangles. A half of more than one wide node (WideTree) is rounded to whole
  // nodes.
  static std::uint32_t half_of(std::uint32_t count) {
    constexpr std::uint32_t wide = box_lanes::width;
    return count <= 2 * wide ? count / 2 : (count / 2 + wide / 2) / wide * wide;
  }

  // Returns the order along an axis.
  static std::uint64_t place_along(const Spot& spot, std::size_t axis) {
    return static_cast<std::uint64_t>(spot[axis]) << 32 | static_cast<std::uint32_t>(spot[3]);
  }

  struct Along {
    std::size_t axis;
    bool operator()(const Spot& a, const Spot& b) const {
      return place_along(a, axis) < place_along(b, axis);
    }
  };

  // The extent of some spots along the axis on which they extend farthest.
  struct Extent {
    std::size_t axis;
    std::int32_t lo, side;
  };
  // Returns the extent of `count` spots. REQUIRES count > 0.
  static Extent extent_of(const Spot* spots, std::size_t count) {
    // Four minima and four maxima take turns, because each waits for its own last result.
    constexpr std::size_t turns = 4;
    FloatLanes los[turns], his[turns];
    std::fill_n(los, turns, std::bit_cast<FloatLanes>(spots[0]));
    std::fill_n(his, turns, los[0]);
    const auto take = [&](std::size_t i, std::size_t turn) {
      const auto spot = std::bit_cast<FloatLanes>(spots[i]);
      los[turn] = least(los[turn], spot);
      his[turn] = greatest(his[turn], spot);
    };
    std::size_t i = 1;
    for (; i + turns <= count; i += turns) {
      for (std::size_t turn = 0; turn < turns; ++turn) take(i + turn, turn);
    }
    for (; i < count; ++i) take(i, 0);
    const auto lo = least(least(los[0], los[1]), least(los[2], los[3])),
               hi = greatest(greatest(his[0], his[1]), greatest(his[2], his[3]));
    const auto lowest = std::bit_cast<Spot>(lo), sides = std::bit_cast<Spot>(hi) - lowest;
    // Computed without branches, because half of these would be mispredicted.
    const std::size_t is_last = sides[2] > std::max(sides[0], sides[1]);
    const std::size_t axis = 2 * is_last + (1 - is_last) * std::size_t{sides[1] > sides[0]};
    return {axis, lowest[axis], sides[axis]};
  }

  // Splits a range in two. REQUIRES more than `few` triangles.
  Halves split(const Range& range) {
    Spot* const from = lists[range.list].data() + range.begin;
    Spot* const to = lists[1 - range.list].data() + range.begin;
    const std::uint32_t half = half_of(range.size());
    divide(from, to, range.size(), half);
    return children_of(range, half);
  }

  // Makes a node of the first `half` triangles and one of the others, which lie in the other list.
  Halves children_of(const Range& range, std::uint32_t half) {
    const auto child = range.below, below = child + 2,
               below_second = below + 2 * static_cast<std::int32_t>(half) - 2;
    set_component(range.node, range.component);
    set_children(range.node, child);
    const std::uint32_t middle = range.begin + half, list = 1 - range.list;
    return {{{child, below, range.component, range.begin, middle, list},
             {child + 1, below_second, range.component, middle, range.end, list}}};
  }

  // Sorts up to `most` spots along the axis: each goes to the place whose number is the count of
  // spots before it.
  template <std::size_t most>
  static void rank(Spot* spots, std::size_t count, std::size_t axis) {
    Spot held[most];
    std::int32_t places[most], numbers[most], before[most];
    for (std::size_t i = 0; i < most; ++i) {
      held[i] = spots[std::min(i, count - 1)];
      places[i] = i < count ? held[i][axis] : std::numeric_limits<std::int32_t>::max();
      numbers[i] = held[i][3];
    }
    std::uint32_t taken = 0;
    for (std::size_t i = 0; i < count; ++i) {
      std::int32_t sum = 0;
      for (std::size_t j = 0; j < most; ++j) sum += places[j] < places[i];
      before[i] = sum;
      taken |= std::uint32_t{1} << sum;
    }
    // Spots at one place along the axis are ordered by their numbers.
    if (taken != ~std::uint32_t{0} >> (32 - count)) {
      for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = 0; j < most; ++j)
          before[i] += (places[j] == places[i]) & (numbers[j] < numbers[i]);
      }
    }
    for (std::size_t i = 0; i < count; ++i) spots[before[i]] = held[i];
  }

  void set_leaf(std::int32_t node, std::int32_t component, std::int32_t triangle) {
    set_component(node, component);
    tree.child_[at(node)] = ~triangle;
    tree.leaf_[at(triangle)] = node;
  }

  // Makes the nodes below one whose triangles stand in one wide node, in no order.
  void split_below(std::int32_t below, std::int32_t component, const Spot* spots,
                   std::uint32_t count) {
    const std::uint32_t half = half_of(count);
    const auto grow = [&](std::int32_t node, std::int32_t first, const Spot* own,
                          std::uint32_t size) {
      if (size == 1) return set_leaf(node, component, (*own)[3]);
      set_component(node, component);
      set_children(node, first);
      split_below(first, component, own, size);
    };
    grow(below, below + 2, spots, half);
    grow(below + 1, below + 2 * static_cast<std::int32_t>(half), spots + half, count - half);
  }

  // Makes the nodes of a few triangles.
  static constexpr std::uint32_t few = 32, levels_of_few = 5;
  void grow_few(std::int32_t node, std::int32_t below, std::int32_t component, Spot* spots,
                std::uint32_t count) {
    if (count == 1) return set_leaf(node, component, spots[0][3]);
    set_component(node, component);
    set_children(node, below);
    if (count <= box_lanes::width && is_cut) return split_below(below, component, spots, count);
    const std::size_t axis = extent_of(spots, count).axis;
    if (count == 2) {
      const bool turned = place_along(spots[1], axis) < place_along(spots[0], axis);
      set_leaf(below, component, spots[turned][3]);
      return set_leaf(below + 1, component, spots[!turned][3]);
    }
    if (count <= 4) {
      rank<4>(spots, count, axis);
    } else if (count <= 8) {
      rank<8>(spots, count, axis);
    } else if (count <= 16) {
      rank<16>(spots, count, axis);
    } else {
      rank<few>(spots, count, axis);
    }
    const std::uint32_t half = half_of(count);
    grow_few(below, below + 2, component, spots, half);
    grow_few(below + 1, below + 2 * static_cast<std::int32_t>(half), component, spots + half,
             count - half);
  }

  // Brings the first half to the front.
  static void divide(Spot* from, Spot* to, std::size_t count, std::size_t half) {
    const auto [axis, lo, side] = extent_of(from, count);
    constexpr int least_bits = 5, most_bits = 10;
    const int bits = std::clamp(static_cast<int>(std::bit_width(count)), least_bits, most_bits);
    const int shift = std::max(0, static_cast<int>(std::bit_width(unsigned(side))) - bits);
    // Neighbours in the list are mostly of the same part, so each part has two counters that take
    // turns.
    std::uint32_t counts[1 << most_bits][2];
    std::memset(counts, 0, sizeof(*counts) << bits);
    const std::int32_t* const along = reinterpret_cast<const std::int32_t*>(from) + axis;
    const auto part_of = [along, shift, lo = lo](std::size_t i) {
      return unsigned(along[4 * i] - lo) >> shift;
    };
    for (std::size_t i = 0; i < count; ++i) ++counts[part_of(i)][i % 2];
    // The part that holds the first spot of the second half.
    unsigned part = 0;
    for (std::size_t before = 0; (before += counts[part][0] + counts[part][1]) <= half;) ++part;
    // Spots below the part go to the front and those above it to the back. Spots of the part itself
    // wait in places of the list that have been read.
    std::size_t below = 0, waiting = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const unsigned p = part_of(i);
      if (p == part) {
        from[waiting++] = from[i];
      } else {
        to[below + (-std::size_t{p > part} & (count - 1 - i + waiting))] = from[i];
        below += p < part;
      }
    }
    std::nth_element(from, from + (half - below), from + waiting, Along{axis});
    std::copy_n(from, waiting, to + below);
  }

  // Cuts the places of a component into 2^levels parts, by planes that halve a sample of its
  // triangles again and again. So its largest ranges are split in one pass over their triangles
  // instead of a pass for each level, and into halves that are nearly as large as each other.
  struct Cuts {
    static constexpr int least_levels = 5, most_levels = 9;
    static constexpr std::uint32_t of_part = 2048, of_sample = 32;  // triangles of a part
    struct Cut {
      std::size_t axis = 0;
      std::int32_t place = 0;
    };
    int levels;
    // Cut i has cuts 2i and 2i + 1 below it. The first one is cut 1.
    std::array<Cut, 1 << most_levels> cuts;

    // Returns how often a component is halved; 0 if its ranges are better split exactly.
    static int levels_for(std::uint32_t triangles) {
      const int levels = static_cast<int>(std::bit_width(triangles / of_part)) - 1;
      return levels < least_levels ? 0 : std::min(levels, most_levels);
    }

    Cuts(const Spot* spots, std::uint32_t count) : levels(levels_for(count)) {
      std::vector<Spot> sample(of_sample << levels);
      for (std::size_t i = 0; i < sample.size(); ++i) sample[i] = spots[i * count / sample.size()];
      halve(sample, 1);
    }

    void halve(std::span<Spot> sample, std::size_t cut) {
      if (sample.size() == of_sample) return;
      const std::size_t axis = extent_of(sample.data(), sample.size()).axis;
      const auto middle = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
      std::nth_element(sample.begin(), middle, sample.end(), Along{axis});
      cuts[cut] = {axis, (*middle)[axis]};
      halve(sample.first(sample.size() / 2), 2 * cut);
      halve(sample.last(sample.size() / 2), 2 * cut + 1);
    }

    // Writes the numbers of the parts that hold some spots. They take turns, because each waits for
    // its own last cut.
    template <std::size_t spots_at_once>
    void find_parts(const Spot* spots, std::uint16_t* parts) const {
      std::size_t cut[spots_at_once];
      std::fill_n(cut, spots_at_once, 1);
      for (int level = 0; level < levels; ++level) {
        for (std::size_t i = 0; i < spots_at_once; ++i) {
          const auto [axis, place] = cuts[cut[i]];
          cut[i] = 2 * cut[i] + std::size_t{spots[i][axis] >= place};
        }
      }
      for (std::size_t i = 0; i < spots_at_once; ++i)
        parts[i] = static_cast<std::uint16_t>(cut[i] - (std::size_t{1} << levels));
    }
  };

  // The workers cut the largest components.
  bool cut_large() {
    for (const auto& range : std::exchange(large, {})) {
      if (Cuts::levels_for(range.size()) == 0) {
        large.push_back(range);
      } else if (!cut(range)) {
        return false;
      } else {
        is_cut = true;
      }
    }
    return true;
  }

  bool cut(const Range& range) {
    constexpr std::size_t of_piece = 16'384;
    constexpr std::uint64_t work_to_cut = 2;
    const Spot* const from = lists[range.list].data() + range.begin;
    Spot* const to = lists[1 - range.list].data() + range.begin;
    const Cuts cuts(from, range.size());
    const std::size_t parts = std::size_t{1} << cuts.levels;
    LargeArray<std::uint16_t> part_of(range.size());
    // By piece and part: how many triangles there are, then where the next of them goes.
    std::vector<std::uint32_t> next((range.size() / of_piece + 1) * parts);
    const auto count = [&](std::size_t i, std::size_t end, std::size_t) {
      auto* const counts = &next[i / of_piece * parts];
      constexpr std::size_t turns = 8;
      std::size_t j = i;
      for (; j + turns <= end; j += turns) cuts.find_parts<turns>(&from[j], &part_of[j]);
      for (; j < end; ++j) cuts.find_parts<1>(&from[j], &part_of[j]);
      for (; i < end; ++i) ++counts[part_of[i]];
    };
    if (!for_all_pieces(range.size(), of_piece, work_to_cut, pace, count)) return false;
    std::vector<std::uint32_t> starts;
    std::uint32_t before = 0;
    for (std::size_t part = 0; part < parts; ++part) {
      starts.push_back(before);
      for (std::size_t i = part; i < next.size(); i += parts)
        before += std::exchange(next[i], before);
    }
    starts.push_back(before);
    const auto move = [&](std::size_t i, std::size_t end, std::size_t) {
      auto* const places = &next[i / of_piece * parts];
      for (; i < end; ++i) to[places[part_of[i]]++] = from[i];
    };
    if (!for_all_pieces(range.size(), of_piece, work_to_cut, pace, move)) return false;
    add_parts(range, starts);
    return true;
  }

  // Makes the nodes above some parts. Small parts that lie side by side stay one range, which is
  // split exactly. starts: where each part begins, and the end of the last one.
  void add_parts(Range range, std::span<const std::uint32_t> starts) {
    const std::size_t middle = starts.size() / 2, parts = starts.size() - 1;
    if (parts == 1 || range.size() <= Cuts::of_part) {
      range.list = 1 - range.list;
      return add(range);
    }
    const auto first = starts.first(middle + 1), second = starts.subspan(middle);
    const std::uint32_t half = first.back() - first.front();
    if (half == 0) return add_parts(range, second);
    if (half == range.size()) return add_parts(range, first);
    auto [below, above] = children_of(range, half);
    for (auto* one : {&below, &above}) one->list = range.list;
    add_parts(below, first);
    add_parts(above, second);
  }

  static constexpr std::uint64_t work_to_split = 3;

  // Splits the large ranges, one size after the other. The workers share the ranges of a size.
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
    if (range.size() <= few) {
      grow_few(range.node, range.below, range.component, lists[range.list].data() + range.begin,
               range.size());
      return levels_of_few * work_to_split * range.size();
    }
    const Halves halves = split(range);
    return work_to_split * range.size() + grow(halves[0]) + grow(halves[1]);
  }
};

BoundingVolumeTree::BoundingVolumeTree(const Topology& mesh, const PositionsView& x,
                                       PacedStop* pace) {
  child_.resize(2 * mesh.triangles.size() - 1);
  parent_.resize(mesh.triangles.size() - 1);
  leaf_.resize(mesh.triangles.size());
  if (mesh.components.size() > 1) component_.resize(child_.size());
  component_root_.resize(mesh.components.size());
  Builder builder{*this, mesh, x, pace, {}, {}, false, 0, {}, {}};
  if (!builder.run()) return;
  builder.lists = {};  // gives their memory back
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
  wide_.make_room(motion.is_at_rest());
  RoundedPositions points;  // allocated last, and freed before the search allocates its own
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
  boxes_.resize(node_count());
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
