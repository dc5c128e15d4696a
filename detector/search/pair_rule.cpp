#include "detector/search/pair_rule.h"

#include <bit>
#include <cassert>
#include <cstring>

namespace assay::detector {
PairTable& PairTable::add(std::uint8_t a, std::uint8_t b) {
  partners_[a] |= b;
  partners_[b] |= a;
  update();
  return *this;
}

PairTable& PairTable::remove(std::uint8_t a, std::uint8_t b) {
  partners_[a] &= static_cast<std::uint8_t>(~b);
  partners_[b] &= static_cast<std::uint8_t>(~a);
  update();
  return *this;
}

// Makes the rows of unions of flags from the rows of single flags.
void PairTable::update() {
  for (std::size_t flags = 0; flags < unions; ++flags) {
    const std::size_t lowest = flags & (~flags + 1);
    if (lowest != flags) partners_[flags] = partners_[lowest] | partners_[flags ^ lowest];
  }
}

PairTable PairTable::joined_with(const PairTable& other) const {
  PairTable both = *this;
  for (std::size_t flags = 0; flags < unions; ++flags)
    both.partners_[flags] |= other.partners_[flags];
  return both;
}

PairTable PairTable::everything() {
  PairTable table;
  for (int a = 0; a < flag::count; ++a) table.partners_[std::size_t{1} << a] = unions - 1;
  table.update();
  return table;
}

PairTables PairRule::candidates() const {
  PairTable k;
  k.add(flag::positive, flag::negative);
  for (const auto u : {flag::positive, flag::negative, flag::zero, flag::violated}) {
    k.add(u, flag::zero).add(u, flag::violated);
  }
  return {k, PairTable::everything()};
}

PairTables PairRule::closure() const {
  PairTable grown;
  for (const auto u : {flag::positive, flag::negative, flag::zero, flag::violated}) {
    grown.add(u, flag::grown);
  }
  return {grown, {}};
}

bool PairRule::joins_closure(const TrianglePair&, std::int32_t) const { return true; }

PairTables EveryPair::candidates() const {
  return {PairTable::everything(), PairTable::everything()};
}

Marks::Marks(const BoundingVolumeTree& tree)
    : types((tree.node_count() + 1) / 2, TriangleType::positive),
      node_flags(tree.node_count(), flag::positive) {
  changed.reserve(types.size());
}

void Marking::bring_to(std::span<const TriangleType> types, const BoundingVolumeTree& tree,
                       Marks& marks, MarkingCounts& counts) const {
  assert(types.size() == marks.types.size());
  marks.changed.clear();
  if (types.empty() || std::memcmp(types.data(), marks.types.data(), types.size()) == 0) return;
  for (std::size_t t = 0; t < types.size(); ++t) {
    if (types[t] == marks.types[t]) continue;
    marks.types[t] = types[t];
    marks.changed.push_back(static_cast<std::int32_t>(t));
  }
  // In a mesh of at least this many triangles, if a quarter of them has changed, one pass over all
  // nodes takes a fifth of the time of a walk upward from each changed leaf.
  constexpr std::size_t large_mesh = 1024;
  if (types.size() >= large_mesh && marks.changed.size() > types.size() / 4) {
    mark_anew(tree, marks, counts);
  } else {
    update(tree, marks, counts);
  }
}

void Marking::change(std::span<const Change> changes, const BoundingVolumeTree& tree, Marks& marks,
                     MarkingCounts& counts) const {
  marks.changed.clear();
  for (const auto& [triangle, type] : changes) {
    if (marks.types[at(triangle)] == type) continue;
    marks.types[at(triangle)] = type;
    marks.changed.push_back(triangle);
  }
  update(tree, marks, counts);
}

void Marking::update(const BoundingVolumeTree& tree, Marks& marks, MarkingCounts& counts) const {
  for (const auto t : marks.changed) {
    const auto leaf = tree.leaf_of(t);
    const auto old_flags = marks.node_flags[at(leaf)], new_flags = marks.flags(t);
    counts.changed += old_flags != new_flags;
    const auto added = static_cast<std::uint8_t>(new_flags & ~old_flags);
    if (added) mark(leaf, added, tree, marks, counts);
  }
  for (const auto t : marks.changed) {
    const auto leaf = tree.leaf_of(t);
    const auto gone = static_cast<std::uint8_t>(marks.node_flags[at(leaf)] & ~marks.flags(t));
    if (gone) clear(leaf, gone, tree, marks, counts);
  }
}

// Gives the counts of update(), which meets a node once for each flag that the node gets or loses.
void Marking::mark_anew(const BoundingVolumeTree& tree, Marks& marks, MarkingCounts& counts) {
  // In a step without views all nodes have the flag of all triangles.
  const std::uint8_t now = marks.flags(0), of_all = marks.node_flags[BoundingVolumeTree::root];
  if (std::has_single_bit(of_all) && of_all != now && are_of_one_type(marks.types)) {
    marks.node_flags.assign(marks.node_flags.size(), now);
    counts.changed += marks.types.size();
    const auto times = [&](unsigned flags) {
      return static_cast<std::uint64_t>(std::popcount(flags)) * marks.node_flags.size();
    };
    counts.marked += times(now & ~of_all);
    counts.cleared += times(of_all & ~now);
    return;
  }
  for (auto node = static_cast<std::int32_t>(tree.node_count()); node-- > 0;) {
    auto& of_node = marks.node_flags[at(node)];
    const auto child = static_cast<std::size_t>(tree.child(node));
    const std::uint8_t before = of_node;
    of_node =
        tree.is_leaf(node)
            ? marks.flags(tree.triangle(node))
            : static_cast<std::uint8_t>(marks.node_flags[child] | marks.node_flags[child + 1]);
    if (of_node == before) continue;
    counts.changed += tree.is_leaf(node);
    counts.marked += static_cast<std::uint64_t>(std::popcount(unsigned(of_node & ~before)));
    counts.cleared += static_cast<std::uint64_t>(std::popcount(unsigned(before & ~of_node)));
  }
}

void Marking::mark(std::int32_t leaf, std::uint8_t flags, const BoundingVolumeTree& tree,
                   Marks& marks, MarkingCounts& counts) const {
  for (std::int32_t node = leaf;; node = tree.parent(node)) {
    auto& of_node = marks.node_flags[at(node)];
    if ((of_node & flags) == flags) return;
    of_node |= flags;
    ++counts.marked;
    if (node == BoundingVolumeTree::root) return;
  }
}

void Marking::clear(std::int32_t leaf, std::uint8_t flags, const BoundingVolumeTree& tree,
                    Marks& marks, MarkingCounts& counts) const {
  auto& flags_of_leaf = marks.node_flags[at(leaf)];
  flags_of_leaf = static_cast<std::uint8_t>(flags_of_leaf & ~flags);
  ++counts.cleared;
  for (std::int32_t node = leaf; node != BoundingVolumeTree::root;) {
    node = tree.parent(node);
    const auto child = at(tree.child(node));
    const std::uint8_t below = marks.node_flags[child] | marks.node_flags[child + 1];
    if (marks.node_flags[at(node)] == below) return;
    marks.node_flags[at(node)] = below;
    ++counts.cleared;
  }
}

}  // namespace assay::detector
