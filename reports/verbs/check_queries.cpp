// `assay check` of query files asks one method labelled vertex-face and edge-edge queries, scores
// the answers against their truth, and times them one by one. The query of a plug-in may answer
// instead; then its claims are judged too.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "corpus/queries/query_csv.h"
#include "detector/contact/contact_exact.h"
#include "properties/queries/query_methods.h"
#include "reports/check/query_detector.h"
#include "reports/estimate.h"
#include "reports/terminal/text_file.h"
#include "reports/terminal/words.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

// A query whose answer differs from its label, or the referee's from the oracle's.
struct Difference {
  std::string file;
  std::size_t index = 0;
  bool answer = false;
  bool label_disputed = false;  // the label is in doubt, not the method
  std::optional<double> separation;
};

using detector::Decision;

properties::MethodAnswer ask(const properties::QueryMethod& method,
                             const corpus::LabelledQuery& asked) {
  return asked.separation ? method.within(asked.query, *asked.separation)
                          : method.answer(asked.query);
}

// " within 0.1", or nothing of a query of contact.
std::string within_text(const std::optional<double>& separation) {
  return separation ? fmt::format(" within {}", *separation) : "";
}

// Whether the label of a query that is coplanar throughout is in doubt, because another exact
// method gives the same answer as this one (such labels were never checked by their makers).
bool is_label_disputed(const properties::QueryMethod& method, const properties::Query& query,
                       Decision answer) {
  const auto& oracle = properties::oracle_method();
  const auto& other = &method == &oracle ? properties::detector_method() : oracle;
  return detector::coplanar_throughout(query) && other.answer(query).decision == answer;
}

class QueryScore {
 public:
  explicit QueryScore(const properties::QueryMethod& method)
      : method_(&method), name_(method.name) {}
  // The score of a plug-in. Its answers are added by add_answer.
  explicit QueryScore(std::string name) : name_(std::move(name)) {}

  // Answers and times each query of a file, one by one. REQUIRES a method that knows distance, if a
  // query has a separation.
  void add(const std::string& file, const std::vector<corpus::LabelledQuery>& queries) {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const auto& [query, truth, separation] = queries[i];
      const auto begin = std::chrono::steady_clock::now();
      const auto [decision, first, rung] = ask(*method_, queries[i]);
      const std::chrono::duration<double, std::micro> took =
          std::chrono::steady_clock::now() - begin;
      Answered answered{decision == Decision::yes, truth, separation, false, took.count()};
      answered.open = decision == Decision::open;
      answered.rung = rung;
      if (!answered.open) {
        answered.contradicted = method_->is_referee &&
                                ask(properties::oracle_method(), queries[i]).decision != decision;
        answered.label_disputed = truth && *truth != answered.contact && !separation &&
                                  is_label_disputed(*method_, query, decision);
      }
      add_answer(file, i, answered);
    }
  }

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
  void add_answer(const std::string& file, std::size_t index, const Answered& answered) {
    microseconds_.push_back(answered.microseconds);
    unlabelled_ += answered.truth ? 0 : 1;
    open_ += answered.open ? 1 : 0;
    if (const auto& d = answered.separation) {
      ++of_distance_;
      least_ = std::min(least_, *d);
      greatest_ = std::max(greatest_, *d);
    }
    if (answered.open) return;
    const bool contact = answered.contact;
    yes_ += contact ? 1 : 0;
    if (answered.contradicted)
      contradictions_.push_back({file, index, contact, false, answered.separation});
    ++rungs_[static_cast<std::size_t>(answered.rung)];
    if (!answered.truth || *answered.truth == contact) return;
    differences_.push_back({file, index, contact, answered.label_disputed, answered.separation});
    if (!answered.label_disputed) ++(contact ? false_positives_ : false_negatives_);
  }

  // Prints to stdout: counts, differences from the truth, microseconds, rungs.
  void print() const {
    constexpr std::size_t most_listed = 50;
    std::string of_distance;
    if (of_distance_ > 0)
      of_distance = fmt::format(" ({}{}{})", of_distance_, within_text(least_),
                                least_ < greatest_ ? fmt::format(" to {}", greatest_) : "");
    fmt::print("{}: {} queries{}, {} yes, {} without a label{}\n", name_, count(), of_distance,
               yes_, unlabelled_,
               method_ && method_->is_referee
                   ? fmt::format(", {} open, {} contradictions", open_, contradictions_.size())
                   : "");
    for (const auto& d : contradictions_) {
      fmt::print("  CONTRADICTION: {} query {}{}: referee {}, oracle {}\n", d.file, d.index,
                 within_text(d.separation), d.answer, !d.answer);
    }
    fmt::print(
        "differences from the truth: {} false positives, {} false negatives, {} disputed labels\n",
        false_positives_, false_negatives_, disputed());
    std::size_t listed = 0;
    for (const auto& d : differences_) {
      if (listed++ == most_listed) {
        fmt::print("  ... {} more\n", differences_.size() - most_listed);
        break;
      }
      fmt::print("  {} query {}{}: answer {}, label {}{}\n", d.file, d.index,
                 within_text(d.separation), d.answer, !d.answer,
                 !d.label_disputed ? ""
                 : method_ ? "; coplanar throughout, both exact methods agree against the label"
                           : "; the oracle agrees against the label");
    }
    fmt::print("us a query: mean {:.2f}, median {:.2f}, p99 {:.2f}, p99.9 {:.2f}, max {:.2f}\n",
               mean(), quantile(0.5), quantile(0.99), quantile(0.999), quantile(1));
    if (!method_ || !*method_->rungs[0]) return;
    const auto& rungs = method_->rungs;
    std::string text;
    for (std::size_t r = 0; r < rungs.size(); ++r) {
      if (!*rungs[r]) continue;
      text += fmt::format(
          "{}{} {:.1f} %", r == 0 ? "rungs: " : ", ", rungs[r],
          count() ? 100.0 * static_cast<double>(rungs_[r]) / static_cast<double>(count()) : 0.0);
    }
    fmt::print("{}\n", text);
  }

  // The report, schema assay-queries/1.
  nlohmann::ordered_json to_json(const std::vector<std::string>& files) const {
    using Json = nlohmann::ordered_json;
    Json differences = Json::array();
    for (const auto& d : differences_) {
      differences.push_back({{"file", d.file},
                             {"query", d.index},
                             {"answer", d.answer},
                             {"label", !d.answer},
                             {"label_disputed", d.label_disputed},
                             {"separation", d.separation ? Json(*d.separation) : Json()}});
    }
    Json rungs;
    for (std::size_t r = 0; method_ && r < rungs_.size(); ++r) {
      const char* name = method_->rungs[r];
      if (*name) rungs[name] = rungs_[r];
    }
    return {{"schema", "assay-queries/1"},
            {"version", version_text()},
            {"method", name_},
            {"files", files},
            {"separation", of_distance_ > 0 ? Json{least_, greatest_} : Json()},
            {"count", count()},
            {"yes", yes_},
            {"unlabelled", unlabelled_},
            {"false_positives", false_positives_},
            {"false_negatives", false_negatives_},
            {"disputed_labels", disputed()},
            {"differences", differences},
            {"mean_us", mean()},
            {"median_us", quantile(0.5)},
            {"p99_us", quantile(0.99)},
            {"p999_us", quantile(0.999)},
            {"max_us", quantile(1)},
            {"open", open_},
            {"contradictions", contradictions_.size()},
            {"rungs", rungs}};
  }

  // The referee contradicts the oracle.
  bool is_unsound() const { return !contradictions_.empty(); }
  // An answer differs from its truth in a way that the method claims to avoid. A plug-in is judged
  // by its claims instead (check/query_detector.h).
  bool is_wrong() const {
    return method_ &&
           ((false_positives_ > 0 && method_->claims.has(properties::Claim::no_spurious)) ||
            (false_negatives_ > 0 && method_->claims.has(properties::Claim::free_sound)));
  }

 private:
  std::size_t count() const { return microseconds_.size(); }
  std::size_t disputed() const { return differences_.size() - false_positives_ - false_negatives_; }
  double mean() const {
    double sum = 0;
    for (const double t : microseconds_) sum += t;
    return count() ? sum / static_cast<double>(count()) : 0;
  }

  double quantile(double share) const {
    return microseconds_.empty() ? 0 : reports::quantile(microseconds_, share);
  }

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

using QuerySet = std::vector<corpus::LabelledQuery>;

Expected<void> write_report(const std::string& file, const nlohmann::ordered_json& report) {
  if (file.empty()) return outcome::success();
  const auto written = write_json_file(file, report);
  if (written) fmt::print("wrote {}\n", file);
  return written;
}

// Asks the plug-in the queries of a file. The answers are judged and scored.
Expected<void> ask_plugin(QueryDetector& detector, const std::string& file, const QuerySet& set,
                          QueryScore& score) {
  std::vector<properties::Query> queries;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < set.size(); ++i) {
    queries.push_back(set[i].query);
    names.push_back(fmt::format("{} query {}", file, i));
  }
  BOOST_OUTCOME_TRY(judged, detector.judge(queries, names));
  for (std::size_t i = 0; i < set.size(); ++i) {
    const auto& one = judged[i];
    if (!one.is_within || one.run.steps.empty()) continue;
    const auto answer = one.run.steps[0].answer;
    if (answer != detector::Answer::free && answer != detector::Answer::collision) continue;
    // A label is no truth of another question than its own.
    const double separation = detector.separation();
    const bool is_asked = !one.is_rounded && set[i].separation.value_or(0) == separation;
    const auto truth = is_asked ? set[i].truth : std::nullopt;
    score.add_answer(file, i,
                     {answer == detector::Answer::collision, truth,
                      separation > 0 ? std::optional(separation) : std::nullopt,
                      truth && *truth != one.contact, 1e6 * one.run.times->steps[0]});
  }
  return outcome::success();
}

Expected<int> check_plugin(const QueryQuestion& question, const std::vector<QuerySet>& sets) {
  BOOST_OUTCOME_TRY(detector, QueryDetector::open(question.detector));
  if (question.separation.value_or(detector.separation()) != detector.separation()) {
    return Problem{fmt::format("--separation {}: {} answers by that of its contract, {}",
                               *question.separation, detector.name(), detector.separation())};
  }
  fmt::print("{}\n", detector.title());
  std::fflush(stdout);
  QueryScore score(detector.name());
  for (std::size_t i = 0; i < sets.size(); ++i) {
    BOOST_OUTCOME_TRY(ask_plugin(detector, question.files[i], sets[i], score));
  }
  score.print();
  fmt::print("{}", detector.text());
  auto report = score.to_json(question.files);
  report["detector"] = detector.to_json();
  BOOST_OUTCOME_TRY(write_report(question.json_file, report));
  return detector.exit_code();
}

// The problem of a method that knows no distance, if some query has a separation.
Expected<void> check_method(const QueryQuestion& question, const std::vector<QuerySet>& sets) {
  if (question.method->within) return outcome::success();
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const auto asks = std::find_if(sets[i].begin(), sets[i].end(),
                                   [](const auto& query) { return query.separation.has_value(); });
    if (asks == sets[i].end()) continue;
    std::vector<const char*> others;
    for (const auto& method : properties::named_methods()) {
      if (method.within) others.push_back(method.name);
    }
    return Problem{fmt::format("{} query {}: --method {} knows no separation; these do: {}",
                               question.files[i], asks - sets[i].begin(), question.method->name,
                               joined(others, ", "))};
  }
  return outcome::success();
}

}  // namespace

Expected<int> check_queries(const QueryQuestion& question) {
  if (!question.truths.empty() && question.truths.size() != question.files.size()) {
    return Problem{
        fmt::format("{} truth files for {} query files: give one for each, in the same order",
                    question.truths.size(), question.files.size())};
  }
  auto inputs = question.files;
  inputs.insert(inputs.end(), question.truths.begin(), question.truths.end());
  BOOST_OUTCOME_TRY(may_write({question.json_file}, inputs));
  std::vector<QuerySet> sets;
  for (std::size_t i = 0; i < question.files.size(); ++i) {
    std::optional<std::filesystem::path> truth;
    if (!question.truths.empty()) truth = question.truths[i];
    BOOST_OUTCOME_TRY(queries, corpus::read_queries(question.files[i], truth));
    for (auto& query : queries) {
      if (!query.separation) query.separation = question.separation;
    }
    sets.push_back(std::move(queries));
  }
  if (!question.detector.library.empty()) return check_plugin(question, sets);
  BOOST_OUTCOME_TRY(check_method(question, sets));
  QueryScore score(*question.method);
  for (std::size_t i = 0; i < sets.size(); ++i) score.add(question.files[i], sets[i]);
  score.print();
  auto report = score.to_json(question.files);
  report["detector"] = nullptr;
  BOOST_OUTCOME_TRY(write_report(question.json_file, report));
  if (score.is_unsound()) return exit_unsound;
  return score.is_wrong() ? exit_defect : exit_holds;
}

void add_query_options(Verb& verb, QueryQuestion& question) {
  verb.add("--truth FILE", question.truths, "Labels (.json), one file for each query file");
  std::vector<const char*> words;
  for (const auto& method : properties::named_methods()) words.push_back(method.name);
  const auto parse = [](std::string_view word) -> std::optional<const properties::QueryMethod*> {
    for (const auto& method : properties::named_methods()) {
      if (word == method.name) return &method;
    }
    return std::nullopt;
  };
  add_choice(verb, "--method", question.method, joined(words, ", "), parse,
             "Who answers queries (default oracle)");
}

}  // namespace assay::reports
