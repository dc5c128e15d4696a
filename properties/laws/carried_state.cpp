#include "properties/laws/carried_state.h"

#include <fmt/format.h>

namespace assay::properties {

using OptionalLayers = std::vector<std::optional<oracle::Layer>>;  // by component

std::string what_is_not_clean(const CaseFacts& facts, const oracle::LayerState& layers,
                              const TriangleFlags& held) {
  OptionalLayers shared(facts.surface().mesh.components.size());
  for (std::size_t t = 0; t < held.size(); ++t) {
    if (!held[t]) continue;
    if (layers.touched[t]) return fmt::format("triangle {} is touched", t);
    auto& layer =
        shared[static_cast<std::size_t>(facts.component_of(static_cast<std::int32_t>(t)))];
    if (!layer) layer = layers.layer[t];
    if (layer != layers.layer[t]) return fmt::format("triangle {} is of another layer", t);
  }
  return {};
}

TriangleFlags may_be_clean(CaseFacts& facts, std::size_t s, const TriangleFlags& in_question) {
  const auto& layers = facts.layers_at_start(s);
  const auto dirty = dirty_triangles(facts, s);
  OptionalLayers wanted(facts.surface().mesh.components.size());
  const auto component = [&](std::size_t t) {
    return static_cast<std::size_t>(facts.component_of(static_cast<std::int32_t>(t)));
  };
  for (std::size_t t = 0; t < dirty.size(); ++t) {
    auto& layer = wanted[component(t)];
    if (!layer && !dirty[t] && !in_question[t] && !layers.touched[t]) layer = layers.layer[t];
  }
  TriangleFlags clean(dirty.size(), 0);
  for (std::size_t t = 0; t < dirty.size(); ++t) {
    if (!in_question[t] || layers.touched[t]) continue;
    const auto& layer = wanted[component(t)];
    clean[t] = layer ? layer == layers.layer[t] : layers.clean[t] != 0;
  }
  return clean;
}

TriangleFlags dirty_triangles(const CaseFacts& facts, std::size_t s) {
  TriangleFlags dirty;
  for (const auto doubts : facts.result(s).doubts) {
    dirty.push_back((doubts & detector::doubt::dirty) != 0);
  }
  return dirty;
}

}  // namespace assay::properties
