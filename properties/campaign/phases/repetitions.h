// Puts large meshes to a plug-in. The oracle judges some of their steps, and a plug-in that claims
// to be deterministic runs them again and again. This tries its claims beyond the small meshes of
// the trials, which fit into any buffer, and in which threads have little to share out.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "corpus/scenes/scenes.h"
#include "properties/campaign/ledger/store.h"
#include "properties/campaign/request.h"
#include "properties/claims/claims.h"

namespace assay::properties {

// The numbers of threads, in turn, for a plug-in that asks how many it may use. The last is told
// twice.
inline constexpr std::uint64_t repeated_threads[] = {1, 2, 4, 4};

// How many threads the plug-in may use, run by run.
std::vector<std::uint64_t> threads_of_runs(const CampaignRequest& request);

// Whether the plan puts large meshes to this detector. It must be a plug-in of steps, or of a broad
// phase.
bool is_repeated(const CampaignPlan& plan, bool built_in);

// A scene as it is put to a plug-in, in one of its forms. Form 0 has the wanted number of
// triangles. The size of the others lies between that and the largest of the trials, and about half
// of them are several smaller copies side by side, which makes many components. The seed draws
// these sizes, the number of frames, the order of vertices, triangles and corners, and one linear
// map near the identity, through which all frames go. So these meshes are known to nobody before
// the seed is. The map keeps contacts and their times, but for what rounding decides.
inline constexpr int forms_of_a_scene = 3;
corpus::Case repeated_scene(const corpus::SceneInfo& scene, std::uint64_t triangles,
                            std::uint64_t seed, int form);

// A small mesh in many steps, so that one handle commits more often than in any other case. It is a
// scene in which the mesh meets itself, of some tens of triangles, played there and back until all
// steps are done: it meets itself again and again, up to the last steps. All of it goes through a
// linear map near the identity that drifts slowly, so no step is like another. The seed draws the
// scene, the size, the number of steps and the rest, as for repeated_scene.
inline constexpr int fewest_long_steps = 120, most_long_steps = 200;
inline constexpr const char* name_of_long_sequence = "long-sequence";  // by which it is stored
corpus::Case long_sequence(std::uint64_t seed);

// Puts every scene of the corpus, as the seed draws it, the long sequence, and the request's other
// sequences to the plug-in: with each of repeated_threads if it asks how many it may use, else
// three times; once if it does not claim to be deterministic. Each run has a process of its own but
// for the last, which is a second run in the process of the run before it. Stores a JudgedSource
// for each mesh that is not stored yet. If an answer differs from that of the first run, or a run
// ends in a way that breaks a claimed `total`, that is a failure of the run, whose mesh is the step
// that differs. A run that hangs is reported and breaks nothing; after three such meshes no further
// one is run.
//
// Of each scene the oracle judges two steps by the first run: the one with the fewest contacts
// that the contract does not leave out, and the first without any, in so far as there are such. It
// also judges up to two steps in which a claim is broken if the built-in detector is right. The
// built-in detector chooses the steps, and decides nothing else. Where a claim is broken, that is a
// failure of the run, whose mesh is the step alone, or, where it fails only after the steps before
// it, the scene up to this step. Of the long sequence the oracle judges every step, and the first
// four steps of each signature are kept.
//
// A limiter is walked besides, in each WalkKind, and the oracle judges every step.
//
// Throws StoreProblem; so it is for campaign/ alone.
void repeat_large_meshes(const CampaignRequest& request, Store& store, RunDeadline deadline,
                         const std::function<void(const std::string&)>& progress);

// Walks of a mesh under a limiter (walks.cpp): each step starts where the limiter let the last one
// stop, as in a simulator. So it comes to lie nearer and nearer to itself, which cases that are
// known beforehand do not show.

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
