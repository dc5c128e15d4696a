// A log of steps (corpus/formats/step_log.h) as input of `check`: its steps as the contract of the
// detector takes them, and the answers that the detector gave when it was recorded.
#pragma once

#include "corpus/formats/step_log.h"
#include "properties/campaign/request.h"
#include "reports/check/step_answers.h"

namespace assay::reports {

// The steps that one of `count` processes judges, by their numbers.
struct Shard {
  std::uint64_t index = 1, count = 1;  // 1-based
  bool holds(std::uint64_t number) const { return number % count == index - 1; }
};

// Which steps of a log are judged.
struct LogSelection {
  double share = 1;  // in (0, 1]; which steps these are goes by their numbers alone
  Shard shard = {};
  std::uint64_t from = 0;             // steps before this one are not judged
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

}  // namespace assay::reports
