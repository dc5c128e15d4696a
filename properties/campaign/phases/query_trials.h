// Elementary queries through a plug-in, judged by its claims: many at once, and nothing stored.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "detector/contact/four_points.h"
#include "properties/campaign/phases/trial.h"
#include "properties/campaign/stored/step_measures.h"
#include "properties/worker/worker_process.h"

namespace assay::properties {

// What came of one query.
struct JudgedQuery {
  bool is_within = false;   // the contract takes it; else the rest says nothing
  bool is_rounded = false;  // by the contract: it is another query than was given
  bool contact = false;     // by the oracle, at `first`
  detector::TimeEnclosure first;
  CaseRun run;
  Outcome outcome = Outcome::undecided;
  std::optional<Failure> failure;
  double microseconds = 0;  // by the clock: of the message that it went in, by the queries in that
};

class QueryJudge {
 public:
  // The detector's claims are those on queries; both outlive the judge.
  QueryJudge(const DetectorUnderTest& detector, WorkerProcess& worker)
      : detector_(detector), worker_(worker) {}

  // Each in its place; twice where `deterministic` is claimed. Runs that did not take place end
  // with RunEnd::not_run.
  std::vector<JudgedQuery> judge(std::span<const detector::FourPoints> queries);

  // Of all that were judged.
  StepMeasures measures() const { return measures_in(counts_); }
  std::uint64_t crashes() const { return crashes_; }

 private:
  const DetectorUnderTest& detector_;
  WorkerProcess& worker_;
  Counts counts_;
  std::uint64_t crashes_ = 0;
};

}  // namespace assay::properties
