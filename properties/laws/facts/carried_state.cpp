#include "properties/laws/facts/carried_state.h"

#include <fmt/format.h>

#include <algorithm>

#include "oracle/view/view_sign.h"

namespace assay::properties {

using OptionalLayers = std::vector<std::optional<oracle::Layer>>;  // by component

namespace {

std::size_t component_of(const CaseFacts& facts, std::size_t triangle) {
  return at(facts.component_of(static_cast<std::int32_t>(triangle)));
}

// Whether every triangle of S is positive where the step starts.
bool is_positive_at_start(CaseFacts& facts, std::size_t s, std::size_t component) {
  auto still = facts.result(s).primitives[component];
  still.q0.t1 = still.q0.t0;
  still.q1.t1 = still.q1.t0;
  const auto x = facts.all_t0(s);
  const auto& surface = facts.surface().all();
  const auto& triangles = surface.components[component].triangles;
  return std::all_of(triangles.begin(), triangles.end(), [&](std::int32_t t) {
    const auto& v = surface.triangles[at(t)];
    const auto corner = [&](std::size_t i) { return detector::SteppedMesh{x, x}.path(v[i]); };
    return oracle::view_sign({corner(0), corner(1), corner(2)}, still) ==
           detector::ViewSign::positive;
  });
}

// Which triangles of `in_question` are untouched, and in the layer of the triangles of their
// component that are not in doubt, or else in the common layer.
TriangleFlags clean_beside(CaseFacts& facts, std::size_t s, const TriangleFlags& in_question,
                           const TriangleFlags& in_doubt) {
  const auto& layers = facts.layers_at_start(s);
  OptionalLayers wanted(facts.surface().mesh.components.size());
  for (std::size_t t = 0; t < in_doubt.size(); ++t) {
    auto& layer = wanted[component_of(facts, t)];
    if (!layer && !in_doubt[t]) layer = layers.layer[t];
  }
  TriangleFlags clean(in_doubt.size(), 0);
  for (std::size_t t = 0; t < in_doubt.size(); ++t) {
    if (!in_question[t] || layers.touched[t]) continue;
    const auto& layer = wanted[component_of(facts, t)];
    clean[t] = layer ? layer == layers.layer[t] : layers.clean[t] != 0;
  }
  return clean;
}

}  // namespace

bool is_free_by_view_at_start(CaseFacts& facts, std::size_t s, std::size_t component) {
  return is_positive_at_start(facts, s, component) && facts.winding_at_start(s, component) == 1;
}

std::string what_is_not_clean(const CaseFacts& facts, const oracle::LayerState& layers,
                              const TriangleFlags& held) {
  OptionalLayers shared(facts.surface().mesh.components.size());
  for (std::size_t t = 0; t < held.size(); ++t) {
    if (!held[t]) continue;
    if (layers.touched[t]) return fmt::format("triangle {} is touched", t);
    auto& layer = shared[component_of(facts, t)];
    if (!layer) layer = layers.layer[t];
    if (layer != layers.layer[t]) return fmt::format("triangle {} is of another layer", t);
  }
  return {};
}

TriangleFlags may_be_clean(CaseFacts& facts, std::size_t s, const TriangleFlags& in_question) {
  TriangleFlags in_doubt = dirty_triangles(facts, s);
  for (std::size_t t = 0; t < in_doubt.size(); ++t) in_doubt[t] |= in_question[t];
  return clean_beside(facts, s, in_question, in_doubt);
}

bool has_account(CaseFacts& facts, std::size_t s) {
  if (facts.options().arithmetic != detector::Arithmetic::exact) return false;
  if (!facts.is_judged(s) || !facts.is_trusted(s)) return false;
  const auto p = facts.known_from(s);
  return !p || has_account(facts, *p);
}

TriangleFlags in_doubt_after(CaseFacts& facts, std::size_t s) {
  TriangleFlags flags = account_of_dirty(facts, s);
  const bool has_views = facts.has_views(s);
  const bool incomplete = facts.options().pairs != detector::Pairs::all &&
                          facts.judgement(s).answer == detector::Answer::collision;
  for (std::size_t t = 0; t < flags.size(); ++t) {
    const bool swept_clean =
        has_views ? !facts.touched(s)[t] : !facts.has_ghosts(component_of(facts, t));
    flags[t] |= incomplete | facts.own_contacts(s)[t] | !swept_clean;
  }
  return flags;
}

TriangleFlags dirty_at_a_new_start(CaseFacts& facts, std::size_t s) {
  const auto start = facts.options().start;
  const bool looks_alone = facts.starts_by_view_alone();
  TriangleFlags dirty;
  if (!looks_alone && start != detector::Start::unknown) {
    for (const auto clean : facts.layers_at_start(s).clean) dirty.push_back(clean == 0);
    return dirty;
  }
  TriangleFlags free;
  for (std::size_t c = 0; c < facts.surface().mesh.components.size(); ++c)
    free.push_back(facts.is_free_by_view(s, c) ||
                   (looks_alone && is_free_by_view_at_start(facts, s, c)));
  for (std::size_t t = 0; t < facts.surface().mesh.triangles.size(); ++t)
    dirty.push_back(!free[component_of(facts, t)]);
  return dirty;
}

TriangleFlags account_of_dirty(CaseFacts& facts, std::size_t s) {
  const auto p = facts.known_from(s);
  if (!facts.has_views(s)) {
    if (p) return in_doubt_after(facts, *p);
    return TriangleFlags(facts.surface().mesh.triangles.size(),
                         facts.options().start != detector::Start::clean);
  }
  if (!p) return dirty_at_a_new_start(facts, s);
  TriangleFlags dirty = in_doubt_after(facts, *p);
  const auto released = clean_beside(facts, s, dirty, dirty);
  for (std::size_t t = 0; t < dirty.size(); ++t) dirty[t] = dirty[t] && !released[t];
  return dirty;
}

TriangleFlags dirty_triangles(const CaseFacts& facts, std::size_t s) {
  TriangleFlags dirty;
  for (const auto doubts : facts.result(s).doubts) {
    dirty.push_back((doubts & detector::doubt::dirty) != 0);
  }
  return dirty;
}

}  // namespace assay::properties
