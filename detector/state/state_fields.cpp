#include "detector/state/state_fields.h"

#include <algorithm>
#include <cmath>

namespace assay::detector {
namespace {

bool fits(const ViewAnchor& anchor, std::int32_t vertex_count) {
  const auto is_vertex = [&](std::int32_t v) { return v >= 0 && v < vertex_count; };
  const auto is_finite = [](double weight) { return std::isfinite(weight); };
  for (const auto& end : anchor.ends) {
    if (end.vertices.size() != end.weights.size() ||
        !std::all_of(end.vertices.begin(), end.vertices.end(), is_vertex) ||
        !std::all_of(end.weights.begin(), end.weights.end(), is_finite)) {
      return false;
    }
  }
  return true;
}

bool fit(const std::vector<ViewAnchor>& anchors, std::size_t count, std::int32_t vertex_count) {
  return anchors.size() == count &&
         std::all_of(anchors.begin(), anchors.end(),
                     [&](const ViewAnchor& anchor) { return fits(anchor, vertex_count); });
}

bool fits(const StepState& state, const Surface& surface) {
  const std::size_t triangles = surface.mesh.triangles.size();
  const std::size_t components = surface.mesh.components.size();
  const auto is_pair = [&](const TrianglePair& pair) {
    return pair.a >= 0 && pair.a < pair.b && static_cast<std::size_t>(pair.b) < triangles;
  };
  return state.positions.rows() == surface.first_apex && state.positions.allFinite() &&
         state.clean.size() == triangles && state.inside.size() == components &&
         std::all_of(state.met.begin(), state.met.end(), is_pair);
}

}  // namespace

bool fits(const StateFields& state, const Surface& surface, std::size_t anchors) {
  const std::int32_t n = surface.first_apex;
  if (!fit(state.anchors, anchors, n)) return false;
  for (const auto& rule : state.apex_rules) {
    if (!std::isfinite(rule.height)) return false;
  }
  if (!state.committed) return true;
  const auto& chosen = state.committed->policy.anchors;
  return fits(*state.committed, surface) && (!chosen || fit(*chosen, anchors, n));
}

// FNV-1a, taken over indices instead of bytes.
std::uint64_t digest_of(const Topology& mesh, std::int32_t vertex_count) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&](std::int32_t value) {
    hash = (hash ^ static_cast<std::uint32_t>(value)) * 0x100000001b3u;
  };
  add(vertex_count);
  for (const auto& triangle : mesh.triangles) {
    for (const auto vertex : triangle) add(vertex);
  }
  return hash;
}

}  // namespace assay::detector
