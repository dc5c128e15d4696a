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

struct SceneStep {
  corpus::CaseStep span;
  oracle::StepJudgement truth;
  std::optional<detector::StepResult> answered;  // by the detector; nothing if its run broke off
  // The result whose signs, doubts, primitives and apexes are shown; nothing if no detector with
  // views took the mesh.
  std::optional<detector::StepResult> seen;
  properties::CandidatePairs candidates = {};  // only of a plug-in that gives some
};

struct CaseScene {
  corpus::Case c;  // as the detector's contract has it
  std::vector<SceneStep> steps;
  std::optional<detector::Surface> surface;  // the mesh and its ghosts; nothing if it was refused
  // Whose view sets are shown, in words; empty: the detector's own.
  std::string views_by;
  bool reports_pairs = true;                   // false: the detector says nothing of pairs
  std::string ended;                           // how the detector's run broke off; else empty
  std::optional<properties::Failure> failure;  // what is wrong, if the case still fails

  // The step and the pair that the picture is about: those of the failure, else of the first
  // contact.
  std::size_t shown_step() const;
  std::optional<detector::TrianglePair> shown_pair() const;
};

// The workers that are asked: that of the detector (null: it is not at hand), and that of the
// built-in detector, which gives the view sets if the other one shows none.
struct SceneWorkers {
  properties::WorkerProcess* detector = nullptr;
  properties::WorkerProcess* reference = nullptr;
};

// Nothing if the contract cannot represent a coordinate. The case is judged exactly, which is
// dear: meant for shrunk cases.
std::optional<CaseScene> make_scene(const corpus::Case& c,
                                    const properties::DetectorUnderTest& detector,
                                    const properties::Configuration& configuration,
                                    const SceneWorkers& workers);

// The contact of this pair, or null.
const detector::PairContact* contact_of(const std::vector<detector::PairContact>& contacts,
                                        const std::optional<detector::TrianglePair>& pair);

}  // namespace assay::reports
