// L10: components have views of their own, and a pair of two components is always a candidate.

#include <fmt/format.h>

#include <algorithm>

#include "properties/laws/law.h"
#include "properties/laws/metamorphic/pinned_run.h"
#include "properties/laws/step_law.h"
#include "properties/random.h"

namespace assay::properties {

namespace {

// Returns whether signs and doubts would leave the pair out of K if it were inside one component.
bool is_left_out_by_signs(CaseFacts& facts, std::size_t s, const TrianglePair& pair) {
  const auto sign = [&](std::int32_t t) { return facts.signs(s)[at(t)]; };
  return !facts.in_doubt(s, pair.a) && !facts.in_doubt(s, pair.b) &&
         sign(pair.a) != ViewSign::zero && sign(pair.a) == sign(pair.b);
}

Observation pairs_of_two_components_need_no_signs(CaseFacts& facts, std::size_t s) {
  if (!facts.has_views(s) || !facts.is_judged(s)) return not_met();
  const auto& pairs = facts.result(s).pairs;
  bool premise_held = false;
  for (const auto& contact : facts.judgement(s).pairs) {
    if (facts.same_component(contact.pair)) continue;
    if (!is_left_out_by_signs(facts, s, contact.pair)) continue;
    // With Pairs::first, no later contact is reported.
    if (facts.options().pairs == detector::Pairs::first &&
        contact.time > facts.judgement(s).first) {
      continue;
    }
    premise_held = true;
    const auto same = [&](const PairContact& c) {
      return c.pair == contact.pair && c.time == contact.time;
    };
    if (std::ranges::none_of(pairs, same)) {
      return fmt::format("({}, {}) of two components is missing or has a wrong time",
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

// Returns the oracle's layers of one component if everything else is taken away.
oracle::LayerState layers_alone(CaseFacts& facts, std::size_t s, std::size_t component) {
  const auto& surface = facts.surface();
  std::vector<std::array<std::int32_t, 3>> own, ghosts;
  for (const auto t : surface.all().components[component].triangles)
    (at(t) < surface.mesh.triangles.size() ? own : ghosts)
        .push_back(surface.all().triangles[at(t)]);
  return oracle::layers_at(oracle::Instant(facts.all_t0(s)), as_rows<Triangles>(own),
                           as_rows<Triangles>(ghosts));
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
        return fmt::format("triangle {} is {}; if its component is alone, it is {}", t,
                           dirty ? "dirty" : "clean", alone.clean[i] ? "clean" : "not clean");
      }
    }
  }
  return holds();
}

std::string difference_alone(const CaseFacts& facts, const StepResult& among,
                             const StepResult& alone, std::size_t component) {
  const auto& own = facts.surface().mesh.components[component].triangles;
  if (alone.doubts.size() != own.size()) return "no answer if the component is alone";
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (among.signs[at(own[i])] != alone.signs[i]) {
      return fmt::format("triangle {} has a different sign if its component is alone", own[i]);
    }
    if (among.doubts[at(own[i])] != alone.doubts[i]) {
      return fmt::format("triangle {} has other doubts if its component is alone", own[i]);
    }
  }
  auto next = alone.pairs.begin();
  for (const auto& contact : among.pairs) {
    const auto c = static_cast<std::int32_t>(component);
    if (facts.component_of(contact.pair.a) != c || facts.component_of(contact.pair.b) != c) {
      continue;
    }
    const bool same = next != alone.pairs.end() && own[at(next->pair.a)] == contact.pair.a &&
                      own[at(next->pair.b)] == contact.pair.b && next->time == contact.time;
    if (!same) return fmt::format("({}, {}) differs if run alone", contact.pair.a, contact.pair.b);
    ++next;
  }
  return next == alone.pairs.end() ? "" : "more contacts if the component is alone";
}

// Checks that a component by itself behaves as it does among others. One component is checked,
// chosen by the case's id, if there are two or more and all pairs are asked for (after a collision
// whose later contacts are unknown all components are dirty, L8).
void check_component_alone(CaseFacts& facts, LawTally& tally) {
  const auto components = facts.surface().mesh.components.size();
  if (components < 2 || facts.options().pairs != detector::Pairs::all) return;
  const auto run = pinned_run(facts);
  if (!run) return;
  Random random(facts.source().id);
  const auto component = static_cast<std::size_t>(random.below(static_cast<int>(components)));
  // Vertices keep their numbers, but no triangle uses those of other components.
  Case alone = *run;
  alone.triangles =
      run->triangles(facts.surface().mesh.components[component].triangles, Eigen::all).eval();
  auto player = PinnedPlayer::make(alone, options_with_views(facts), facts.stages_of());
  if (!player) return;
  const auto results = player->play();
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    note(facts, s, difference_alone(facts, facts.result(s), results[s], component), tally);
  }
}

constexpr Law component_law_table[] = {
    {"L10_PairsOfTwoComponentsNeedNoSigns", "L10",
     "Triangles of two components that meet are found, with their first time, even if both "
     "triangles are clean and have the same strict sign.",
     "pair set, view signs", each_step<pairs_of_two_components_need_no_signs>},
    {"L10_ComponentsAreCleanByThemselves", "L10",
     "At a new start, a component in the box of another one (nested, or interpenetrating) has the "
     "same dirty triangles as if it were alone: its layers count only its own triangles.",
     "layers of each component alone", each_step<components_are_clean_by_themselves>},
    {"L10_EachComponentAsIfAlone", "L10",
     "A component that is run alone, with its own primitive and apexes, has the same signs, doubts "
     "and own contacts as in the whole mesh.",
     "nothing", check_component_alone},
};

}  // namespace

std::span<const Law> component_laws() { return component_law_table; }

}  // namespace assay::properties
