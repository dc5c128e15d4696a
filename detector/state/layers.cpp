#include "detector/state/layers.h"

#include <algorithm>
#include <map>

#include "detector/state/winding.h"

namespace assay::detector {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// The triangles of the mesh linked to `seed`, itself included, ascending; marks them seen.
std::vector<std::int32_t> grow_piece(const Surface& surface, std::int32_t seed,
                                     const std::vector<std::uint8_t>& touched,
                                     std::vector<std::uint8_t>& seen) {
  const Topology& all = surface.all();
  const auto ghosts_begin = static_cast<std::int32_t>(surface.mesh.triangles.size());
  std::vector<std::int32_t> piece = {seed};
  seen[at(seed)] = 1;
  for (std::size_t next = 0; next < piece.size(); ++next) {
    for (const auto edge : all.triangle_edges[at(piece[next])]) {
      const auto around = all.edge_triangles.row(edge);
      if (around.size() != 2) continue;
      const auto other = around[0] == piece[next] ? around[1] : around[0];
      if (other >= ghosts_begin || touched[at(other)] || seen[at(other)]) continue;
      seen[at(other)] = 1;
      piece.push_back(other);
    }
  }
  std::sort(piece.begin(), piece.end());
  return piece;
}

// The winding number outside of the piece's triangles, which have it in common. Nothing when it is
// not known: the piece stays dirty.
std::optional<int> winding_outside(const Topology& all, std::span<const std::int32_t> cycle,
                                   const PositionsView& x, const std::vector<std::int32_t>& piece,
                                   Arithmetic arithmetic) {
  if (arithmetic == Arithmetic::exact) {
    const auto with_area = std::find_if(piece.begin(), piece.end(),
                                        [&](std::int32_t t) { return !has_zero_area(all, x, t); });
    if (with_area == piece.end()) return std::nullopt;
    return winding_number_outside(all, cycle, x, *with_area);
  }
  int attempts = 4;  // doubles may fail at one triangle and not at the next
  for (const auto t : piece) {
    if (has_equal_corners(all, x, t)) continue;
    if (const auto outside = winding_number_outside(all, cycle, x, t, arithmetic)) return outside;
    if (--attempts == 0) break;
  }
  return std::nullopt;
}

struct LayerClass {
  std::vector<std::int32_t> triangles;
  std::int32_t lowest = 0;
};

}  // namespace

void mark_clean_by_layers(const Surface& surface, std::size_t c, const PositionsView& x,
                          const std::vector<std::uint8_t>& touched, std::vector<std::uint8_t>& seen,
                          std::vector<std::uint8_t>& clean, Arithmetic arithmetic) {
  const Topology& all = surface.all();
  const auto& own = surface.mesh.components[c].triangles;
  const auto& cycle = all.components[c].triangles;
  for (const auto t : own) clean[at(t)] = 0;
  std::map<int, LayerClass> by_layer;  // key: winding number outside
  for (const auto seed : own) {
    if (touched[at(seed)] || seen[at(seed)]) continue;
    const auto piece = grow_piece(surface, seed, touched, seen);
    const auto outside = winding_outside(all, cycle, x, piece, arithmetic);
    if (!outside) continue;  // stays dirty
    auto [entry, is_new] = by_layer.try_emplace(*outside);
    // Seeds ascend, so the first piece of a layer holds its lowest triangle.
    if (is_new) entry->second.lowest = piece.front();
    entry->second.triangles.insert(entry->second.triangles.end(), piece.begin(), piece.end());
  }
  const LayerClass* common = nullptr;
  for (const auto& [layer, candidate] : by_layer) {
    const auto size = candidate.triangles.size();
    if (!common || size > common->triangles.size() ||
        (size == common->triangles.size() && candidate.lowest < common->lowest)) {
      common = &candidate;
    }
  }
  if (!common) return;
  for (const auto t : common->triangles) clean[at(t)] = 1;
}

}  // namespace assay::detector
