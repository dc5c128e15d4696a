// The detector that `check` has before it: the built-in one, or a plug-in.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "detector/options.h"
#include "detector/step_result.h"
#include "properties/judging/judged_run.h"
#include "properties/worker/worker_process.h"
#include "reports/check/check_input.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/limits.h"

namespace assay::reports {

class Subject {
 public:
  virtual ~Subject() = default;

  // For the line that announces the run: "culling view-point", "plug-in NAME VERSION".
  virtual std::string title() const = 0;
  // Of the report: `culling` and `arithmetic` (null for a plug-in) and `detector`.
  virtual nlohmann::ordered_json to_json() const = 0;
  // Milliseconds of preprocessing; nothing where a plug-in does it in a process of its own.
  virtual std::optional<double> create_ms() const { return std::nullopt; }
  // Judged by its claims; otherwise it must agree with the oracle in every bit.
  virtual bool judged_by_claims() const { return true; }
  // Of a plug-in, what it claims and under which contract; null for the built-in detector.
  virtual const properties::PluginDescription* description() const { return nullptr; }
  // Steps of the input that its contract leaves out.
  virtual std::size_t steps_left_out() const { return 0; }
  // Processor time of a plug-in's process, for all steps; nothing for the built-in detector.
  virtual std::optional<double> processor_seconds() const { return std::nullopt; }

  // What a plug-in printed meanwhile, the last lines of it.
  virtual std::string printed() const { return {}; }

  // Before the first step; what the run as a whole broke, without judging any step. Not `holds`:
  // there may be no steps to ask for.
  virtual properties::JudgedRun begin() { return {}; }

  // Steps are asked for in order, each once.
  virtual detector::StepResult answer(std::size_t step, const detector::StopFunction& stop) = 0;
  // What an error of a step says; the input is to blame (`refused`) or the detector.
  struct StepError {
    std::string message;
    bool refused = false;
  };
  virtual StepError error_of(std::size_t step, const detector::StepResult& result) const = 0;

  // What the oracle is to be asked for.
  virtual oracle::AskedFeatures asked() const { return oracle::AskedFeatures::all; }
  // Whether its steps have answers: a library of candidates alone has none.
  virtual bool has_answers() const { return true; }
  virtual properties::StepDiff judge(std::size_t step, const detector::StepResult& result,
                                     const oracle::StepJudgement& judgement) const = 0;
  // The stage that lost a missing pair; empty where stages are not known.
  virtual std::string stage_that_lost(std::size_t step, detector::TrianglePair pair) const = 0;
};

// What the user says of the built-in detector; the rest is as the case states it, else the default.
struct BuiltInChoice {
  std::optional<detector::Culling> culling;
  std::optional<detector::Start> start;
  std::optional<detector::Pairs> pairs;
  std::optional<detector::Arithmetic> arithmetic;
  std::uint32_t threads = 1;  // 0: all cores
};

// `input` outlives the subject; its coordinates are rounded where the plug-in's contract says so.
// A plug-in's worker, the program `worker`, ends what takes longer or more memory than `limits`. A
// built-in detector that they end before it is made is undecided in each step.
Expected<std::unique_ptr<Subject>> make_built_in(const BuiltInChoice& choice,
                                                 const CheckInput& input, Limits& limits);
Expected<std::unique_ptr<Subject>> make_plugin_subject(const std::filesystem::path& worker,
                                                       const std::string& library,
                                                       const properties::WorkerLimits& limits,
                                                       CheckInput& input);

}  // namespace assay::reports
