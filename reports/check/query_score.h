// The methods that answer an elementary query, as `check-queries` names them; and what the answers
// of one method to labelled queries come to: its score, its times, its rungs.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "corpus/queries/query_csv.h"

namespace assay::reports {

enum class QueryMethod : std::uint8_t {
  oracle,
  referee,
  detector_exact,
  detector_bounded,
  detector_double,
  detector_float
};
// The names of the methods on the command line and in the report, in the order of QueryMethod.
inline constexpr const char* query_method_names[] = {
    "oracle", "referee", "detector-exact", "detector-bounded", "detector-double", "detector-float"};

// The method's word, as on the command line.
const char* name_of(QueryMethod method);

struct QueryAnswer {
  bool contact = false;
  // Which of rungs_of(method) decided. Always 0 for the referee, which has none.
  int rung = 0;
  bool open = false;  // the referee did not decide
};
QueryAnswer answer_by(QueryMethod method, const corpus::LabelledQuery& query);

// The names of the method's rungs, by QueryAnswer::rung; "" for a rung that it does not have.
using RungNames = std::array<const char*, 5>;
const RungNames& rungs_of(QueryMethod method);

// Whether an answer of this kind that differs from the truth refutes the method. Bounded
// arithmetic may raise false alarms; plain doubles and floats promise nothing.
bool claims_no_false_positives(QueryMethod method);
bool claims_no_false_negatives(QueryMethod method);

// Whether the label of a query that is coplanar throughout is in doubt, because the other exact
// method gives the same answer as this one (such labels were never checked by their makers).
bool is_label_disputed(QueryMethod method, const corpus::LabelledQuery& query, bool contact);

// A query whose answer differs from its label.
struct Difference {
  std::string file;
  std::size_t index = 0;
  bool answer = false;
  bool label_disputed = false;  // is_label_disputed: the label is in doubt, not the method
};

class QueryScore {
 public:
  explicit QueryScore(QueryMethod method) : method_(method), name_(name_of(method)) {}
  // The score of a plug-in. Its answers are added by add_answer.
  explicit QueryScore(std::string name) : name_(std::move(name)) {}

  // Answers and times each query of a file, one by one.
  void add(const std::string& file, const std::vector<corpus::LabelledQuery>& queries);

  struct Answered {
    bool contact = false;
    std::optional<bool> truth;    // the label, if it is that of the query that was asked
    bool label_disputed = false;  // the oracle answers against it
    double microseconds = 0;
  };
  void add_answer(const std::string& file, std::size_t index, const Answered& answered);

  // Prints to stdout: counts, differences from the truth, microseconds, rungs.
  void print() const;
  // The report, schema assay-queries/1.
  nlohmann::ordered_json to_json(const std::vector<std::string>& files) const;

  // The referee contradicts the oracle.
  bool is_unsound() const { return !contradictions_.empty(); }
  // An answer differs from its truth in a way that the method promises to avoid. A plug-in is
  // judged by its claims instead (query_detector.h).
  bool is_wrong() const {
    return method_ && ((false_positives_ > 0 && claims_no_false_positives(*method_)) ||
                       (false_negatives_ > 0 && claims_no_false_negatives(*method_)));
  }

 private:
  void note_difference(const std::string& file, std::size_t index, bool label_disputed,
                       bool contact);
  std::size_t count() const { return microseconds_.size(); }
  std::size_t disputed() const { return differences_.size() - false_positives_ - false_negatives_; }
  double mean() const;
  double quantile(double share) const;

  std::optional<QueryMethod> method_;
  std::string name_;
  std::vector<double> microseconds_;
  std::size_t yes_ = 0, unlabelled_ = 0, false_positives_ = 0, false_negatives_ = 0;
  std::array<std::size_t, 5> rungs_ = {};
  std::size_t open_ = 0;  // left open by the referee; neither yes nor a difference
  std::vector<Difference> differences_, contradictions_;
};

}  // namespace assay::reports
