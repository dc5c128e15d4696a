// A case as it is shown: its steps with what oracle and detector found in them, and view sets.
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
  std::optional<detector::StepResult> answered;  // by the detector; nothing where its run broke off
  // Signs, doubts, primitives and apexes; nothing where no detector with views took the mesh.
  std::optional<detector::StepResult> seen;
  properties::CandidatePairs candidates = {};  // of a plug-in that gives some
};

struct CaseScene {
  corpus::Case c;  // as the detector's contract has it
  std::vector<SceneStep> steps;
  std::optional<detector::Surface> surface;  // the mesh and its ghosts; nothing when refused
  // Whose view sets are shown: empty for the detector's own, else in words.
  std::string views_by;
  bool reports_pairs = true;                   // false: of pairs it says nothing
  std::string ended;                           // how the detector's run broke off, or empty
  std::optional<properties::Failure> failure;  // what is wrong, where it still is

  // The pair and step that the picture is about: those of the failure, else of the first contact.
  std::size_t shown_step() const;
  std::optional<detector::TrianglePair> shown_pair() const;
};

// Who is asked: the detector's worker (null: it is not at hand), and the built-in detector's, for
// view sets alone, where the other shows none.
struct SceneWorkers {
  properties::WorkerProcess* detector = nullptr;
  properties::WorkerProcess* reference = nullptr;
};

// Nothing when the contract cannot hold a coordinate. Costs an exact judgement: meant for shrunk
// cases.
std::optional<CaseScene> make_scene(const corpus::Case& c,
                                    const properties::DetectorUnderTest& detector,
                                    const properties::Configuration& configuration,
                                    const SceneWorkers& workers);

// The pair among the contacts, or null.
const detector::PairContact* contact_of(const std::vector<detector::PairContact>& contacts,
                                        const std::optional<detector::TrianglePair>& pair);

}  // namespace assay::reports
