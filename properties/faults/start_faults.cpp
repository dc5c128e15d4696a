// Wrong decisions about which triangles are clean at the start of a step: by views (L5) or by
// layers (L9).
#include <algorithm>

#include "detector/geometry/winding.h"
#include "detector/search/feature_contacts.h"
#include "detector/state/layers.h"
#include "properties/faults/planting.h"

namespace assay::properties {

using namespace detector;  // whose stages the faults replace
namespace {

using Flags = std::vector<std::uint8_t>;
using Components = std::vector<std::int32_t>;

// Adds the triangles that meet another one of their component at t=0.
void add_own_contacts(const GivenStep& step, std::size_t c, Flags& touched) {
  FeatureContacts contacts(step.surface.mesh, step.motion.at_start(), step.elementary,
                           Want::yes_no);
  const auto own = step.own_triangles(c);
  for (std::size_t i = 0; i < own.size(); ++i) {
    for (std::size_t j = i + 1; j < own.size(); ++j) contacts.add_candidate(own[i], own[j], true);
  }
  contacts.run({});
  for (const auto& pair : contacts.take_new_pairs()) touched[at(pair.a)] = touched[at(pair.b)] = 1;
}

enum class StartLayers { by_piece, of_component, not_looked_at };

// The check of a new start, composed anew with parts of it missing or changed.
template <bool contacts, bool ghosts, StartLayers layers>
struct StartHalfChecked : ReleaseRule {
  bool verify_start(const GivenStep& step, StepMarks& marks, StepCost& cost,
                    const Components& components) const override {
    Flags touched(step.surface.mesh.triangles.size(), 0);
    step.tree.refit(step.surface.mesh, step.motion.at_start());
    const GhostSweep still{step.surface, step.tree, step.motion.at_start(), step.elementary, true};
    Flags is_seen(step.surface.all().triangles.size(), 0);
    for (const auto component : components) {
      const std::size_t c = at(component);
      if (contacts) add_own_contacts(step, c, touched);
      if (ghosts) {
        step.boundary.sweep(still, step.ghosts(c), step.stop, touched, cost.counts.ghosts);
      }
      detector::mark_clean_by_layers({step.surface, step.motion.vertices_t0, touched}, c, is_seen,
                                     marks.clean);
      if (layers == StartLayers::by_piece) continue;
      const auto own = step.own_triangles(c);
      const bool some = layers == StartLayers::not_looked_at ||
                        std::ranges::any_of(own, [&](auto t) { return marks.clean[at(t)] != 0; });
      for (const auto t : own) marks.clean[at(t)] = some && !touched[at(t)];
    }
    return true;
  }
};

// Takes the layer of the lowest untouched triangle for the common one, however few triangles have
// it.
struct LowestLayerIsCommon : ReleaseRule {
  bool verify_start(const GivenStep& step, StepMarks& marks, StepCost& cost,
                    const Components& components) const override {
    if (!ReleaseRule::verify_start(step, marks, cost, components)) return false;
    for (const auto component : components) {
      const std::size_t c = at(component);
      Flags touched(step.surface.mesh.triangles.size(), 0);
      add_own_contacts(step, c, touched);
      const GhostSweep still{step.surface, step.tree, step.motion.at_start(), step.elementary,
                             true};
      step.boundary.sweep(still, step.ghosts(c), step.stop, touched, cost.counts.ghosts);
      std::optional<int> common;
      for (const auto t : step.own_triangles(c)) {
        marks.clean[at(t)] = 0;
        if (touched[at(t)]) continue;
        const auto outside = detector::winding_numbers_outside(
            step.surface.all(), step.component(c).triangles, step.motion.vertices_t0, {{t}})[0];
        if (!common) common = outside;
        marks.clean[at(t)] = outside && outside == common;
      }
    }
    return true;
  }
};

struct StartNotChecked : ReleaseRule {
  bool verify_start(const GivenStep& step, StepMarks& marks, StepCost&,
                    const Components& components) const override {
    for (const auto c : components) {
      for (const auto t : step.own_triangles(at(c))) marks.clean[at(t)] = 1;
    }
    return true;
  }
};

bool all_positive(const StepMarks& marks, std::span<const std::int32_t> triangles) {
  return std::ranges::all_of(
      triangles, [&](std::int32_t t) { return marks.signs[at(t)] == ViewSign::positive; });
}

// Returns whether all triangles are positive. `surface` is the surface of the step, or its mesh
// without ghosts.
bool all_positive_at_start(const GivenStep& step, const StepMarks& marks, std::size_t c,
                           const Topology& surface) {
  const auto& primitive = marks.primitives[c];
  return detector::all_positive_at(surface, surface.components[c], step.motion.vertices_t0,
                                   primitive.q0.t0, primitive.q1.t0);
}

struct WindingNotChecked : ReleaseRule {
  bool is_free(const GivenStep& step, const StepMarks& marks, StepCost&,
               std::size_t c) const override {
    return all_positive(marks, step.component(c).triangles);
  }
  bool released_at_start(const GivenStep& step, const StepMarks& marks, StepCost&,
                         std::size_t c) const override {
    return all_positive_at_start(step, marks, c, step.surface.all());
  }
};

// Counts ghosts for the winding number, but does not ask whether they are seen from behind.
struct GhostSignsNotAsked : ReleaseRule {
  bool is_free(const GivenStep& step, const StepMarks& marks, StepCost&,
               std::size_t c) const override {
    return all_positive(marks, step.own_triangles(c)) && is_inside(step, marks, c);
  }
  bool released_at_start(const GivenStep& step, const StepMarks& marks, StepCost&,
                         std::size_t c) const override {
    return all_positive_at_start(step, marks, c, step.surface.mesh) && is_inside(step, marks, c);
  }

 private:
  static bool is_inside(const GivenStep& step, const StepMarks& marks, std::size_t c) {
    return detector::winding_number(step.surface.all(), step.component(c).triangles,
                                    step.motion.vertices_t0, marks.primitives[c].q0.t0) == 1;
  }
};

}  // namespace

std::vector<Fault> start_faults() {
  using enum StartLayers;
  return {
      {wrong<StartNotChecked>, "state/start-not-checked", "L9", "C5_start_intersecting", 6,
       "every start counts as clean"},
      {wrong<StartHalfChecked<false, true, by_piece>>, "state/start-contacts-not-checked", "L9",
       "C5_start_intersecting", 6, "contacts at a new start are not looked for"},
      {wrong<StartHalfChecked<true, false, by_piece>>, "state/start-ghosts-not-checked", "L9",
       "F_late_start", 22, "triangles are released at a new start without the ghost test"},
      {wrong<StartHalfChecked<true, true, not_looked_at>>, "state/start-layers-not-checked", "L9",
       "L9_shared_edge_two_layers", 22, "triangles without contact at a new start are clean"},
      {wrong<StartHalfChecked<true, true, of_component>>, "state/released-when-connected", "L9",
       "L9_shared_edge_two_layers", 6,
       "the layer of one untouched triangle is used for the whole component"},
      {wrong<WindingNotChecked>, "state/winding-not-checked", "L5", "A1_winding2_allpositive", 8,
       "it is enough that all triangles are positive: no winding number is checked"},
      {wrong<GhostSignsNotAsked>, "state/ghost-signs-not-asked", "L5", "D1_open_allplus", 12,
       "it is enough that mesh triangles are positive, even if ghosts are not"},
      {wrong<LowestLayerIsCommon>, "state/lowest-layer-is-common", "L9", "", 0,
       "the common layer is that of the first untouched triangle, not that of most triangles",
       with_points, FaultStatus::equivalent,
       "L3 holds for every layer taken as the common one, so this choice changes only how many "
       "pairs are candidates"},
  };
}

}  // namespace assay::properties
