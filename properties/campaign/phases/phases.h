// Runs a campaign, or one of its phases: planted faults, large meshes, the search, the shrinking of
// failures. Also runs stored trials again.
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

// A hunt plants every registered fault in the detector, and counts for each fault the cases until
// the harness finds it.

struct FaultHunt {
  std::string campaign;  // for ids: campaign:seed.fSEED:family:index
  std::uint64_t seed = 1;
  int seeds = 1;
  std::uint64_t cases = 0;  // the limit for each seed; cases come from all families in turn
  int jobs = 1;
  std::filesystem::path curated;  // folder of the curated cases; empty: they are not tried
};

// Is called with the progress of a phase, in words.
using OnText = std::function<void(const std::string&)>;
// Is called with the progress of a hunt: in words, the number of cases done, and the number of
// cases still to do.
using OnHunt = std::function<void(const std::string&, std::uint64_t count, std::uint64_t rest)>;

// Hunts for all registered faults, in one round for each seed. The oracle judges a case once for
// all faults. A fault that is found leaves the round; equivalent and open faults stay to the end of
// the round. If the deadline does not end the hunt, the result is the same for any number of jobs.
// About 0.2 ms for each case and each fault in the round.
std::vector<FaultProof> hunt_faults(const FaultHunt& hunt, RunDeadline deadline,
                                    const OnHunt& progress);

// Returns the failure of a case in a detector with the planted fault; nothing if the case holds.
// The detector runs with Fault::options, and is judged by what the built-in detector claims under
// these options. If `results` has no judgement of the oracle yet, adds the judgement, which also
// serves the next fault.
std::optional<Failure> failure_of_fault(const Fault& fault, CaseResults& results);

// The canary is a detector that is known to be wrong. It goes through the same checks as the
// detector under test. If these checks do not find the canary, they find nothing.

// Runs the canary on random cases of all families in turn, until its planted fault shows, but on at
// most 400 cases. Throws StoreProblem if there is no worker.
Canary meet_canary(const CampaignRequest& request);

// A run can take over, from another run of the same build, the proof that planted faults are found.
// Planted faults test the harness of a build, so the run of a plug-in need not plant them again.

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

// A campaign also gives large meshes to a plug-in, because the small meshes of the trials fit into
// any buffer and give little work to threads. The oracle judges some steps of these meshes. A
// plug-in that claims to be deterministic runs each mesh several times.

// The greatest number of threads in each run of a mesh, for a plug-in that claims to be
// deterministic and has a function that limits its threads (PluginParts::takes_threads).
inline constexpr std::uint64_t repeated_threads[] = {1, 2, 4, 4};

// Returns for each run of a mesh the greatest number of the plug-in's threads.
std::vector<std::uint64_t> threads_of_runs(const CampaignRequest& request);

// Returns whether the plan gives large meshes to the detector: only to a plug-in that answers steps
// or lists candidates.
bool is_repeated(const CampaignPlan& plan, bool built_in);

// The number of forms in which a scene is given to a plug-in.
inline constexpr int forms_of_a_scene = 3;
// Returns one of the forms in which a scene is given to a plug-in. Form 0 has the wanted number of
// triangles. The size of any other form is between the wanted number and the size of the largest
// trial. About half of the other forms consist of several copies side by side, and so of many
// components. The seed draws the sizes, the number of frames, the order of vertices, triangles and
// corners, and one linear map near the identity, which transforms all frames. So nobody knows these
// meshes before the seed is known. The map does not change contacts and their times, except by
// rounding.
Case repeated_scene(const corpus::SceneInfo& scene, std::uint64_t triangles, std::uint64_t seed,
                    int form);

// The long sequence: the range of its number of steps, and its name.
inline constexpr int fewest_long_steps = 120, most_long_steps = 200;
inline constexpr const char* name_of_long_sequence = "long-sequence";  // the name in the store
// Returns a small mesh in many steps, so that one detector commits more steps than in any other
// case. A scene of 60 to 100 triangles, in which the mesh meets itself, is played forwards and
// backwards again and again, so the mesh meets itself up to the last steps. A linear map near the
// identity, which changes slowly from frame to frame, transforms all frames, so no two steps are
// equal. The seed draws the scene, the size, the number of steps, the numbering and the map.
Case long_sequence(std::uint64_t seed);

// Gives these meshes to the plug-in: every scene of the corpus in each of its forms, the long
// sequence, and CampaignRequest::repeated. The runs of a mesh are those of threads_of_runs: several
// for a plug-in that claims to be deterministic, otherwise one. Each run has a new process, except
// the last of several runs, which uses the process of the run before it again. Stores a
// JudgedSource for each mesh that is not stored yet. A run that gives other answers than the first
// run, or that ends in a way that breaks a claimed `total`, is stored as a failure. If the answers
// differ, the case stored with the failure has only the step whose answer differs. A run that hangs
// is reported, but is no failure; after three meshes with such a run no further mesh is run.
//
// The oracle judges the answers of the first run to some steps of each scene: the step with the
// fewest contacts, the first step without a contact, and up to two steps whose answers break a
// claim if the built-in detector is right. Contacts that the contract leaves out do not count here.
// The built-in detector only chooses steps; all verdicts are by the oracle. A step that breaks a
// claim is stored as a failure. The stored case has only this step, or, if the detector answers the
// step differently without the steps before it, the whole scene up to this step. In the long
// sequence the oracle judges every step, and the first four failing steps of each signature are
// stored.
//
// A limiter also makes a walk of each WalkKind, and the oracle judges every step.
//
// Throws StoreProblem, so this function is only for campaign/.
void repeat_large_meshes(const CampaignRequest& request, Store& store, RunDeadline deadline,
                         const OnText& progress);

// In a walk, as in a simulator, each step starts where a limiter let the step before it stop
// (walks.cpp). So the mesh comes nearer and nearer to itself. Cases that are fixed beforehand do
// not test this.

// The motion of the bodies in a walk, as far as the limiter allows it. All bodies are tetrahedra.
// They lie above a floor, which is a plate of two triangles at rest, or between two plates.
enum class WalkKind : std::uint8_t {
  resting,      // one body falls onto the floor, is pushed about there, and lifted now and then
  sliding,      // one body is pushed down and along
  pile,         // three bodies lie on one another
  closing_gap,  // two bodies are driven through each other, to the same goal again and again
  far_goal,     // in each step the goal lies below one body, by 1000 times the body's size
  squeezed,     // two plates close on one body
  far_away,     // a pile that lies 2^20 times the size of a body from the origin
};
// The name of a walk is the id of its case.
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

// Returns the positions at which the limiter lets the mesh stop in a step; nothing if the limiter
// gives no answer.
using AskedLimit = std::function<std::optional<Positions>(const Case& one_step)>;

// Returns the walk as a case, which can be played again without the limiter. Each step goes from
// the positions at which the step before it stopped to a goal. Goals are rounded as the contract
// says, and a step that the contract does not take is left out of the walk. If the limiter gives no
// answer to a step, or positions that are not finite, this step is the last. The seed draws shapes,
// pushes and lifts. At the start the bodies are farther apart than the separation of the contract.
Case walk(WalkKind kind, std::uint64_t seed, int steps, const Contract& contract,
          const AskedLimit& ask);

// A campaign searches for failures (search/search.h) after its trials. The search consists of lanes
// that share nothing. Each lane runs in one thread with a worker process of its own (search.cpp).

// Searches in the lanes of this run that are not stored yet, and stores the result of each lane:
// its defects with their meshes, then the lane itself. So a run that was killed and is started
// again repeats the lanes that it had not completed, with the same results. The results depend on
// plan, seed and share, and are the same for any number of jobs. Of a lane that the deadline ends,
// only the defects are stored. `corpus` is the folder of the curated cases. `progress` is called
// from one thread at a time. Throws StoreProblem, so this function is only for campaign/.
void search_share(const CampaignRequest& request, const std::filesystem::path& corpus, Store& store,
                  RunDeadline deadline, const OnText& progress);

// The functions below shrink the cases on which a detector fails.

// Returns a judge for the reducer. The judge runs a case in the worker, asks the oracle about it,
// and returns nothing if the case holds. The arguments must outlive the judge. `jobs` is the number
// of the oracle's threads for large meshes.
Judge judge_of_detector(const DetectorUnderTest& detector, const Configuration& configuration,
                        WorkerProcess& worker, int jobs = 1);

// Shrinks one case, with the judge of judge_of_detector().
Reduction shrink_case(const Case& failing, const DetectorUnderTest& detector,
                      const Configuration& configuration, WorkerProcess& worker,
                      const ReduceLimits& limits, const OnBetter& on_better = {}, int jobs = 1);

// Shrinks one stored failure of each signature (failures of one signature break the same claim in
// the same way). Skips a signature if one of its failures was shrunk to the end before. Skips flaky
// failures. If the case of a failure does not fail in a new process, the failure becomes flaky, and
// up to two further failures of the signature are tried. If the shrinking of a failure was
// interrupted, it continues from the smallest mesh so far. Each smaller mesh is stored as soon as
// it is found. `limits` hold for each failure, the deadline for all failures together. Throws
// StoreProblem, so this function is only for campaign/.
void shrink_failures(const CampaignRequest& request, Store& store, const ReduceLimits& limits,
                     RunDeadline deadline, const OnText& progress);

// Returns the finding that the reducer preserves while it shrinks a failure.
Finding finding_of(const Failure& failure);

// Is informed about the phases of a campaign, in their order. The functions can be called from any
// thread, but only from one thread at a time.
class CampaignObserver {
 public:
  virtual ~CampaignObserver() = default;
  // Is called first, with the number of trials that the store already has.
  virtual void on_begin(std::uint64_t /*trials*/) {}
  // Is called when a phase begins: "trials", "repetitions", "search", "shrinking", "faults" or
  // "tetrahedron". The first call comes after the canary.
  virtual void on_phase(const char* /*phase*/) {}
  virtual void on_canary(const Canary&) {}
  virtual void on_trial(const TrialProgress&) {}
  virtual void on_trials(const TrialsEnd&) {}
  // Is called with the progress of the phase in words. If progress can be counted, also with the
  // numbers of items done and still to do; otherwise both numbers are 0.
  virtual void on_progress(const std::string&, std::uint64_t /*done*/, std::uint64_t /*left*/) {}
  // Is called after the phase "shrinking", before "faults" and "tetrahedron".
  virtual void on_failures_shrunk(const FailureList&) {}
};

// Runs all phases of a campaign, from the canary to the worlds of tetrahedra. Skips work whose
// results the store already has. Each phase stores its results and informs the observer; findings.h
// reads the results back, and gates.h judges them. If the request has a proof that planted faults
// are found, stores this proof and plants no faults. `corpus` is the folder of the curated cases.
//
// Trials have nine tenths of the plan's time. If trials are missing when this time is over,
// failures are shrunk in the last tenth, and no other phase begins. The canary and the worlds are
// always done again. Of two results for the same world, the store keeps the result that covers
// more. The worlds and the large meshes are not divided into shares, because they take little time.
//
// Fails if the store cannot be read or written any more. Rows that were stored before stay.
Expected<void> run_campaign(const CampaignRequest& request, const std::filesystem::path& corpus,
                            Store& store, CampaignObserver& observer);

// Returns the most seconds of wall clock for the shrinking of failures: shrink_share * seconds of
// the plan, or two minutes if the plan has no time limit.
double shrinking_seconds(const CampaignPlan& plan);

// The functions below store the failures of curated cases and scenes, like the failures of trials.

// Stores failures of the corpus, shrinks them, and returns all stored failures of the corpus. For
// each signature that is not in the store yet, stores the failure with the smallest mesh. Shrinking
// takes at most a minute for one failure, and at most shrinking_seconds() for all failures
// together. REQUIRES failures in the order of the corpus. The rows of an earlier call stay.
// `progress` is called with the signature of the failure that is being shrunk.
Expected<FailureList> shrink_corpus_failures(const CampaignRequest& request,
                                             const std::vector<FailureRecord>& failures,
                                             Store& store, const OnText& progress);

// Whether keep_corpus() stores the failures of the corpus, with their meshes.
enum class KeepMeshes : std::uint8_t { now, later };
// Stores the rows of the corpus, and removes stored failures of the corpus whose signature is not
// in `failures`. With KeepMeshes::now, for a run, also stores for each signature the failure with
// the smallest mesh, so that it is shrunk together with the failures of the trials. With
// KeepMeshes::later, for a certificate, stores no failures: shrink_corpus_failures does this.
Expected<void> keep_corpus(Store& store, const std::vector<JudgedSource>& rows,
                           const std::vector<FailureRecord>& failures, KeepMeshes when);

// Stored trials can be made and judged once more, to compare their results with the stored results.

struct TrialsAgain {
  std::uint64_t trials = 0;  // trials that were run once more
  std::uint64_t all = 0;     // trials that are stored
  // The first trial, by family and index, whose result differs: "trial ID: bvh has outcome D now,
  // but H is stored".
  std::optional<std::string> difference;
};

// Draws, by `seed`, a share (above 0, at most 1) of the trials in the stores of a folder, but at
// least one trial. Runs the drawn trials again as the request says, and compares with the stored
// values: the outcome in each configuration; the numbers of triangles, steps, collisions and pairs;
// the mesh; and the counts. Times are not compared. A trial that ended at its time limit can have
// another result on a slower machine.
//
// REQUIRES a request with the plan and the detector of the stores; each store states its own seed
// and share. Fails if a store cannot be read, if the detector cannot be run, or if no trial is
// stored. Costs O(stored trials) to draw, then the time that the drawn trials took in the first
// run.
Expected<TrialsAgain> run_again(CampaignRequest request, const std::filesystem::path& folder,
                                double share, std::uint64_t seed, const OnTrial& progress);

}  // namespace assay::properties
