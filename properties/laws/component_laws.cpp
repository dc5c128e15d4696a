// L10: components have views of their own, and a pair of two components is always a candidate.
#include <fmt/format.h>

#include <algorithm>

#include "properties/laws/law_groups.h"
#include "properties/laws/metamorphic/component_alone.h"
#include "properties/laws/step_law.h"

namespace assay::properties {
namespace {

using detector::PairContact;
using detector::ViewSign;

// Whether signs and doubts would leave the pair out of K if it were inside one component.
bool is_left_out_by_signs(CaseFacts& facts, std::size_t s, const detector::TrianglePair& pair) {
  const auto sign = [&](std::int32_t t) { return facts.signs(s)[at(t)]; };
  return !facts.in_doubt(s, pair.a) && !facts.in_doubt(s, pair.b) &&
         sign(pair.a) != ViewSign::zero && sign(pair.a) == sign(pair.b);
}

Observation pairs_of_two_components_need_no_signs(CaseFacts& facts, std::size_t s) {
  if (!facts.has_views(s) || !facts.is_judged(s)) return not_met();
  const auto& found = facts.result(s).pairs;
  bool premise_held = false;
  for (const auto& contact : facts.judgement(s).pairs) {
    if (facts.same_component(contact.pair)) continue;
    if (!is_left_out_by_signs(facts, s, contact.pair)) continue;
    premise_held = true;
    const auto same = [&](const PairContact& c) {
      return c.pair == contact.pair && c.time == contact.time;
    };
    if (std::none_of(found.begin(), found.end(), same)) {
      return fmt::format("({}, {}) of two components is missing or has another time",
                         contact.pair.a, contact.pair.b);
    }
  }
  return premise_held ? holds() : not_met();
}

bool boxes_meet(const CaseFacts& facts, std::size_t s) {
  const auto& components = facts.surface().mesh.components;
  std::vector<std::array<Eigen::RowVector3d, 2>> boxes;
  for (const auto& component : components) {
    std::array<Eigen::RowVector3d, 2> box = {facts.x_t0(s).row(component.vertices[0]),
                                             facts.x_t0(s).row(component.vertices[0])};
    for (const auto v : component.vertices) {
      box[0] = box[0].cwiseMin(facts.x_t0(s).row(v));
      box[1] = box[1].cwiseMax(facts.x_t0(s).row(v));
    }
    for (const auto& other : boxes) {
      if ((box[0].array() <= other[1].array()).all() && (other[0].array() <= box[1].array()).all())
        return true;
    }
    boxes.push_back(box);
  }
  return false;
}

// The oracle's layers of one component if everything else is taken away.
oracle::LayerState layers_alone(CaseFacts& facts, std::size_t s, std::size_t component) {
  const auto& surface = facts.surface();
  detector::Triangles own(0, 3), ghosts(0, 3);
  for (const auto t : surface.all().components[component].triangles) {
    const auto& v = surface.all().triangles[at(t)];
    auto& list = at(t) < surface.mesh.triangles.size() ? own : ghosts;
    list.conservativeResize(list.rows() + 1, 3);
    list.bottomRows(1) << v[0], v[1], v[2];
  }
  return oracle::layers_at(oracle::Instant(facts.all_t0(s)), own, ghosts);
}

Observation components_are_clean_by_themselves(CaseFacts& facts, std::size_t s) {
  const auto& components = facts.surface().mesh.components;
  if (!facts.has_views(s) || facts.known_from(s) || components.size() < 2) return not_met();
  if (facts.options().start != detector::Start::verified || !boxes_meet(facts, s)) return not_met();
  for (std::size_t c = 0; c < components.size(); ++c) {
    const auto alone = layers_alone(facts, s, c);
    for (std::size_t i = 0; i < components[c].triangles.size(); ++i) {
      const auto t = components[c].triangles[i];
      const bool dirty = (facts.result(s).doubts[at(t)] & detector::doubt::dirty) != 0;
      if (dirty && facts.starts_by_view_alone()) continue;
      if (dirty == (alone.clean[i] != 0)) {
        return fmt::format("triangle {} is {}, in its component alone {}", t,
                           dirty ? "dirty" : "clean", alone.clean[i] ? "clean" : "not");
      }
    }
  }
  return holds();
}

constexpr Law component_law_table[] = {
    {"L10_PairsOfTwoComponentsNeedNoSigns", "L10",
     "Triangles of two components that meet are found, with their first time, also where both are "
     "clean and of one strict sign.",
     "pair set, view signs", each_step<pairs_of_two_components_need_no_signs>},
    {"L10_ComponentsAreCleanByThemselves", "L10",
     "At a new start with components in each other's boxes (nested, or interpenetrating) dirty is "
     "what would be if each were alone: layers count the own component.",
     "layers of each component alone", each_step<components_are_clean_by_themselves>},
    {"L10_EachComponentAsIfAlone", "L10",
     "A component run by itself, from its own primitive and apexes, has the same signs, doubts and "
     "contacts of its own as among the others.",
     "nothing", check_component_alone},
};

}  // namespace

std::span<const Law> component_laws() { return component_law_table; }

}  // namespace assay::properties
