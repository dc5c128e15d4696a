// The detector that `check` runs and judges: the built-in one, or a plug-in.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "corpus/formats/step_source.h"
#include "detector/options.h"
#include "detector/step_result.h"
#include "properties/judging/judged_run.h"
#include "properties/worker/worker_process.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/limits.h"

namespace assay::reports {

// The mesh and the steps that `check` is given.
struct CheckInput {
  std::string file;  // the first file
  std::unique_ptr<corpus::StepSource> steps;
};

class Subject {
 public:
  virtual ~Subject() = default;

  // For the line that announces the run: "culling view-point", "plug-in NAME VERSION".
  virtual std::string title() const = 0;
  // Fields of the JSON report: `culling` and `arithmetic` (null for a plug-in) and `detector`.
  virtual nlohmann::ordered_json to_json() const = 0;
  // Milliseconds of preprocessing; nothing for a plug-in, which does it in a process of its own.
  virtual std::optional<double> create_ms() const { return std::nullopt; }
  // The detector is judged by its claims. If false, it must agree with the oracle in every bit.
  virtual bool judged_by_claims() const { return true; }
  // What a plug-in claims and under which contract; null for the built-in detector.
  virtual const properties::PluginDescription* description() const { return nullptr; }
  // How many steps of the input its contract leaves out.
  virtual std::size_t steps_left_out() const { return 0; }
  // Processor time of a plug-in's process, over all steps; nothing for the built-in detector.
  virtual std::optional<double> processor_seconds() const { return std::nullopt; }

  // The last lines that a plug-in printed.
  virtual std::string printed() const { return {}; }

  // Called before the first step. Returns what the run as a whole broke, without judging any step.
  // If it does not hold, there may be no steps to ask for.
  virtual properties::JudgedRun begin() { return {}; }

  // The detector's answer to step s, which is `step`. Steps are asked for in order, each once.
  virtual detector::StepResult answer(std::size_t s, const corpus::SourceStep& step,
                                      const detector::StopFunction& stop) = 0;
  // Why a step ended with an error. `refused` is set if the input is to blame, and not the
  // detector.
  struct StepError {
    std::string message;
    bool refused = false;
  };
  virtual StepError error_of(std::size_t s, const detector::StepResult& result) const = 0;

  // The features that the oracle is to be asked for.
  virtual oracle::AskedFeatures asked() const { return oracle::AskedFeatures::all; }
  // Whether the steps have answers. Those of a library of candidates alone have none.
  virtual bool has_answers() const { return true; }
  virtual properties::StepDiff judge(std::size_t s, const detector::StepResult& result,
                                     const oracle::StepJudgement& judgement) const = 0;
  // The stage of the detector that lost a missing pair of a step; empty if its stages are not
  // known.
  virtual std::string stage_that_lost(const corpus::SourceStep& step,
                                      detector::TrianglePair pair) const = 0;
};

// The options of the built-in detector that the user states. The others are those of the case, or
// else the defaults.
struct BuiltInChoice {
  std::optional<detector::Culling> culling;
  std::optional<detector::Start> start;
  std::optional<detector::Pairs> pairs;
  std::optional<detector::Arithmetic> arithmetic;
  std::uint32_t threads = 1;  // 0: all cores
};

// If `limits` end the built-in detector before it is made, each of its steps is undecided. `input`
// must outlive the subject.
Expected<std::unique_ptr<Subject>> make_built_in(const BuiltInChoice& choice,
                                                 const CheckInput& input, Limits& limits);
// The program `worker` runs the plug-in and ends whatever takes longer or more memory than
// `limits`. REQUIRES a whole case, because the worker is sent all of it. Then the steps of `input`
// are those that the plug-in's contract takes, with coordinates rounded if it says so.
Expected<std::unique_ptr<Subject>> make_plugin_subject(const std::filesystem::path& worker,
                                                       const std::string& library,
                                                       const properties::WorkerLimits& limits,
                                                       CheckInput& input);

}  // namespace assay::reports
