#include "detector/state/layers.h"

#include <algorithm>
#include <map>

#include "detector/state/winding.h"

namespace assay::detector {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// The triangles linked to `seed`, itself included, ascending; marks them seen.
std::vector<std::int32_t> grow_piece(const Topology& mesh, std::int32_t seed,
                                     const std::vector<std::uint8_t>& touched,
                                     std::vector<std::uint8_t>& seen) {
  std::vector<std::int32_t> piece = {seed};
  seen[at(seed)] = 1;
  for (std::size_t next = 0; next < piece.size(); ++next) {
    for (const auto edge : mesh.triangle_edges[at(piece[next])]) {
      const auto around = mesh.edge_triangles.row(edge);
      if (around.size() != 2) continue;
      const auto other = around[0] == piece[next] ? around[1] : around[0];
      if (touched[at(other)] || seen[at(other)]) continue;
      seen[at(other)] = 1;
      piece.push_back(other);
    }
  }
  std::sort(piece.begin(), piece.end());
  return piece;
}

struct LayerClass {
  std::vector<std::int32_t> triangles;
  std::int32_t lowest = 0;
};

}  // namespace

void mark_clean_by_layers(const Topology& mesh, const Component& component, const PositionsView& x,
                          const std::vector<std::uint8_t>& touched, std::vector<std::uint8_t>& seen,
                          std::vector<std::uint8_t>& clean) {
  for (const auto t : component.triangles) clean[at(t)] = 0;
  std::map<int, LayerClass> by_layer;  // key: winding number outside
  for (const auto seed : component.triangles) {
    if (touched[at(seed)] || seen[at(seed)]) continue;
    const auto piece = grow_piece(mesh, seed, touched, seen);
    const auto with_area = std::find_if(piece.begin(), piece.end(),
                                        [&](std::int32_t t) { return !has_zero_area(mesh, x, t); });
    if (with_area == piece.end()) continue;  // stays dirty
    const auto outside = winding_number_outside(mesh, component.triangles, x, *with_area);
    if (!outside) continue;
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
