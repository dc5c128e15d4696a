// A log of steps (corpus/formats/step_log.h) as input of `check`: its steps as the contract of the
// detector takes them, and the answers that the detector gave when it was recorded.
#pragma once

#include "corpus/formats/step_log.h"
#include "reports/check/step_answers.h"

namespace assay::reports {

// Which steps of a log are judged.
struct LogSelection {
  double share = 1;  // in (0, 1]; which steps these are goes by their numbers alone
  std::optional<std::uint64_t> step;  // this one alone
  bool follow = false;                // waits for steps until the recorder ends the log
};

// The detector that the log is of, and what of its claims a log cannot show, each with the reason.
struct RecordedDetector {
  properties::Subject subject;
  std::vector<properties::NotJudged> not_judged;
};
Expected<RecordedDetector> recorded_detector(const corpus::StepLog& log, const std::string& file);

struct RecordedInput {
  CheckInput input;
  std::unique_ptr<StepAnswers> answers;
};

// The log must outlive what is returned. Fails if a log of this detector leaves nothing to be
// judged, or does not hold the step that is asked for.
Expected<RecordedInput> recorded_input(corpus::StepLog& log, const std::string& file,
                                       const LogSelection& selection);

// Answers to the steps of `input` from a table FILE.csv with the columns step, answer and time: the
// step counted from 1, free, collision, undecided or error, and a time of contact, which may be
// empty. Claimed is that no step with a contact is called free, and, where a time is given, that no
// contact begins before it. Rows are in any order; steps without a row are left out. Fails if the
// file is no such table, or names a step twice.
Expected<std::unique_ptr<StepAnswers>> answers_of_table(const std::string& file,
                                                        const CheckInput& input,
                                                        properties::Adjacency adjacency);

}  // namespace assay::reports
