// Runs the phases of a campaign: planted faults, large meshes, the search, the shrinking of
// failures, and all of them in order.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "corpus/scenes/scenes.h"
#include "properties/campaign/ledger/evidence.h"
#include "properties/campaign/ledger/store.h"
#include "properties/campaign/request.h"
#include "properties/campaign/trials/trials.h"
#include "properties/claims/claims.h"
#include "properties/faults/fault.h"
#include "properties/judging/exam.h"
#include "properties/judging/verdict.h"
#include "properties/reducer/reducer.h"
#include "properties/search/search.h"
#include "properties/worker/worker_process.h"

namespace assay::properties {

// Plants every registered fault in the detector and counts the cases that the harness needs to
// find it.

struct FaultHunt {
  std::string campaign;  // for ids: campaign:seed.fSEED:family:index
  std::uint64_t seed = 1;
  int seeds = 1;
  std::uint64_t cases = 0;  // at most, for each seed, from all families in turn
  int jobs = 1;
  std::filesystem::path curated;  // folder of the curated cases; empty: not tried
};

// Is told the progress of a phase, in words.
using OnText = std::function<void(const std::string&)>;
// Is told the progress of a hunt, in words, and how many cases are done and left.
using OnHunt = std::function<void(const std::string&, std::uint64_t count, std::uint64_t rest)>;

// Hunts for all registered faults. One judgement of a case by the oracle serves all faults. A fault
// that is found under a seed leaves the round of that seed; equivalent and open faults stay to the
// end of each round. The result does not depend on the number of jobs, unless the deadline ends it.
// About 0.2 ms for each case and each fault still in the round.
std::vector<FaultProof> hunt_faults(const FaultHunt& hunt, RunDeadline deadline,
                                    const OnHunt& progress);

// Returns the failure that the fault shows in a case, judged by the claims of its options; nothing
// if the case holds. If `results` has no judgement of the oracle yet, the oracle is asked, and its
// judgement serves the next fault too.
std::optional<Failure> failure_of_fault(const Fault& fault, CaseResults& results);

// The canary is a detector that is known to be wrong. It goes through the same checks as the
// detector under test. If a run does not find it, the run is blind.

// Runs random cases of all families in turn, 400 at most, until the planted fault shows. Throws
// StoreProblem if there is no worker.
Canary meet_canary(const CampaignRequest& request);

// Takes over, from another run of the same build, the proof that planted faults are found. Planted
// faults test the harness of a build, not the detector that it judges, so the run of a plug-in need
// not plant them again.

// Returns the proof in `folder` for the request. Fails
//   if the request's plan plants no faults, or if read_findings fails;
//   if the folder is `out` or lies below it;
//   if the digests of program, worker or generator differ;
//   if the run in `folder` did not find every planted fault itself, or gave a fault fewer cases or
//   seeds than the plan asks for.
// REQUIRES that no code of a plug-in has run in this process's workers yet, because such code could
// change the files that are read here.
Expected<PowerProof> take_power(const std::filesystem::path& folder,
                                const std::filesystem::path& out, const CampaignRequest& request);

// Puts large meshes to a plug-in. The oracle judges some of their steps, and a plug-in that claims
// to be deterministic runs them again and again. This tries its claims beyond the small meshes of
// the trials, which fit into any buffer and have little work for threads to share.

// The numbers of threads, in turn, for a plug-in that asks how many it may use. The last number is
// given to two runs.
inline constexpr std::uint64_t repeated_threads[] = {1, 2, 4, 4};

// Returns how many threads the plug-in may use, run by run.
std::vector<std::uint64_t> threads_of_runs(const CampaignRequest& request);

// Returns whether the plan puts large meshes to this detector. The detector must be a plug-in of
// steps, or of a broad phase.
bool is_repeated(const CampaignPlan& plan, bool built_in);

// Returns one of the forms in which a scene is put to a plug-in. Form 0 has the wanted number of
// triangles. The other forms are between that size and the size of the largest trial. About half of
// them are several smaller copies side by side, which makes many components. The seed draws these
// sizes, the number of frames, the order of vertices, triangles and corners, and one linear map
// near the identity, through which all frames go. So nobody knows these meshes before the seed is
// known. The map keeps contacts and their times, unless rounding decides them.
inline constexpr int forms_of_a_scene = 3;
Case repeated_scene(const corpus::SceneInfo& scene, std::uint64_t triangles, std::uint64_t seed,
                    int form);

// Returns a small mesh in many steps, so that one handle commits more often than in any other case.
// A scene of some tens of triangles, in which the mesh meets itself, is played forwards and
// backwards until all steps are done, so the mesh meets itself up to the last steps. All frames go
// through a linear map near the identity that drifts slowly, so no two steps are equal. The seed
// draws the scene, the size, the number of steps and the rest, as for repeated_scene.
inline constexpr int fewest_long_steps = 120, most_long_steps = 200;
inline constexpr const char* name_of_long_sequence = "long-sequence";  // the name in the store
Case long_sequence(std::uint64_t seed);

// Puts every scene of the corpus, as the seed draws it, the long sequence, and the request's other
// sequences to the plug-in. A plug-in that claims to be deterministic runs each of them with each
// of repeated_threads if it asks how many it may use, else three times; any other plug-in runs each
// once. Each run has a process of its own, except the last, which is a second run in the process of
// the run before it. Stores a JudgedSource for each mesh that is not stored yet. If an answer
// differs from that of the first run, or a run ends in a way that breaks a claimed `total`, that is
// a failure, whose mesh is the step that differs. A run that hangs is reported and breaks nothing;
// after three such meshes no further mesh is run.
//
// The oracle judges two steps of each scene, as the first run answered them: the step with the
// fewest contacts, and the first step without any. Contacts that the contract leaves out do not
// count. A scene may lack such a step. It also judges up to two steps whose answers break a claim
// if the built-in detector is right. That detector only chooses the steps; it decides nothing. A
// step that breaks a claim is a failure, whose mesh is the step alone, or, if the step fails only
// after the steps before it, the scene up to this step. In the long sequence the oracle judges
// every step, and the first four failing steps of each signature are kept.
//
// A limiter also makes a walk of each WalkKind, and the oracle judges every step.
//
// Throws StoreProblem; so it is for campaign/ alone.
void repeat_large_meshes(const CampaignRequest& request, Store& store, RunDeadline deadline,
                         const OnText& progress);

// Walks a mesh under a limiter (walks.cpp): each step starts where the limiter let the last step
// stop, as in a simulator. So the mesh comes nearer and nearer to itself, which cases that are
// fixed beforehand do not show.

// The movement to which the bodies of a walk are driven. All bodies are tetrahedra, above a floor
// of two triangles at rest or between two such plates.
enum class WalkKind : std::uint8_t {
  resting,      // one body falls onto the floor, is pushed about there, and lifted now and then
  sliding,      // one body is pushed down and along
  pile,         // three bodies lie on one another
  closing_gap,  // two bodies are driven through each other, to the same goal again and again
  far_goal,     // one body falls by a thousand times its size in each step
  squeezed,     // two plates close on one body
  far_away,     // a pile, 2^20 of its sizes from the origin
};
// Names the walks; the names are their ids.
constexpr auto names_of(WalkKind) {
  using enum WalkKind;
  return std::to_array<Named<WalkKind>>({{resting, "walk-resting"},
                                         {sliding, "walk-sliding"},
                                         {pile, "walk-pile"},
                                         {closing_gap, "walk-closing-gap"},
                                         {far_goal, "walk-far-goal"},
                                         {squeezed, "walk-squeezed"},
                                         {far_away, "walk-far-away"}});
}

// The number of steps of a walk in a campaign.
inline constexpr int steps_of_a_walk = 1000;

// Returns where the limiter lets the mesh stop in a step; nothing if it does not say.
using AskedLimit = std::function<std::optional<Positions>(const Case& one_step)>;

// Returns the walk as a case, with a step from each place to its goal, so that it can be played
// again without the limiter. Goals are rounded as the contract says, and a step that the contract
// does not take is left out of the walk. If the limiter does not say where to stop, or stops at a
// place that numbers cannot express, that step is the last. The seed draws shapes, pushes and
// lifts. At the start the bodies are farther apart than the separation of the contract.
Case walk(WalkKind kind, std::uint64_t seed, int steps, const Contract& contract,
          const AskedLimit& ask);

// Runs a campaign from its canary to its worlds. Each phase stores its findings and tells an
// observer. They are read back (findings.h) and judged (gates.h).

// The search of a campaign (search/search.h): after the trials, in lanes that share nothing, each
// in a thread with a worker process of its own (search.cpp).

// Searches in the lanes of this run that are not stored yet, and stores the result of each: its
// defects with their meshes, then the lane itself. So a killed run, started again, repeats the
// lanes that were cut, with the same results. These depend on plan, seed and share alone, not on
// the number of jobs; a lane that the deadline ends is not stored. `corpus` is the folder of the
// curated cases. `progress` is called from one thread at a time. Throws StoreProblem; so it is for
// campaign/ alone.
void search_share(const CampaignRequest& request, const std::filesystem::path& corpus, Store& store,
                  RunDeadline deadline, const OnText& progress);

// Shrinks the cases on which a detector fails.

// Returns a judge that runs a case in the worker and asks the oracle; the judge returns nothing if
// the case holds. The arguments must outlive it. `jobs`: threads of the oracle for large meshes.
Judge judge_of_detector(const DetectorUnderTest& detector, const Configuration& configuration,
                        WorkerProcess& worker, int jobs = 1);

// Shrinks one case, by judge_of_detector.
Reduction shrink_case(const Case& failing, const DetectorUnderTest& detector,
                      const Configuration& configuration, WorkerProcess& worker,
                      const ReduceLimits& limits, const OnBetter& on_better = {}, int jobs = 1);

// Shrinks the first stored failure of each signature (failures of one signature break the same
// claim in the same way). Failures that were shrunk before, or that the store calls flaky, are left
// alone. A failure that its own case does not show in a new process becomes flaky; then the next
// two of the signature are tried. A failure whose shrinking was interrupted goes on from its
// smallest mesh so far. Each better mesh is stored as soon as it is found. `limits` hold for each
// failure, the deadline for all. Throws StoreProblem, which only campaign/ catches.
void shrink_failures(const CampaignRequest& request, Store& store, const ReduceLimits& limits,
                     RunDeadline deadline, const OnText& progress);

// Returns the finding that the reducer preserves while it shrinks a failure.
Finding finding_of(const Failure& failure);

// Is told about the phases of a campaign, in their order. Each function may be called from a thread
// other than the caller's, but by one thread at a time.
class CampaignObserver {
 public:
  virtual ~CampaignObserver() = default;
  // Is called first, with the number of trials that are in the store already.
  virtual void on_begin(std::uint64_t /*trials*/) {}
  // Is called when a phase begins: "trials", "repetitions", "search", "shrinking", "faults" or
  // "tetrahedron". The first call comes after the canary.
  virtual void on_phase(const char* /*phase*/) {}
  virtual void on_canary(const Canary&) {}
  virtual void on_trial(const TrialProgress&) {}
  virtual void on_trials(const TrialsEnd&) {}
  // Is told the progress of the phase in words; if it can be counted, also how much is done and
  // left.
  virtual void on_progress(const std::string&, std::uint64_t /*done*/, std::uint64_t /*left*/) {}
  // Is called when all trials and their failures are stored; faults and worlds are still to come.
  virtual void on_failures_shrunk(const FailureList&) {}
};

// Does all work whose results are not in the store yet: the trials, the shrinking of failures, and
// the planted faults (or it takes the request's proof of them). Trials have nine tenths of the
// plan's time; if some are missing then, failures are shrunk in the last tenth and nothing else is
// begun. The canary and the worlds of tetrahedra are always done again; of two results for a world,
// the result that came farther stays. A share does the same worlds and large meshes as a whole
// campaign, because they take little time. `corpus` is the folder of the curated cases.
//
// Stored rows stay, whatever happens. Fails if the store cannot be read or written any more.
Expected<void> run_campaign(const CampaignRequest& request, const std::filesystem::path& corpus,
                            Store& store, CampaignObserver& observer);

// Returns the seconds of the clock that the shrinking of failures may take: the plan's shrink_share
// of its own limit, or two minutes if it has no limit.
double shrinking_seconds(const CampaignPlan& plan);

// Keeps the failures of curated cases and scenes, each with a small mesh, as for failing trials.

// Takes the failures whose signature is not in the store yet, and stores the smallest mesh of each
// such signature. Then it shrinks these meshes. Each takes at most a minute, and all together at
// most the share of the plan's time that is reserved for shrinking. REQUIRES failures in the order
// of the corpus. The rows of an earlier call stay. `progress` is called with the signature that is
// being shrunk.
// Returns the stored failures of the corpus.
Expected<FailureList> shrink_corpus_failures(const CampaignRequest& request,
                                             const std::vector<FailureRecord>& failures,
                                             Store& store, const OnText& progress);

// Stores the rows of the corpus, and removes the failures of an earlier call that the corpus does
// not show any more. In a run (`now`) the smallest mesh of each signature is stored at once, and
// shrunk with the failures of the trials; in a certificate (`later`) shrink_corpus_failures does
// both.
enum class KeepMeshes : std::uint8_t { now, later };
Expected<void> keep_corpus(Store& store, const std::vector<JudgedSource>& rows,
                           const std::vector<FailureRecord>& failures, KeepMeshes when);

// Makes and judges stored trials once more, and compares the results with the stored ones.

struct TrialsAgain {
  std::uint64_t trials = 0;  // trials that were run once more
  std::uint64_t all = 0;     // trials that are stored
  // The first trial, by family and index, whose result differs: "trial ID: bvh is D now, H is
  // stored".
  std::optional<std::string> difference;
};

// Draws, by `seed`, a share (above 0, at most 1) of the trials that the stores of a folder hold,
// but at least one. Runs them again as the request says, and compares with the store: the outcomes
// in every configuration, and triangles, steps, collisions, pairs, counts and mesh. It does not
// compare times. A trial that ended at its time limit may have another result on a slower machine.
//
// REQUIRES a request with the plan and the detector of the stores; each store states its own seed
// and share. Fails if a store cannot be read, if the detector cannot be run, and if no trial is
// stored. Costs O(trials stored) to draw them, then the time that they took in the first run.
Expected<TrialsAgain> run_again(CampaignRequest request, const std::filesystem::path& folder,
                                double share, std::uint64_t seed, const OnTrial& progress);

}  // namespace assay::properties
