#include "properties/laws/metamorphic/component_alone.h"

#include <fmt/format.h>

#include <algorithm>

#include "properties/laws/metamorphic/pinned_run.h"
#include "properties/laws/step_law.h"
#include "properties/random.h"

namespace assay::properties {
namespace {

// Takes out one component. Vertices keep their numbers, but no triangle uses those of other
// components.
PinnedRun taken_out(const CaseFacts& facts, const PinnedRun& run, std::size_t component) {
  const auto& mesh = facts.surface().mesh;
  const auto& own = mesh.components[component];
  PinnedRun alone{{}, run.frames, run.script, {0}, {}, {}, {}};
  alone.triangles.resize(static_cast<Eigen::Index>(own.triangles.size()), 3);
  for (std::size_t i = 0; i < own.triangles.size(); ++i) {
    alone.triangles.row(static_cast<Eigen::Index>(i)) = run.triangles.row(own.triangles[i]);
  }
  alone.apexes.resize(run.script.size());
  for (std::size_t l = 0; l < run.loops.size(); ++l) {
    if (!std::binary_search(own.vertices.begin(), own.vertices.end(), run.loops[l][0])) continue;
    alone.loops.push_back(run.loops[l]);
    for (std::size_t s = 0; s < run.script.size(); ++s) {
      alone.apexes[s].push_back(run.apexes[s][l]);
    }
  }
  for (const auto& of_step : run.primitives) alone.primitives.push_back({of_step[component]});
  return alone;
}

std::string compare(const CaseFacts& facts, const detector::StepResult& among,
                    const detector::StepResult& alone, std::size_t component) {
  const auto& own = facts.surface().mesh.components[component].triangles;
  if (alone.doubts.size() != own.size()) return "no answer alone";
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (among.signs[at(own[i])] != alone.signs[i]) {
      return fmt::format("triangle {} has another sign alone", own[i]);
    }
    if (among.doubts[at(own[i])] != alone.doubts[i]) {
      return fmt::format("triangle {} has other doubts alone", own[i]);
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
    if (!same) return fmt::format("({}, {}) differs alone", contact.pair.a, contact.pair.b);
    ++next;
  }
  return next == alone.pairs.end() ? "" : "more contacts alone";
}

}  // namespace

void check_component_alone(CaseFacts& facts, LawTally& tally) {
  const auto components = facts.surface().mesh.components.size();
  if (components < 2 || facts.options().pairs != detector::Pairs::all) return;
  const auto run = pinned_run(facts);
  if (!run) return;
  Random random(facts.source().id);
  const auto component = static_cast<std::size_t>(random.below(static_cast<int>(components)));
  const PinnedRun alone = taken_out(facts, *run, component);
  auto player = PinnedPlayer::make(alone, options_with_views(facts), facts.stages_of());
  if (!player) return;
  const auto results = player->play();
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    note(facts, s, compare(facts, facts.result(s), results[s], component), tally);
  }
}

}  // namespace assay::properties
