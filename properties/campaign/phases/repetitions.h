// Puts large meshes to a plug-in. The oracle judges some of their steps, and a plug-in that claims
// to be deterministic runs them again and again. This tries its claims beyond the small meshes of
// the trials, which fit into any buffer, and in which threads have little to share out.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "corpus/scenes/scenes.h"
#include "properties/campaign/ledger/store.h"
#include "properties/campaign/request.h"

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
// for the last, which is a second run in the process of the run before it. Stores a Repetition for
// each mesh that is not stored yet. If an answer differs from that of the first run, or a run ends
// in a way that breaks a claimed `total`, that is a failure of the run, whose mesh is the step that
// differs. A run that hangs is reported and breaks nothing; after three such meshes no further one
// is run.
//
// Of each scene the oracle judges two steps by the first run: the one with the fewest contacts
// that the contract does not leave out, and the first without any, in so far as there are such. It
// also judges up to two steps in which a claim is broken if the built-in detector is right. The
// built-in detector chooses the steps, and decides nothing else. Where a claim is broken, that is a
// failure of the run, whose mesh is the step alone, or, where it fails only after the steps before
// it, the scene up to this step. Of the long sequence the oracle judges every step, and the first
// four steps of each signature are kept.
//
// A limiter is walked besides, in each WalkKind (walks.h), and the oracle judges every step.
//
// Throws StoreProblem; so it is for campaign/ alone.
void repeat_large_meshes(const CampaignRequest& request, Store& store, RunDeadline deadline,
                         const std::function<void(const std::string&)>& progress);

}  // namespace assay::properties
