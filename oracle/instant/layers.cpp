#include "oracle/instant/layers.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <numeric>

#include "oracle/instant/instant_contacts.h"
#include "oracle/mesh/loops.h"
#include "oracle/mesh/mesh_features.h"

namespace assay::oracle {

namespace {

// Disjoint sets; the representative is the lowest member.
class Classes {
 public:
  explicit Classes(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  std::int32_t lowest(std::int32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::int32_t a, std::int32_t b) {
    a = lowest(a), b = lowest(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::int32_t> parent_;
};

detector::Triangles stacked(const detector::TrianglesView& a, const detector::TrianglesView& b) {
  detector::Triangles all(a.rows() + b.rows(), 3);
  all << a, b;
  return all;
}

std::vector<std::int32_t> components(const MeshFeatures& all) {
  Classes classes(all.faces.size());
  for (std::size_t v = 0; v < all.vertices.size(); ++v) {
    const auto holders = all.triangles_of_vertex.of(v);
    for (const std::int32_t t : holders) classes.join(holders[0], t);
  }
  std::vector<std::int32_t> number(all.faces.size());
  std::int32_t count = 0;
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(number.size()); ++t) {
    const std::int32_t lowest = classes.lowest(t);
    number[t] = lowest == t ? count++ : number[lowest];
  }
  return number;
}

// Whether the face has the directed edge from the lower to the higher vertex.
bool runs_upward(const Face& face, const Edge& edge) {
  for (int k = 0; k < 3; ++k) {
    if (face[k] == edge[0] && face[(k + 1) % 3] == edge[1]) return true;
  }
  return false;
}

std::vector<std::int32_t> pieces(const MeshFeatures& all,
                                 const std::vector<std::uint8_t>& touched) {
  const auto count = static_cast<std::int32_t>(touched.size());
  Classes classes(touched.size());
  for (std::size_t e = 0; e < all.edges.size(); ++e) {
    const auto holders = all.triangles_of_edge.of(e);
    if (holders.size() != 2) continue;
    const std::int32_t s = holders[0], t = holders[1];
    if (s >= count || t >= count || touched[s] || touched[t]) continue;
    const Edge& edge = all.edges[e];
    if (runs_upward(all.faces[s], edge) != runs_upward(all.faces[t], edge)) classes.join(s, t);
  }
  std::vector<std::int32_t> number(touched.size(), -1);
  std::int32_t next = 0;
  for (std::int32_t t = 0; t < count; ++t) {
    if (touched[t]) continue;
    const std::int32_t lowest = classes.lowest(t);
    number[t] = lowest == t ? next++ : number[lowest];
  }
  return number;
}

// The layers of the untouched triangles. They are found once for each piece, in the winding
// numbers of its component.
std::vector<std::optional<Layer>> layers(const Instant& instant, const detector::Triangles& all,
                                         const LayerState& state) {
  std::vector<std::vector<Eigen::Index>> members;
  std::vector<std::int32_t> place;  // of each triangle in its component
  for (std::size_t t = 0; t < state.component.size(); ++t) {
    const auto c = static_cast<std::size_t>(state.component[t]);
    if (c >= members.size()) members.resize(c + 1);
    place.push_back(static_cast<std::int32_t>(members[c].size()));
    members[c].push_back(static_cast<Eigen::Index>(t));
  }
  std::vector<std::optional<Layer>> layer(state.touched.size());
  std::map<std::int32_t, Layer> layer_of_piece;
  for (const auto& component : members) {
    std::optional<WindingField> field;
    for (const Eigen::Index t : component) {
      if (t >= static_cast<Eigen::Index>(layer.size()) || state.touched[t]) continue;
      if (!layer_of_piece.count(state.piece[t])) {
        if (!field) field.emplace(instant, all(component, Eigen::all));
        layer_of_piece[state.piece[t]] = field->layer_of(place[t]);
      }
      layer[t] = layer_of_piece[state.piece[t]];
    }
  }
  return layer;
}

std::vector<std::optional<Layer>> common_layers(const LayerState& state) {
  struct Use {
    std::int32_t count = 0, lowest = 0;
  };
  std::vector<std::map<Layer, Use>> uses;
  for (std::size_t t = 0; t < state.component.size(); ++t) {
    const auto c = static_cast<std::size_t>(state.component[t]);
    if (c >= uses.size()) uses.resize(c + 1);
    if (t >= state.layer.size() || !state.layer[t]) continue;
    Use& use = uses[c][*state.layer[t]];
    if (use.count++ == 0) use.lowest = static_cast<std::int32_t>(t);
  }
  std::vector<std::optional<Layer>> common(uses.size());
  for (std::size_t c = 0; c < uses.size(); ++c) {
    Use best;
    for (const auto& [layer, use] : uses[c]) {
      if (use.count < best.count || (use.count == best.count && use.lowest > best.lowest)) continue;
      best = use;
      common[c] = layer;
    }
  }
  return common;
}

}  // namespace

LayerState layers_at(const Instant& instant, const detector::TrianglesView& triangles,
                     const detector::TrianglesView& ghosts, int jobs) {
  assert(closes(triangles, ghosts));
  const detector::Triangles all = stacked(triangles, ghosts);
  const MeshFeatures features = mesh_features(all);
  LayerState state;
  state.component = components(features);
  state.touched = touched_at(instant, triangles, ghosts, state.component, jobs);
  for (std::size_t t = 0; t < state.touched.size(); ++t) {
    const Face& f = features.faces[t];
    if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) state.touched[t] = 1;  // has no normal
  }
  state.piece = pieces(features, state.touched);
  state.layer = layers(instant, all, state);
  state.common = common_layers(state);
  for (std::size_t t = 0; t < state.touched.size(); ++t) {
    state.clean.push_back(state.layer[t] && state.layer[t] == state.common[state.component[t]]);
  }
  return state;
}

}  // namespace assay::oracle
