// Walks of a mesh under a limiter: each step starts where the limiter let the last one stop, as in
// a simulator. So it comes to lie nearer and nearer to itself, which cases that are known
// beforehand do not show.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "properties/claims/contract.h"

namespace assay::properties {

// What the bodies of a walk are driven to do. All of them are tetrahedra, above a floor of two
// triangles at rest or between two such plates.
enum class WalkKind : std::uint8_t {
  resting,      // one falls onto the floor, is pushed about there, and lifted now and then
  sliding,      // one is pushed down and along
  pile,         // three lie on one another
  closing_gap,  // two are driven through each other, to the same goal again and again
  far_goal,     // one falls by a thousand times its size in each step
  squeezed,     // two plates come together about one
  far_away,     // a pile, 2^20 of its sizes from the origin
};
constexpr auto names_of(WalkKind) {
  using enum WalkKind;
  return std::to_array<Named<WalkKind>>({{resting, "resting"},
                                         {sliding, "sliding"},
                                         {pile, "pile"},
                                         {closing_gap, "closing-gap"},
                                         {far_goal, "far-goal"},
                                         {squeezed, "squeezed"},
                                         {far_away, "far-away"}});
}

// The id of a walk, "walk-pile", and what all of them begin with.
inline constexpr const char* walk_in_id = "walk-";
std::string name_of_walk(WalkKind kind);

// The number of steps of a walk in a campaign.
inline constexpr int steps_of_a_walk = 1000;

// Where the limiter lets the mesh stop in a step; nothing if it does not say.
using AskedLimit = std::function<std::optional<detector::Positions>(const corpus::Case& one_step)>;

// The walk as a case, with a step from each place to its goal: whoever knows nothing of the limiter
// can play it again. Goals are rounded as the contract says, and a step that it does not take is
// none of the walk. If the limiter does not say where to stop, or stops where numbers cannot
// express it, that step is the last. The seed draws shapes, pushes and lifts. At the start the
// bodies are farther apart than the separation of the contract.
corpus::Case walk(WalkKind kind, std::uint64_t seed, int steps, const Contract& contract,
                  const AskedLimit& ask);

}  // namespace assay::properties
