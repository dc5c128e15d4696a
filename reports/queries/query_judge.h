// Elementary queries through a plug-in, judged by its claims: many at once, and nothing stored.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "detector/contact/four_points.h"
#include "properties/campaign/stored/step_measures.h"
#include "properties/campaign/trials/trial.h"
#include "properties/worker/worker_process.h"

namespace assay::reports {

// What came of one query.
struct JudgedQuery {
  bool is_within = false;   // the contract takes it; else the rest says nothing
  bool is_rounded = false;  // by the contract: it is another query than was given
  bool contact = false;     // by the oracle, at `first`
  detector::TimeEnclosure first;
  properties::CaseRun run;
  properties::Outcome outcome = properties::Outcome::undecided;
  std::optional<properties::Failure> failure;
  double microseconds = 0;  // by the clock: of the message that it went in, by the queries in that
};

class QueryJudge {
 public:
  // The detector's claims are those on queries; both outlive the judge.
  QueryJudge(const properties::DetectorUnderTest& detector, properties::WorkerProcess& worker)
      : detector_(detector), worker_(worker) {}

  // Each in its place; twice where `deterministic` is claimed. Runs that did not take place end
  // with RunEnd::not_run.
  std::vector<JudgedQuery> judge(std::span<const detector::FourPoints> queries);

  // Of all that were judged.
  properties::StepMeasures measures() const { return properties::measures_in(counts_); }
  std::uint64_t crashes() const { return crashes_; }

 private:
  const properties::DetectorUnderTest& detector_;
  properties::WorkerProcess& worker_;
  properties::Counts counts_;
  std::uint64_t crashes_ = 0;
};

}  // namespace assay::reports
