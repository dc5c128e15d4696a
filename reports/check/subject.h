// The detector that `check` runs and judges: the built-in one, or a plug-in.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
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

  // Called before the first step. Returns what the run as a whole broke, without judging any step.
  // If it does not hold, there may be no steps to ask for.
  virtual properties::JudgedRun begin() { return {}; }
  // The detector's answer to step s, which is `step`. Steps are asked for in order, each once.
  virtual detector::StepResult answer(std::size_t s, const corpus::SourceStep& step,
                                      const detector::StopFunction& stop) = 0;
  // Why a step ended with an error.
  virtual std::string error_of(std::size_t s, const detector::StepResult& result) const = 0;

  // The detector is judged by its claims. If false, it must agree with the oracle in every bit.
  bool judged_by_claims() const { return plugin_ || !claims_.has(properties::Claim::times_unique); }
  // What a plug-in claims and under which contract; null for the built-in detector.
  const properties::PluginDescription* description() const { return plugin_ ? &*plugin_ : nullptr; }
  const properties::Contract& contract() const { return contract_; }
  // Whether the steps have answers. Those of a library of candidates alone have none.
  bool has_answers() const { return !plugin_ || plugin_->parts.steps; }
  // How many steps of the input the contract leaves out.
  std::size_t steps_left_out() const { return steps_left_out_; }
  // Milliseconds of preprocessing; nothing for a plug-in, which does it in a process of its own.
  std::optional<double> create_ms() const { return create_ms_; }
  // The run of a plug-in, over all steps; of the built-in detector it is empty.
  const properties::CaseRun& run() const { return run_; }

  properties::StepDiff judge(std::size_t s, const detector::StepResult& result,
                             const oracle::StepJudgement& judgement,
                             const detector::TrianglesView& triangles) const {
    return s < run_.steps.size() ? compare_step(run_, s, judgement, claims_, contract_, triangles)
                                 : compare(result, judgement, claims_, contract_, triangles);
  }

 protected:
  static detector::StepResult undecided() {
    detector::StepResult result;
    result.answer = detector::Answer::undecided;
    return result;
  }

  properties::Claims claims_;  // on steps
  properties::Contract contract_;
  std::optional<properties::PluginDescription> plugin_;
  std::size_t steps_left_out_ = 0;
  std::optional<double> create_ms_;
  properties::CaseRun run_;
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

// If `limits` end the built-in detector before it is made, each of its steps is undecided.
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
