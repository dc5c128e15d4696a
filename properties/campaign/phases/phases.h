// The phases of a campaign: planted faults, large meshes, the search, the shrinking of what a
// detector fails on, and all of them in order.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "corpus/scenes/scenes.h"
#include "detector/options.h"
#include "properties/campaign/ledger/evidence.h"
#include "properties/campaign/ledger/store.h"
#include "properties/campaign/request.h"
#include "properties/campaign/trials/trials.h"
#include "properties/claims/claims.h"
#include "properties/faults/fault.h"
#include "properties/judging/exam.h"
#include "properties/judging/verdict.h"
#include "properties/problem.h"
#include "properties/reducer/reducer.h"
#include "properties/search/search.h"
#include "properties/worker/worker_process.h"

namespace assay::properties {

// Plants every registered fault in the detector and counts the cases that the harness needs to
// find it.

struct FaultHunt {
  std::string campaign;  // ids are campaign:seed.fSEED:family:index
  std::uint64_t seed = 1;
  int seeds = 1;
  std::uint64_t cases = 0;  // for each seed at most, from all families in turn
  int jobs = 1;
  std::filesystem::path curated;  // folder of the curated cases; empty: not tried
};

// How far a hunt is, in words, and how many cases are done and left.
using OnHunt = std::function<void(const std::string&, std::uint64_t count, std::uint64_t rest)>;

// Hunts for all registered faults. One judgement of a case by the oracle serves all faults. A
// fault that is found under a seed leaves the round of that seed; equivalent and open faults stay
// to its end. The result does not depend on the number of jobs, unless the deadline ends it. About
// 0.2 ms for each case and each fault that is left.
std::vector<FaultProof> hunt_faults(const FaultHunt& hunt, RunDeadline deadline,
                                    const OnHunt& progress);

// What the fault shows in a case, judged by the claims of its options; nothing if the case holds.
// The oracle is asked where its judgement is not there yet, which then serves the next fault.
std::optional<Failure> failure_of_fault(const Fault& fault, CaseResults& results);

// A detector that is known to be wrong goes through all that the detector under test goes through.
// A run in which it is not found is a run that sees nothing.

// Runs random cases of all families in turn, 400 at most, until the planted fault shows. Throws
// StoreProblem if there is no worker.
Canary meet_canary(const CampaignRequest& request);

// Takes the proof that planted faults are found from another run of the same build. Planted faults
// prove the harness of a build, not the detector that it judges, so the run of a plug-in need not
// plant them again.

// The proof in `folder` for the request. Fails if its plan plants no faults, if the folder is `out`
// or lies below it, if the digests of program, worker or generator differ, if that run did not find
// every planted fault itself, or gave a fault fewer cases or seeds than the plan asks for, and
// where read_findings fails.
//
// REQUIRES that no code of a plug-in has run in this process's workers yet, so that whatever it
// could write to has been read before.
Expected<PowerProof> take_power(const std::filesystem::path& folder,
                                const std::filesystem::path& out, const CampaignRequest& request);

// Puts large meshes to a plug-in. The oracle judges some of their steps, and a plug-in that claims
// to be deterministic runs them again and again. This tries its claims beyond the small meshes of
// the trials, which fit into any buffer, and in which threads have little to share out.

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
// The names are the ids of walks.
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

// Where the limiter lets the mesh stop in a step; nothing if it does not say.
using AskedLimit = std::function<std::optional<detector::Positions>(const corpus::Case& one_step)>;

// The walk as a case, with a step from each place to its goal: whoever knows nothing of the limiter
// can play it again. Goals are rounded as the contract says, and a step that it does not take is
// none of the walk. If the limiter does not say where to stop, or stops where numbers cannot
// express it, that step is the last. The seed draws shapes, pushes and lifts. At the start the
// bodies are farther apart than the separation of the contract.
corpus::Case walk(WalkKind kind, std::uint64_t seed, int steps, const Contract& contract,
                  const AskedLimit& ask);

// Runs a campaign from its canary to its worlds. Each phase leaves what it finds out in the store,
// and an observer is told of it. What the campaign comes to is read back from the store
// (findings.h) and judged (gates.h).

// The search of a campaign (search/search.h): after the trials, in lanes that share nothing, each
// in a thread with a worker process of its own (search.cpp).

// Examines the cases of a lane. The exam must outlive it. Throws StoreProblem if there is no
// worker.
ExamineCases examine_in_lane(const Exam& exam);

// Searches in the lanes of this run that are not stored yet, and stores what each comes to: its
// defects with their meshes, then the lane itself. So a run that is killed does again what was cut,
// and finds the same. What is found depends on plan, seed and share alone, not on the number of
// jobs; a lane that the deadline ends is not stored. `corpus` is the folder of the curated cases.
// `progress` is called from one thread at a time. Throws StoreProblem; so it is for campaign/
// alone.
void search_share(const CampaignRequest& request, const std::filesystem::path& corpus, Store& store,
                  RunDeadline deadline, const std::function<void(const std::string&)>& progress);

// Shrinks what a detector fails on.

// A judge that runs a case in the worker and asks the oracle; the judge returns nothing if the case
// holds. The arguments must outlive it. `jobs` are threads of the oracle for large meshes.
Judge judge_of_detector(const DetectorUnderTest& detector, const Configuration& configuration,
                        WorkerProcess& worker, int jobs = 1);

// Shrinks one case, by that judge.
Reduction shrink_case(const corpus::Case& failing, const DetectorUnderTest& detector,
                      const Configuration& configuration, WorkerProcess& worker,
                      const ReduceLimits& limits, const OnBetter& on_better = {}, int jobs = 1);

// Shrinks the first stored failure of each signature (failures of one signature break the same
// claim in the same way). One that has been shrunk before is left alone, and so is one that the
// store calls flaky. Flaky is also what its own case does not show in a new process; then the next
// two of the signature are tried. One whose shrinking was interrupted goes on from its smallest
// mesh so far. Each better mesh is stored as soon as it is found. `limits` hold for each failure,
// the deadline for all. Throws StoreProblem, which only campaign/ catches.
void shrink_failures(const CampaignRequest& request, Store& store, const ReduceLimits& limits,
                     RunDeadline deadline, const std::function<void(const std::string&)>& progress);

// Makes the detector's own choice of a view primitive part of the case.

// The same case with the primitive of its first component stated. Nothing if the culling has no
// views, if the case states a primitive already, or if the mesh is refused.
std::optional<corpus::Case> with_explicit_view(const corpus::Case& c,
                                               const detector::Options& options);

// The finding for which the reducer keeps a failure.
Finding finding_of(const Failure& failure);

// Is told what a campaign does, in the order of its phases. Each function may be called from
// another thread than the caller's, but by one thread at a time.
class CampaignObserver {
 public:
  virtual ~CampaignObserver() = default;
  // Called first: so many trials are in the store already.
  virtual void on_begin(std::uint64_t /*trials*/) {}
  // A phase begins now: "trials", "repetitions", "search", "shrinking", "faults" or
  // "tetrahedron". The first of these is told after the canary.
  virtual void on_phase(const char* /*phase*/) {}
  virtual void on_canary(const Canary&) {}
  virtual void on_trial(const TrialProgress&) {}
  virtual void on_trials(const TrialsEnd&) {}
  // What the phase is at; and, if it can be counted, how much of it is done, and how much is left.
  virtual void on_progress(const std::string&, std::uint64_t /*done*/, std::uint64_t /*left*/) {}
  // All trials and their failures are stored now; faults and worlds are still to come.
  virtual void on_failures_shrunk(const FailureList&) {}
};

// Does what the store does not hold yet: the trials, the shrinking of what failed, and the planted
// faults (or it takes the request's proof of them). Trials have nine tenths of the plan's time; if
// some are missing then, failures are shrunk in the last tenth and nothing else is begun. The
// canary and the worlds of tetrahedra are done again; of two results for a world the one that came
// farther stays. Of a share, worlds and large meshes are done as of a whole campaign, because they
// take little time. `corpus` is the folder of the curated cases.
//
// What is stored stays, whatever happens. Fails if the store cannot be read or written any more.
Expected<void> run_campaign(const CampaignRequest& request, const std::filesystem::path& corpus,
                            Store& store, CampaignObserver& observer);

// The seconds of the clock that the shrinking of failures may take: the plan's share of its own
// limit, or two minutes if it has no limit.
double shrinking_seconds(const CampaignPlan& plan);

// Keeps what curated cases and scenes show wrong: each with a small mesh that shows it, as for the
// trials that fail.

// Takes the failures whose signature nothing in the store has, and stores the smallest mesh of each
// such signature. Then it shrinks these meshes. That takes at most a minute for each, and for all
// together the share of the plan's time that is kept for shrinking. REQUIRES failures in the order
// of the corpus. What an earlier call stored stays. `progress` is called with the signature that is
// being shrunk.
// Returns the stored failures of the corpus.
Expected<FailureList> shrink_corpus_failures(
    const CampaignRequest& request, const std::vector<FailureRecord>& failures, Store& store,
    const std::function<void(const std::string&)>& progress);

// Stores the rows of the corpus, and removes the failures of an earlier call that it does not show
// any more. In a run the smallest mesh of each signature is stored now, and shrunk with the
// failures of the trials; in a certificate shrink_corpus_failures does that later.
enum class KeepMeshes : std::uint8_t { now, later };
Expected<void> keep_corpus(Store& store, const std::vector<JudgedSource>& rows,
                           const std::vector<FailureRecord>& failures, KeepMeshes when);

// Makes and judges stored trials once more, and compares the results with what is stored.

struct TrialsAgain {
  std::uint64_t trials = 0;  // trials that were run once more
  std::uint64_t all = 0;     // trials that are stored
  // The first trial, by family and index, that came to something else: "trial ID: bvh is D now, H
  // is stored".
  std::optional<std::string> difference;
};

// Draws a share (above 0, at most 1) of the trials that the stores of a folder hold, at least one,
// by the seed. Makes and judges them as the request says, and compares the outcomes in every
// configuration, triangles, steps, collisions, pairs, counts and mesh. Times may differ, so a
// trial that ended at its limit of time may come to something else on a slower machine.
//
// REQUIRES a request with the plan and the detector of the stores; each states its own seed and
// share. Fails if a store cannot be read, if the detector cannot be run, and if no trial is stored.
// O(trials stored) to draw them, then the time that the trials took when they were first run.
Expected<TrialsAgain> run_again(CampaignRequest request, const std::filesystem::path& folder,
                                double share, std::uint64_t seed,
                                const std::function<void(const TrialProgress&)>& progress);

}  // namespace assay::properties
