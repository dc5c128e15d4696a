#include "detector/state/layers.h"

#include <algorithm>
#include <map>

#include "detector/geometry/winding.h"

namespace assay::detector {
namespace {

// This many triangles of a piece are tried, because doubles may fail at one and not at the next.
constexpr std::size_t most_attempts = 4;

struct Piece {
  std::vector<std::int32_t> triangles;  // those in doubt, in the order of the flood
  bool holds_clean = false;             // whether some are linked to a clean triangle
};

// Finds the pieces of the untouched triangles in doubt, in the order of their lowest triangles.
class Flood {
 public:
  Flood(const TouchedSurface& instant, std::vector<std::uint8_t>& is_seen,
        const std::vector<std::uint8_t>& clean)
      : instant_(instant), is_seen_(is_seen), clean_(clean) {}

  bool is_new(std::int32_t t) const { return !instant_.touched[at(t)] && !is_seen_[at(t)]; }

  Piece from(std::int32_t seed) {
    const Topology& all = instant_.surface.all();
    const auto ghosts_begin = static_cast<std::int32_t>(instant_.surface.mesh.triangles.size());
    Piece piece{{seed}, false};
    is_seen_[at(seed)] = 1;
    constexpr std::uint64_t work_of_triangle = 4;  // in box tests
    for (std::size_t next = 0; next < piece.triangles.size(); ++next) {
      if (instant_.pace && instant_.pace->after(work_of_triangle)) break;
      const auto t = piece.triangles[next];
      for (const auto edge : all.triangle_edges[at(t)]) {
        const auto around = all.edge_triangles.row(edge);
        if (around.size() != 2) continue;
        const auto other = around[0] == t ? around[1] : around[0];
        if (other >= ghosts_begin) continue;
        if (clean_[at(other)]) {
          piece.holds_clean = true;
        } else if (is_new(other)) {
          is_seen_[at(other)] = 1;
          piece.triangles.push_back(other);
        }
      }
    }
    return piece;
  }

 private:
  const TouchedSurface& instant_;
  std::vector<std::uint8_t>& is_seen_;
  const std::vector<std::uint8_t>& clean_;
};

// Returns the first triangle, from place `next` of the piece on, from which a ray can start. Leaves
// `next` behind it.
std::optional<std::int32_t> representative(const TouchedSurface& instant,
                                           const std::vector<std::int32_t>& piece,
                                           std::size_t& next) {
  const Topology& all = instant.surface.all();
  while (next < piece.size()) {
    const auto t = piece[next++];
    const bool unfit = instant.arithmetic == Arithmetic::exact
                           ? has_zero_area(all, instant.x, t)
                           : has_equal_corners(all, instant.x, t);
    if (!unfit) return t;
  }
  return std::nullopt;
}

// Returns, by piece, the winding number outside of its triangles, which they have in common.
// Nothing if it is not known; such a piece stays dirty.
std::vector<std::optional<int>> windings_outside(
    const TouchedSurface& instant, std::size_t c,
    const std::vector<const std::vector<std::int32_t>*>& pieces) {
  const Topology& all = instant.surface.all();
  std::vector<std::optional<int>> winding(pieces.size());
  std::vector<std::size_t> next(pieces.size(), 0);
  const std::size_t attempts = instant.arithmetic == Arithmetic::exact ? 1 : most_attempts;
  for (std::size_t attempt = 0; attempt < attempts; ++attempt) {
    std::vector<std::size_t> open;
    std::vector<std::int32_t> queries;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (winding[i]) continue;
      const auto t = representative(instant, *pieces[i], next[i]);
      if (!t) continue;
      open.push_back(i);
      queries.push_back(*t);
    }
    if (queries.empty()) break;
    const auto found = winding_numbers_outside(all, all.components[c].triangles, instant.x, queries,
                                               instant.arithmetic, instant.pace);
    for (std::size_t k = 0; k < open.size(); ++k) winding[open[k]] = found[k];
  }
  return winding;
}

// Returns the layer that most untouched triangles have, by its winding number outside.
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

std::vector<std::int32_t> layer_witnesses(const Topology& mesh, std::size_t c,
                                          const std::vector<std::uint8_t>& clean) {
  const auto& own = mesh.components[c].triangles;
  std::vector<std::int32_t> witnesses;
  for (std::size_t i = 0; i < own.size() && witnesses.size() < most_attempts; ++i) {
    if (clean[at(own[i])]) witnesses.push_back(own[i]);
  }
  return witnesses;
}

std::uint64_t release_pieces(const TouchedSurface& at_instant, std::size_t c,
                             std::span<const std::int32_t> in_doubt,
                             const std::vector<std::int32_t>& witnesses,
                             std::vector<std::uint8_t>& is_seen, std::vector<std::uint8_t>& clean) {
  const auto release = [&](const std::vector<std::int32_t>& triangles) {
    for (const auto t : triangles) clean[at(t)] = 1;
  };
  std::vector<Piece> alone;
  {
    Flood flood(at_instant, is_seen, clean);
    for (const auto seed : in_doubt) {
      // Triangles that a flood has released are seen already, and so is all that is linked to them.
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
  std::vector<const std::vector<std::int32_t>*> pieces;
  for (const auto& piece : alone) pieces.push_back(&piece.triangles);
  if (!witnesses.empty()) pieces.push_back(&witnesses);
  const auto windings = windings_outside(at_instant, c, pieces);
  const std::uint64_t winding_numbers = pieces.size();
  std::map<int, std::vector<std::int32_t>> by_layer;  // key: winding number outside
  for (std::size_t i = 0; i < alone.size(); ++i) {
    if (!windings[i]) continue;
    auto& of_layer = by_layer[*windings[i]];
    of_layer.insert(of_layer.end(), alone[i].triangles.begin(), alone[i].triangles.end());
  }
  const auto common = witnesses.empty() ? most_common(by_layer) : windings.back();
  if (!common) return winding_numbers;
  if (const auto found = by_layer.find(*common); found != by_layer.end()) release(found->second);
  return winding_numbers;
}

std::uint64_t mark_clean_by_layers(const TouchedSurface& at_instant, std::size_t c,
                                   std::vector<std::uint8_t>& is_seen,
                                   std::vector<std::uint8_t>& clean) {
  const auto& own = at_instant.surface.mesh.components[c].triangles;
  for (const auto t : own) clean[at(t)] = 0;
  return release_pieces(at_instant, c, own, {}, is_seen, clean);
}

}  // namespace assay::detector
