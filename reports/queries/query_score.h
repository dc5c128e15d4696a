// What the answers of one method, or of a plug-in, to labelled queries come to: their score, their
// times, their rungs.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "corpus/queries/query_csv.h"
#include "properties/queries/query_methods.h"

namespace assay::reports {

// A query whose answer differs from its label, or the referee's from the oracle's.
struct Difference {
  std::string file;
  std::size_t index = 0;
  bool answer = false;
  bool label_disputed = false;  // the label is in doubt, not the method
  std::optional<double> separation;
};

class QueryScore {
 public:
  explicit QueryScore(const properties::QueryMethod& method)
      : method_(&method), name_(method.name) {}
  // The score of a plug-in. Its answers are added by add_answer.
  explicit QueryScore(std::string name) : name_(std::move(name)) {}

  // Answers and times each query of a file, one by one. REQUIRES a method that knows distance, if a
  // query has a separation.
  void add(const std::string& file, const std::vector<corpus::LabelledQuery>& queries);

  struct Answered {
    bool contact = false;       // or within the separation
    std::optional<bool> truth;  // the label, if it is that of the query that was asked
    std::optional<double> separation;
    bool label_disputed = false;
    double microseconds = 0;
    bool open = false;          // the method did not decide
    bool contradicted = false;  // by the oracle, which asks the same question
    int rung = 0;               // MethodAnswer::rung
  };
  void add_answer(const std::string& file, std::size_t index, const Answered& answered);

  // Prints to stdout: counts, differences from the truth, microseconds, rungs.
  void print() const;
  // The report, schema assay-queries/1.
  nlohmann::ordered_json to_json(const std::vector<std::string>& files) const;

  // The referee contradicts the oracle.
  bool is_unsound() const { return !contradictions_.empty(); }
  // An answer differs from its truth in a way that the method claims to avoid. A plug-in is judged
  // by its claims instead (query_detector.h).
  bool is_wrong() const {
    return method_ &&
           ((false_positives_ > 0 && method_->claims.has(properties::Claim::no_spurious)) ||
            (false_negatives_ > 0 && method_->claims.has(properties::Claim::free_sound)));
  }

 private:
  std::size_t count() const { return microseconds_.size(); }
  std::size_t disputed() const { return differences_.size() - false_positives_ - false_negatives_; }
  double mean() const;
  double quantile(double share) const;

  const properties::QueryMethod* method_ = nullptr;  // null for a plug-in
  std::string name_;
  std::vector<double> microseconds_;
  std::size_t yes_ = 0, unlabelled_ = 0, false_positives_ = 0, false_negatives_ = 0;
  std::array<std::size_t, 5> rungs_ = {};
  std::size_t open_ = 0;  // neither yes nor a difference
  // Of the queries that were asked with a separation: how many, the least and the greatest.
  std::size_t of_distance_ = 0;
  double least_ = std::numeric_limits<double>::infinity(), greatest_ = 0;
  std::vector<Difference> differences_, contradictions_;
};

}  // namespace assay::reports
