// The detector that `check` runs and judges, and its answers: the built-in one, or a plug-in; and
// the mesh and the steps that they are about.
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

// The detector that `check` has before it, and its answers to the steps: those of the built-in one
// are made in this process, one by one, those of a plug-in in a worker, all at once, and those of a
// log are read (GivenAnswers).
class StepAnswers {
 public:
  virtual ~StepAnswers() = default;

  // For the line that announces the run: "culling view-point", "plug-in NAME VERSION".
  virtual std::string title() const = 0;
  // Fields of the JSON report: `culling` and `arithmetic` (null for a plug-in) and `detector`.
  virtual nlohmann::ordered_json to_json() const = 0;

  // Called before the first step. Returns what the run as a whole broke, without judging any step.
  // If it does not hold, there may be no steps to ask for.
  virtual properties::Verdict begin() { return {}; }
  // Has the detector answer step s, which is `step`, so that run() holds it. Steps are asked for in
  // order, each once.
  virtual void ask(std::size_t s, const corpus::SourceStep& step,
                   const detector::StopFunction& stop) = 0;
  // The answer, once it was asked for.
  detector::StepResult& result(std::size_t s) { return run_.steps[place_of(s)]; }
  // Why a step ended with an error.
  std::string error_of(std::size_t s) const {
    const auto place = place_of(s);
    if (const auto& problem = run_.steps[place].problem) return problem->message;
    const auto error = properties::error_of(run_, place);
    return error.empty() ? run_.explanation : error;
  }

  bool is_plugin() const { return !under_test().built_in; }
  // The answers were recorded, and nothing runs here.
  virtual bool is_recorded() const { return false; }
  // Why the step that was read last is not judged; an empty text: it was not chosen. Asked before
  // its answer, once.
  virtual std::optional<std::string> left_out() { return std::nullopt; }
  // Claims of the detector that this kind of input cannot show, and why. They are not among those
  // of under_test().
  virtual std::vector<properties::NotJudged> beyond_reach() const { return {}; }
  // Its claims are those on steps.
  const properties::DetectorUnderTest& under_test() const { return subject_.detector; }
  // The detector is judged by its claims. If false, it must agree with the oracle in every bit.
  bool judged_by_claims() const {
    return is_plugin() || !under_test().claims.has(properties::Claim::times_unique);
  }
  // Whether the steps have answers. Those of a library of candidates or limits alone have none.
  bool has_answers() const { return subject_.description.parts.steps; }
  // How many steps of the input the contract leaves out.
  std::size_t steps_left_out() const { return steps_left_out_; }
  // Milliseconds of preprocessing; nothing for a plug-in, which does it in a process of its own.
  std::optional<double> create_ms() const { return create_ms_; }
  // The run of a plug-in, over all steps; of others, over the step that was asked for last.
  const properties::CaseRun& run() const { return run_; }
  // The place of step s in it.
  std::size_t place_of(std::size_t s) const { return s - first_of_run_; }

 protected:
  explicit StepAnswers(properties::Subject subject) : subject_(std::move(subject)) {}
  // Fields of the JSON report for a detector that is judged by its claims; `of_process` is what is
  // known of the process that ran it.
  nlohmann::ordered_json detector_json(const nlohmann::ordered_json& of_process) const;
  // Begins the run of step s alone, which is undecided until it has an answer.
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

// Answers that are not asked for here, but were given before: by a log, or by a table beside the
// frames of `check`.
class GivenAnswers : public StepAnswers {
 public:
  bool is_recorded() const override { return true; }
  nlohmann::ordered_json to_json() const override { return detector_json({{"library", nullptr}}); }

 protected:
  GivenAnswers(properties::Subject subject, const corpus::StepSource& steps)
      : StepAnswers(std::move(subject)), triangles_(steps.triangles()) {}

  // Reads the answer as that of a plug-in is read, and believes none of it.
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
  // Whether it is a mesh at rest. A contract may change its steps, and not this.
  bool is_at_rest = steps->is_at_rest();
  // Those that were recorded with the steps of a log, in place of a detector; else null.
  std::unique_ptr<StepAnswers> recorded = nullptr;
};

// The options of the built-in detector that the user states. The others are those of the case, or
// else the defaults; a mesh at rest is culled by bvh then.
struct BuiltInChoice {
  std::optional<detector::Culling> culling;
  std::optional<detector::Start> start;
  std::optional<detector::Pairs> pairs;
  std::optional<detector::Arithmetic> arithmetic;
  std::uint32_t threads = 1;  // 0: all cores
};

// If `limits` end the built-in detector before it is made, each of its steps is undecided.
Expected<std::unique_ptr<StepAnswers>> answers_of_built_in(const BuiltInChoice& choice,
                                                           const CheckInput& input, Limits& limits);
// The limits of the plug-in end whatever takes longer or more memory. REQUIRES a whole case,
// because the worker is sent all of it. Then the steps of `input` are those that the plug-in's
// contract takes, with coordinates rounded if it says so.
Expected<std::unique_ptr<StepAnswers>> answers_of_plugin(properties::Subject plugin,
                                                         CheckInput& input);

// Answers to the steps of `input` from a table FILE.csv with the columns step, answer and time: the
// step counted from 1, free, collision, undecided or error, and a time of contact, which may be
// empty. Claimed is that no step with a contact is called free, and, where a time is given, that no
// contact begins before it. Rows are in any order; steps without a row are left out. Fails if the
// file is no such table, or names a step twice.
Expected<std::unique_ptr<StepAnswers>> answers_of_table(const std::string& file,
                                                        const CheckInput& input,
                                                        properties::Adjacency adjacency);

// A log of steps (corpus/formats/step_log.h), as `check` takes it: the steps as the contract of the
// detector takes them, and its recorded answers, which are judged as those of a plug-in are.

// Which steps of a log are judged.
struct LogSelection {
  double share = 1;        // in (0, 1]; which steps these are goes by their numbers alone
  std::uint64_t from = 1;  // steps before this one, from 1, are not judged
  std::optional<std::uint64_t> step;  // this one alone
  bool follow = false;                // waits for steps until the recorder ends the log
};

// A log's file, and "#N" behind it for step N alone, counted from 1.
struct LogName {
  std::string file;
  std::optional<std::uint64_t> step;  // counted from 0
};
LogName log_name(const std::string& word);

// The case that the words name: a case file, frames of one mesh, or LOG#N.
corpus::Expected<corpus::Case> read_case_of(const std::vector<std::string>& words);

// The steps that are chosen of a log, and the answers to them. Fails if it cannot be read, or if
// nothing of it can be judged.
Expected<CheckInput> read_log(const LogName& log, LogSelection selection);

}  // namespace assay::reports
