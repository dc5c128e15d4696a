// The detector that `check` runs and judges, the built-in one or a plug-in; its answers; and the
// mesh and the steps that the answers are about.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "corpus/formats/step_log.h"
#include "corpus/formats/step_source.h"
#include "detector/options.h"
#include "detector/step_result.h"
#include "properties/campaign/gates/gates.h"
#include "properties/judging/exam.h"
#include "properties/judging/subject.h"
#include "reports/terminal/work.h"

namespace assay::reports {

// The detector that `check` judges, and its answers to the steps. The built-in detector answers in
// this process, step by step. A plug-in answers in a worker, all steps at once. The answers of a
// log are read (GivenAnswers).
class StepAnswers {
 public:
  virtual ~StepAnswers() = default;

  // Returns the title for the line that announces the run: "culling view-point", "plug-in NAME
  // VERSION".
  virtual std::string title() const = 0;
  // Returns fields of the JSON report: `culling` and `arithmetic` (null for a plug-in) and
  // `detector`.
  virtual nlohmann::ordered_json to_json() const = 0;

  // Is called before the first step. Returns the verdict on the run as a whole, without judging any
  // step. If the verdict is not `holds`, there may be no steps to ask for.
  virtual properties::Verdict begin() { return {}; }
  // Makes the detector answer step s, which is `step`; run() then holds the answer. Steps are asked
  // for in order, each once.
  virtual void ask(std::size_t s, const corpus::SourceStep& step,
                   const detector::StopFunction& stop) = 0;
  // Returns the answer to step s. REQUIRES that ask() was called for this step.
  detector::StepResult& result(std::size_t s) { return run_.steps[place_of(s)]; }
  // Returns why a step ended with an error.
  std::string error_of(std::size_t s) const {
    const auto place = place_of(s);
    if (const auto& problem = run_.steps[place].problem) return problem->message;
    const auto error = properties::error_of(run_, place);
    return error.empty() ? run_.explanation : error;
  }

  bool is_plugin() const { return !under_test().built_in; }
  // Returns whether the answers were recorded, so that no detector runs here.
  virtual bool is_recorded() const { return false; }
  // Returns why the step that was read last is not judged, nullopt if it is judged, and an empty
  // text if it was not chosen. Is called once, before the step's answer is asked for.
  virtual std::optional<std::string> left_out() { return std::nullopt; }
  // Returns claims of the detector that this kind of input cannot show, and why. under_test() does
  // not list these claims.
  virtual std::vector<properties::NotJudged> beyond_reach() const { return {}; }
  // Returns the detector. Its claims are only the claims about steps.
  const properties::DetectorUnderTest& under_test() const { return subject_.detector; }
  // Returns whether the detector is judged by its claims. If not, it must agree with the oracle in
  // every bit.
  bool judged_by_claims() const {
    return is_plugin() || !under_test().claims.has(properties::Claim::times_unique);
  }
  // Returns whether the steps have answers. A library that gives only candidates or limits has no
  // answers.
  bool has_answers() const { return subject_.description.parts.steps; }
  // Returns how many steps of the input the contract leaves out.
  std::size_t steps_left_out() const { return steps_left_out_; }
  // Returns the milliseconds of preprocessing; nullopt for a plug-in, which is prepared in a
  // process of its own.
  std::optional<double> create_ms() const { return create_ms_; }
  // Returns the run of the detector: for a plug-in over all steps, for other detectors over the
  // last step that was asked for.
  const properties::CaseRun& run() const { return run_; }
  // Returns the place of step s in run().
  std::size_t place_of(std::size_t s) const { return s - first_of_run_; }

 protected:
  explicit StepAnswers(properties::Subject subject) : subject_(std::move(subject)) {}
  // Returns fields of the JSON report for a detector that is judged by its claims; `of_process` are
  // facts about the process that ran it.
  nlohmann::ordered_json detector_json(const nlohmann::ordered_json& of_process) const;
  // Begins a run that has only step s. The step is undecided until it has an answer.
  void begin_run(std::size_t s) {
    first_of_run_ = s;
    run_ = {};
    run_.has_answers = has_answers();
    run_.steps = {undecided()};
  }
  static detector::StepResult undecided() {
    detector::StepResult result;
    result.answer = detector::Answer::undecided;
    return result;
  }

  properties::Subject subject_;
  std::size_t steps_left_out_ = 0;
  std::optional<double> create_ms_;
  properties::CaseRun run_;
  std::size_t first_of_run_ = 0;  // the step that run_ begins with
};

// Answers that were given before, in a log or in a table beside the frames of `check`.
class GivenAnswers : public StepAnswers {
 public:
  bool is_recorded() const override { return true; }
  nlohmann::ordered_json to_json() const override { return detector_json({{"library", nullptr}}); }

 protected:
  GivenAnswers(properties::Subject subject, const corpus::StepSource& steps)
      : StepAnswers(std::move(subject)), triangles_(steps.triangles()) {}

  // Checks the answer as if a plug-in had given it, and stores it as the answer of the step.
  void take(const std::optional<corpus::LoggedAnswer>& logged);
  void take_error(const std::string& text);

 private:
  Expected<detector::StepResult> result_of(const corpus::LoggedAnswer& logged) const;

  const detector::Triangles& triangles_;
};

// The mesh and the steps that `check` is given.
struct CheckInput {
  std::string file;  // the first file
  std::unique_ptr<corpus::StepSource> steps;
  // Whether the mesh is at rest. A contract may change the steps, but not this.
  bool is_at_rest = steps->is_at_rest();
  // The answers recorded with the steps of a log, in place of a detector; else null.
  std::unique_ptr<StepAnswers> recorded = nullptr;
};

// The options of the built-in detector that the user states. Options that the user does not state
// come from the case, or else are the defaults; the default culling for a mesh at rest is
// Culling::bvh.
struct BuiltInChoice {
  std::optional<detector::Culling> culling;
  std::optional<detector::Start> start;
  std::optional<detector::Pairs> pairs;
  std::optional<detector::Arithmetic> arithmetic;
  std::uint32_t threads = 1;  // 0: all cores
};

// Makes the built-in detector. If a limit is reached while it is made, each step is undecided.
Expected<std::unique_ptr<StepAnswers>> answers_of_built_in(const BuiltInChoice& choice,
                                                           const CheckInput& input, Limits& limits);
// Runs a plug-in under its own limits of time and memory. The steps of `input` become the steps
// that the plug-in's contract takes, with coordinates rounded if the contract says so. REQUIRES a
// whole case, because the worker gets all of it at once.
Expected<std::unique_ptr<StepAnswers>> answers_of_plugin(properties::Subject plugin,
                                                         CheckInput& input);

// Reads answers to the steps of `input` from a table FILE.csv with the columns step (from 1),
// answer (free, collision, undecided or error) and time (of contact; may be empty). The table is
// judged by two claims: no step with a contact is called free, and no contact begins before a given
// time. Rows are in any order; steps without a row are left out. Fails if the file has no such
// columns, or names a step twice.
Expected<std::unique_ptr<StepAnswers>> answers_of_table(const std::string& file,
                                                        const CheckInput& input,
                                                        properties::Adjacency adjacency);

// Reads a log of steps (corpus/formats/step_log.h) for `check`: the steps as fitted to the contract
// of the detector, and its recorded answers, which are judged like those of a plug-in.

// Which steps of a log are judged.
struct LogSelection {
  double share = 1;                   // in (0, 1]; which steps it is depends only on their numbers
  std::uint64_t from = 1;             // steps before this one, from 1, are not judged
  std::optional<std::uint64_t> step;  // only this step is judged; counted from 0
  bool follow = false;                // wait for steps until the recorder ends the log
};

// A log's file, followed by "#N" if only step N, counted from 1, is meant.
struct LogName {
  std::string file;
  std::optional<std::uint64_t> step;  // counted from 0
};
LogName log_name(const std::string& word);

// Reads the case that the words name: a case file, frames of one mesh, or LOG#N.
corpus::Expected<corpus::Case> read_case_of(const std::vector<std::string>& words);

// Reads the selected steps of a log, and their answers. Fails if the log cannot be read, or if no
// step can be judged.
Expected<CheckInput> read_log(const LogName& log, LogSelection selection);

}  // namespace assay::reports
