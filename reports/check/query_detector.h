// Judges the elementary query of a plug-in for `check`: many queries at once, by its claims.
// Nothing is stored.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "detector/mesh/step_types.h"
#include "properties/judging/exam.h"
#include "properties/judging/step_measures.h"
#include "reports/terminal/option_words.h"
#include "reports/terminal/work.h"

namespace assay::reports {

// The results of one query; nothing if the contract does not take it, or it was not asked.
using JudgedQuery = std::optional<properties::CaseResults>;

// The first query that broke a claim in one way.
struct QueryFailure {
  std::string signature;    // of the failure
  std::uint64_t times = 0;  // how many queries had it
  std::string query;        // "FILE query 12"
  std::string what;         // explains it
};

class QueryDetector {
 public:
  // Fails if the library cannot serve, or holds no query.
  static Expected<QueryDetector> open(const DetectorWords& words);

  // Returns the plug-in's name, claims, contract and isolation, one line each.
  std::string title() const;
  const std::string& name() const { return subject_.detector.name; }
  // Returns the separation of its contract: 0 if it is asked for contact.
  double separation() const { return subject_.detector.contract.separation; }

  // Judges some queries. REQUIRES one name for each. Fails if no worker can be started. After too
  // many crashes of the plug-in, the remaining queries count as not asked.
  Expected<std::vector<JudgedQuery>> judge(const std::vector<detector::FourPoints>& queries,
                                           const std::vector<std::string>& names);

  // Returns the results of all queries, one line each: the measures that do not depend on claims,
  // the broken claims with the queries that break them, and the verdict.
  std::string text() const;
  // Returns a JSON object with "left_out", "undecided", "not_asked", "measures", "broken".
  nlohmann::ordered_json to_json() const;
  // Returns the exit code of the verdict.
  int exit_code() const;

 private:
  explicit QueryDetector(properties::Subject subject);

  // Asks and judges some queries. If `deterministic` is claimed, the second worker is asked too, in
  // the other order. Runs that did not take place end with RunEnd::not_run.
  std::vector<JudgedQuery> judge_some(std::span<const detector::FourPoints> queries);
  // Returns whether a new process that is asked only this query gives the same answer.
  bool answers_alone(const detector::FourPoints& query, const properties::CaseRun& run) const;

  properties::Subject subject_;
  properties::WorkerProcess worker_, second_;
  properties::StepMeasures measures_;  // of all queries that were judged
  std::uint64_t crashes_ = 0;
  std::uint64_t count_ = 0, left_out_ = 0, undecided_ = 0, not_asked_ = 0, defects_ = 0;
  std::map<std::string, std::uint64_t> broken_counts_;  // how many queries broke each claim
  std::vector<QueryFailure> failures_;                  // one for each signature
};

}  // namespace assay::reports
