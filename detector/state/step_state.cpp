#include "detector/state/step_state.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>

#include "detector/mesh/for_all.h"

namespace assay::detector {
namespace {

constexpr std::size_t row_bytes = 3 * sizeof(double);

// Returns whether the rows of x follow each other without gaps, so that they can be handled as one
// block.
bool is_packed(const PositionsView& x) { return x.outerStride() == 3; }

}  // namespace

void StepState::keep(const PositionsView& x, const PacedStop& pace) {
  positions.resize(x.rows(), 3);
  ask_for_large_pages(positions.data(), row_bytes * static_cast<std::size_t>(x.rows()));
  if (!is_packed(x)) {
    positions = x;
    return;
  }
  PacedStop unasked = pace.unasked();
  for_all_pieces(static_cast<std::size_t>(x.rows()), least_shared, 0, &unasked,
                 [&](std::size_t begin, std::size_t end, std::size_t) {
                   std::memcpy(positions.data() + 3 * begin, x.data() + 3 * begin,
                               row_bytes * (end - begin));
                 });
}

bool StepState::holds_at(const PositionsView& x, const PacedStop& pace) const {
  if (positions.rows() != x.rows()) return false;
  const auto same = [&](Eigen::Index row, Eigen::Index count) {
    return std::memcmp(positions.data() + 3 * row, x.data() + x.outerStride() * row,
                       row_bytes * static_cast<std::size_t>(count)) == 0;
  };
  if (is_packed(x)) {
    std::atomic<bool> all_same = true;
    PacedStop unasked = pace.unasked();
    for_all_pieces(static_cast<std::size_t>(x.rows()), least_shared, 0, &unasked,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                     if (all_same && !same(static_cast<Eigen::Index>(begin),
                                           static_cast<Eigen::Index>(end - begin))) {
                       all_same = false;
                     }
                   });
    return all_same;
  }
  for (Eigen::Index row = 0; row < x.rows(); ++row) {
    if (!same(row, 1)) return false;
  }
  return true;
}

// The binding names every member, so a new one does not compile before it is compared.
bool operator==(const StepState& a, const StepState& b) {
  const auto& [positions, clean, contacts, are_complete, inside, policy] = a;
  return b.holds_at(positions) && clean == b.clean && contacts == b.contacts &&
         are_complete == b.contacts_are_complete && inside == b.inside && policy == b.policy;
}

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
         std::all_of(state.contacts.begin(), state.contacts.end(), is_pair);
}

}  // namespace

bool fits(const StateFields& state, const Surface& surface, std::size_t anchors) {
  const std::int32_t n = surface.first_apex;
  if (!fit(state.anchors, anchors, n)) return false;
  for (const auto& rule : state.apex_rules) {
    if (!std::isfinite(rule.height)) return false;
  }
  if (!state.committed) return true;
  const auto& chosen = state.committed->policy.anchors.list;
  return fits(*state.committed, surface) && (!chosen || fit(*chosen, anchors, n));
}

// Computes FNV-1a over indices instead of bytes.
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
