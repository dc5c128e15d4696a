// The elementary query of a plug-in as `check-queries` and `self-test` judge it.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "properties/campaign/request.h"
#include "reports/queries/query_judge.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/option_words.h"

namespace assay::reports {

// A query that broke a claim.
struct BrokenQuery {
  std::string name;       // "FILE query 12", "ulp:1:7"
  std::string signature;  // of the failure
  std::string what;
};

class QueryDetector {
 public:
  // Refused where the library cannot serve, or holds no query.
  static Expected<QueryDetector> open(const DetectorWords& words);

  // Its name, claims, contract and isolation, a line each.
  std::string title() const;
  const properties::CampaignRequest& request() const { return *request_; }

  // Judges some; names: one for each. Refused where no worker can be started. The queries that are
  // left out because it crashed too often before are not within.
  Expected<std::vector<JudgedQuery>> judge(const std::vector<detector::FourPoints>& queries,
                                           const std::vector<std::string>& names);

  // What all came to, a line each: what it does whatever it claims, the claims that are broken and
  // by which queries, and the verdict.
  std::string text() const;
  // "left_out", "undecided", "not_asked", "measures", "broken".
  nlohmann::ordered_json to_json() const;
  // Of the verdict.
  int exit_code() const;

 private:
  explicit QueryDetector(std::unique_ptr<properties::CampaignRequest> request);

  // On the heap: the judge holds on to them when this is moved.
  std::unique_ptr<properties::CampaignRequest> request_;
  std::unique_ptr<properties::WorkerProcess> worker_;
  std::unique_ptr<QueryJudge> judge_;
  std::uint64_t judged_ = 0, left_out_ = 0, undecided_ = 0, not_asked_ = 0, defects_ = 0;
  std::map<std::string, std::uint64_t> broken_;  // queries, by claim
  std::vector<BrokenQuery> shown_;               // the first of each signature
  std::map<std::string, std::uint64_t> met_;     // queries, by signature
};

}  // namespace assay::reports
