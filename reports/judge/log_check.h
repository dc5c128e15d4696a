// A log of steps (corpus/formats/step_log.h), as `check` takes it: the steps as the contract of the
// detector takes them, and its recorded answers, which are judged as those of a plug-in are.
#pragma once

#include <string>

#include "corpus/formats/step_log.h"
#include "reports/check/check_run.h"

namespace assay::reports {

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

// What each claim of a log came to, as a suite of JUnit XML. A claim that is broken fails, and one
// of which the log tells nothing, or not enough, is skipped.
std::string junit_suite(const std::string& log, const CheckOutcome& outcome);
// The suite of a log that could not be judged.
std::string junit_suite_of_problem(const std::string& log, const std::string& message);

}  // namespace assay::reports
