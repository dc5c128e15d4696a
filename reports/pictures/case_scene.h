// A case as it is shown: its steps, what the oracle and the detector found in them, and view sets.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "detector/mesh/surface.h"
#include "detector/step_result.h"
#include "oracle/mesh/step.h"
#include "properties/campaign/trials/trial.h"
#include "properties/worker/worker_process.h"

namespace assay::reports {

struct CaseScene;

struct SceneStep {
  corpus::CaseStep span;
  properties::StepTruth truth;                   // under the detector's contract
  std::optional<detector::StepResult> answered;  // by the detector; nothing if its run broke off
  // How the two differ; nothing if the detector did not run.
  std::optional<properties::StepDiff> diff;
  properties::CandidatePairs candidates = {};  // only of a plug-in that gives some

  // Whether `answered` has view sets to be shown.
  bool has_views() const { return answered && !answered->doubts.empty(); }
  // What the claims and the contract make of a pair that is in contact or reported, in words:
  // "missing", "late", "early", "spurious", "no candidate" and "answered free" break a claim; "not
  // claimed", alone or behind what differs, "left out by the contract", "agrees" and "not run" do
  // not.
  std::string difference(const detector::TrianglePair& pair, const CaseScene& scene) const;
};

struct CaseScene {
  corpus::Case c;  // as the detector's contract has it
  std::vector<SceneStep> steps;
  std::optional<detector::Surface> surface;    // the mesh and its ghosts; nothing if it was refused
  properties::Claims claims;                   // that are judged under the contract
  double time_tolerance = 0;                   // the contract's
  bool reports_pairs = true;                   // false: the detector says nothing of pairs
  std::string ended;                           // how the detector's run broke off; else empty
  std::optional<properties::Failure> failure;  // what is wrong, if the case still fails

  // The step and the pair that the picture is about: those of the failure, else of the first
  // contact.
  std::size_t shown_step() const;
  std::optional<detector::TrianglePair> shown_pair() const;
};

// `worker` runs the detector; null: it is not at hand. Nothing if the contract cannot represent a
// coordinate. The case is judged exactly, which is dear: meant for shrunk cases.
std::optional<CaseScene> make_scene(const corpus::Case& c,
                                    const properties::DetectorUnderTest& detector,
                                    const properties::Configuration& configuration,
                                    properties::WorkerProcess* worker);

// The contact of this pair, or null.
const detector::PairContact* contact_of(const std::vector<detector::PairContact>& contacts,
                                        const std::optional<detector::TrianglePair>& pair);

}  // namespace assay::reports
