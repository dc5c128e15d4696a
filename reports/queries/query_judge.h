// Puts elementary queries to a plug-in and judges them by its claims, many at once. Nothing is
// stored.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "detector/contact/four_points.h"
#include "properties/campaign/ledger/step_measures.h"
#include "properties/campaign/trials/trial.h"
#include "properties/worker/worker_process.h"

namespace assay::reports {

// What came of one query.
struct JudgedQuery {
  bool is_within = false;   // the contract takes it; else the rest says nothing
  bool is_rounded = false;  // by the contract, so that another query is judged
  bool contact = false;     // the oracle finds a contact, at `first`
  detector::TimeEnclosure first;
  properties::CaseRun run;
  properties::Outcome outcome = properties::Outcome::undecided;
  std::optional<properties::Failure> failure;
  double microseconds = 0;  // clock time of its message over the number of queries in it
};

class QueryJudge {
 public:
  // The detector's claims are those on queries. All arguments must outlive the judge.
  QueryJudge(const properties::DetectorUnderTest& detector, properties::WorkerProcess& worker,
             properties::WorkerProcess& second)
      : detector_(detector), worker_(worker), second_(second) {}

  // Asks and judges the queries. If `deterministic` is claimed, the second worker is asked too, in
  // the other order. The results are in the order of the queries. Runs that did not take place end
  // with RunEnd::not_run.
  std::vector<JudgedQuery> judge(std::span<const detector::FourPoints> queries);

  // The measures of all queries that were judged.
  const properties::StepMeasures& measures() const { return measures_; }
  std::uint64_t crashes() const { return crashes_; }

 private:
  const properties::DetectorUnderTest& detector_;
  properties::WorkerProcess &worker_, &second_;
  properties::StepMeasures measures_;
  std::uint64_t crashes_ = 0;
};

}  // namespace assay::reports
