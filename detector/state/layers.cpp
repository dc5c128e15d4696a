#include "detector/state/layers.h"

#include <algorithm>
#include <map>

#include "detector/state/winding.h"

namespace assay::detector {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// Doubles may fail at one triangle and not at the next.
constexpr std::size_t most_attempts = 4;

struct Piece {
  std::vector<std::int32_t> triangles;  // ascending; those in doubt
  bool holds_clean = false;             // and a clean one, with all that is linked to it
};

// Pieces of the untouched triangles in doubt, in the order of their lowest triangles.
class Flood {
 public:
  Flood(const TouchedSurface& instant, std::vector<std::uint8_t>& seen,
        const std::vector<std::uint8_t>& clean)
      : instant_(instant), seen_(seen), clean_(clean) {}

  bool is_new(std::int32_t t) const { return !instant_.touched[at(t)] && !seen_[at(t)]; }

  Piece from(std::int32_t seed) {
    const Topology& all = instant_.surface.all();
    const auto ghosts_begin = static_cast<std::int32_t>(instant_.surface.mesh.triangles.size());
    Piece piece{{seed}, false};
    seen_[at(seed)] = 1;
    for (std::size_t next = 0; next < piece.triangles.size(); ++next) {
      const auto t = piece.triangles[next];
      for (const auto edge : all.triangle_edges[at(t)]) {
        const auto around = all.edge_triangles.row(edge);
        if (around.size() != 2) continue;
        const auto other = around[0] == t ? around[1] : around[0];
        if (other >= ghosts_begin) continue;
        if (clean_[at(other)]) {
          piece.holds_clean = true;
        } else if (is_new(other)) {
          seen_[at(other)] = 1;
          piece.triangles.push_back(other);
        }
      }
    }
    std::sort(piece.triangles.begin(), piece.triangles.end());
    return piece;
  }

 private:
  const TouchedSurface& instant_;
  std::vector<std::uint8_t>& seen_;
  const std::vector<std::uint8_t>& clean_;
};

// The winding number outside of the piece's triangles, which have it in common. Nothing when it is
// not known: the piece stays dirty.
std::optional<int> winding_outside(const TouchedSurface& instant, std::size_t c,
                                   std::span<const std::int32_t> piece) {
  const Topology& all = instant.surface.all();
  const auto& cycle = all.components[c].triangles;
  const PositionsView& x = instant.x;
  const Arithmetic arithmetic = instant.arithmetic;
  if (arithmetic == Arithmetic::exact) {
    const auto with_area = std::find_if(piece.begin(), piece.end(),
                                        [&](std::int32_t t) { return !has_zero_area(all, x, t); });
    if (with_area == piece.end()) return std::nullopt;
    return winding_number_outside(all, cycle, x, *with_area);
  }
  std::size_t attempts = most_attempts;
  for (const auto t : piece) {
    if (has_equal_corners(all, x, t)) continue;
    if (const auto outside = winding_number_outside(all, cycle, x, t, arithmetic)) return outside;
    if (--attempts == 0) break;
  }
  return std::nullopt;
}

// The layer that most untouched triangles have, by its winding number outside.
std::optional<int> most_common(const std::map<int, std::vector<std::int32_t>>& by_layer) {
  std::optional<int> common;
  std::size_t most = 0;
  std::int32_t lowest = 0;
  for (const auto& [layer, triangles] : by_layer) {
    const auto size = triangles.size();
    const auto first = *std::min_element(triangles.begin(), triangles.end());
    if (size < most || (size == most && first > lowest)) continue;
    common = layer;
    most = size;
    lowest = first;
  }
  return common;
}

}  // namespace

std::uint64_t release_pieces(const TouchedSurface& at_instant, std::size_t c,
                             std::span<const std::int32_t> in_doubt,
                             std::vector<std::uint8_t>& seen, std::vector<std::uint8_t>& clean) {
  const auto release = [&](const std::vector<std::int32_t>& triangles) {
    for (const auto t : triangles) clean[at(t)] = 1;
  };
  const auto& own = at_instant.surface.mesh.components[c].triangles;
  const bool some_clean = in_doubt.size() < own.size();
  std::vector<Piece> alone;
  {
    Flood flood(at_instant, seen, clean);
    for (const auto seed : in_doubt) {
      // What a flood has released is seen, and what is linked to it too.
      if (!flood.is_new(seed)) continue;
      Piece piece = flood.from(seed);
      if (piece.holds_clean) {
        release(piece.triangles);
      } else {
        alone.push_back(std::move(piece));
      }
    }
  }
  if (alone.empty()) return 0;
  std::uint64_t winding_numbers = alone.size();
  std::map<int, std::vector<std::int32_t>> by_layer;  // key: winding number outside
  for (const auto& piece : alone) {
    const auto outside = winding_outside(at_instant, c, piece.triangles);
    if (!outside) continue;  // stays dirty
    auto& of_layer = by_layer[*outside];
    of_layer.insert(of_layer.end(), piece.triangles.begin(), piece.triangles.end());
  }
  std::optional<int> common;
  if (some_clean) {
    // All clean ones share it, also those that were released just now.
    std::vector<std::int32_t> some;
    for (std::size_t i = 0; i < own.size() && some.size() < most_attempts; ++i) {
      if (clean[at(own[i])]) some.push_back(own[i]);
    }
    common = winding_outside(at_instant, c, some);
    ++winding_numbers;
  } else {
    common = most_common(by_layer);
  }
  if (!common) return winding_numbers;
  if (const auto found = by_layer.find(*common); found != by_layer.end()) release(found->second);
  return winding_numbers;
}

std::uint64_t mark_clean_by_layers(const TouchedSurface& at_instant, std::size_t c,
                                   std::vector<std::uint8_t>& seen,
                                   std::vector<std::uint8_t>& clean) {
  const auto& own = at_instant.surface.mesh.components[c].triangles;
  for (const auto t : own) clean[at(t)] = 0;
  return release_pieces(at_instant, c, own, seen, clean);
}

}  // namespace assay::detector
