// `assay check` of query files asks one method labelled vertex-face and edge-edge queries, scores
// the answers against their truth, and times them one by one. The query of a plug-in may answer
// instead; then its claims are judged too.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "corpus/queries/query_csv.h"
#include "detector/contact/rungs.h"
#include "properties/fields.h"
#include "properties/queries/query_methods.h"
#include "properties/worker/plugin/query_case.h"
#include "reports/bench/sweep.h"
#include "reports/check/query_detector.h"
#include "reports/terminal/words.h"
#include "reports/terminal/work.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {

// A query whose answer differs from its label, or about which referee and oracle differ.
struct QueryDifference {
  std::string file;
  std::size_t query = 0;  // in the file
  bool answer = false, label = false;
  bool label_disputed = false;  // the label is in doubt, not the method
  std::optional<double> separation;
};
ASSAY_FIELDS(QueryDifference, file, query, answer, label, label_disputed, separation)

// The report, schema assay-queries/1.
struct QueryReport {
  std::string schema = "assay-queries/1", version = version_text(), method;
  std::vector<std::string> files;
  std::optional<std::vector<double>> separation;  // the least and the greatest
  std::uint64_t count = 0, yes = 0, unlabelled = 0;
  std::uint64_t false_positives = 0, false_negatives = 0, disputed_labels = 0;
  std::vector<QueryDifference> differences;
  double mean_us = 0, median_us = 0, p99_us = 0, p999_us = 0, max_us = 0;
  std::uint64_t open = 0;  // undecided; neither a yes nor a difference
  std::uint64_t contradictions = 0;
  std::optional<std::map<std::string, std::uint64_t>> rungs;  // of a method that has some
};
ASSAY_FIELDS(QueryReport, schema, version, method, files, separation, count, yes, unlabelled,
             false_positives, false_negatives, disputed_labels, differences, mean_us, median_us,
             p99_us, p999_us, max_us, open, contradictions, rungs)

namespace {

using detector::Decision;

properties::QueryTask task_of(const corpus::LabelledQuery& query) {
  properties::QueryTask task{query.query};
  if (query.separation) task.within = detector::Separation{*query.separation, 0};
  return task;
}

// Returns " within 0.1"; empty for a query of contact.
std::string within_text(const std::optional<double>& separation) {
  return separation ? fmt::format(" within {}", *separation) : "";
}

// Returns whether the label of a query that is coplanar throughout is in doubt, because another
// exact method gives the same answer as this one (such labels were never checked by their makers).
bool is_label_disputed(const properties::QueryMethod& method, const properties::QueryTask& task,
                       Decision answer) {
  const auto* oracle = properties::method_of("oracle");
  const auto* other = &method == oracle ? properties::method_of("detector-exact") : oracle;
  return detector::coplanar_throughout(task.query) && other->answer(task).decision == answer;
}

class QueryScore {
 public:
  // Begins a score. Without a method it is that of a plug-in, whose answers are added by
  // add_answer.
  QueryScore(std::string name, std::vector<std::string> files,
             const properties::QueryMethod* method)
      : method_(method) {
    report_.method = std::move(name);
    report_.files = std::move(files);
  }

  // Answers and times each query of a file, one by one. REQUIRES a method that knows distance, if a
  // query has a separation.
  void add(const std::string& file, const std::vector<corpus::LabelledQuery>& queries) {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const auto& [query, truth, separation] = queries[i];
      const auto task = task_of(queries[i]);
      const auto begin = std::chrono::steady_clock::now();
      const auto [decision, first, rung, proof] = method_->answer(task);
      Answered answer{decision == Decision::yes, truth, separation, false,
                      1e6 * seconds_since(begin)};
      answer.open = decision == Decision::open;
      answer.rung = rung;
      if (!answer.open) {
        answer.contradicted = method_->is_referee &&
                              properties::method_of("oracle")->answer(task).decision != decision;
        answer.label_disputed = truth && *truth != answer.contact && !separation &&
                                is_label_disputed(*method_, task, decision);
      }
      add_answer(file, i, answer);
    }
  }

  struct Answered {
    bool contact = false;       // or within the separation
    std::optional<bool> truth;  // the label, if it is about the asked question
    std::optional<double> separation;
    bool label_disputed = false;
    double microseconds = 0;
    bool open = false;          // the method did not decide
    bool contradicted = false;  // by the oracle, which asks the same question
    int rung = 0;               // MethodAnswer::rung
  };
  void add_answer(const std::string& file, std::size_t index, const Answered& answer) {
    const bool contact = answer.contact;
    const QueryDifference difference{
        file, index, contact, !contact, answer.label_disputed, answer.separation};
    microseconds_.push_back(answer.microseconds);
    ++report_.count;
    report_.unlabelled += answer.truth ? 0 : 1;
    report_.open += answer.open ? 1 : 0;
    if (const auto& d = answer.separation) {
      ++of_distance_;
      auto& range = report_.separation;
      range = range ? std::vector{std::min((*range)[0], *d), std::max((*range)[1], *d)}
                    : std::vector{*d, *d};
    }
    if (answer.open) return;
    report_.yes += contact ? 1 : 0;
    if (answer.contradicted) contradictions_.push_back(difference);
    ++rungs_[static_cast<std::size_t>(answer.rung)];
    if (!answer.truth || *answer.truth == contact) return;
    report_.differences.push_back(difference);
    ++(answer.label_disputed ? report_.disputed_labels
       : contact             ? report_.false_positives
                             : report_.false_negatives);
  }

  QueryReport report() const {
    QueryReport report = report_;
    report.contradictions = contradictions_.size();
    for (std::size_t r = 0; method_ && r < rungs_.size(); ++r) {
      const char* name = method_->rungs[r];
      if (!*name) continue;
      if (!report.rungs) report.rungs.emplace();
      (*report.rungs)[name] = rungs_[r];
    }
    if (microseconds_.empty()) return report;
    for (const double t : microseconds_) report.mean_us += t;
    report.mean_us /= static_cast<double>(report.count);
    const auto at = [&](double share) { return quantile(microseconds_, share); };
    report.median_us = at(0.5);
    report.p99_us = at(0.99);
    report.p999_us = at(0.999);
    report.max_us = at(1);
    return report;
  }

  // Prints to stdout: counts, differences from the truth, microseconds, rungs.
  void print() const {
    constexpr std::size_t most_listed = 50;
    const QueryReport r = report();
    std::string of_distance;
    if (const auto& range = r.separation)
      of_distance =
          fmt::format(" ({}{}{})", of_distance_, within_text(range->front()),
                      range->front() < range->back() ? fmt::format(" to {}", range->back()) : "");
    fmt::print("{}: {} queries{}, {} yes, {} without a label{}\n", r.method, r.count, of_distance,
               r.yes, r.unlabelled,
               method_ && method_->is_referee
                   ? fmt::format(", {} open, {} contradictions", r.open, r.contradictions)
                   : "");
    for (const auto& d : contradictions_) {
      fmt::print("  CONTRADICTION: {} query {}{}: referee {}, oracle {}\n", d.file, d.query,
                 within_text(d.separation), d.answer, d.label);
    }
    fmt::print(
        "differences from the truth: {} false positives, {} false negatives, {} disputed labels\n",
        r.false_positives, r.false_negatives, r.disputed_labels);
    for (const auto& d :
         std::span(r.differences).first(std::min(most_listed, r.differences.size()))) {
      fmt::print("  {} query {}{}: answer {}, label {}{}\n", d.file, d.query,
                 within_text(d.separation), d.answer, d.label,
                 !d.label_disputed ? ""
                 : method_ ? "; coplanar throughout, both exact methods agree against the label"
                           : "; the oracle agrees against the label");
    }
    if (r.differences.size() > most_listed)
      fmt::print("  ... {} more\n", r.differences.size() - most_listed);
    fmt::print("us a query: mean {:.2f}, median {:.2f}, p99 {:.2f}, p99.9 {:.2f}, max {:.2f}\n",
               r.mean_us, r.median_us, r.p99_us, r.p999_us, r.max_us);
    if (!r.rungs) return;
    const char* before = "rungs: ";
    for (const auto& [name, decided] : *r.rungs) {
      const double share =
          r.count ? 100.0 * static_cast<double>(decided) / static_cast<double>(r.count) : 0.0;
      fmt::print("{}{} {:.1f} %", std::exchange(before, ", "), name, share);
    }
    fmt::print("\n");
  }

  // Returns whether the referee contradicts the oracle.
  bool is_unsound() const { return !contradictions_.empty(); }
  // Returns whether an answer differs from its truth in a way that the method claims to avoid. A
  // plug-in is judged by its claims instead (check/query_detector.h).
  bool is_wrong() const {
    using properties::Claim;
    return method_ && ((report_.false_positives > 0 && method_->claims.has(Claim::no_spurious)) ||
                       (report_.false_negatives > 0 && method_->claims.has(Claim::free_sound)));
  }

 private:
  const properties::QueryMethod* const method_;  // null for a plug-in
  QueryReport report_;                           // of the answers that were added
  std::vector<double> microseconds_;
  std::array<std::uint64_t, 5> rungs_ = {};
  std::size_t of_distance_ = 0;  // queries that were asked with a separation
  std::vector<QueryDifference> contradictions_;
};

using QuerySet = std::vector<corpus::LabelledQuery>;

// Writes the report. `detector`: the results of the plug-in's answers, or null.
Expected<void> write_report(const std::string& file, const QueryScore& score,
                            const nlohmann::ordered_json& detector) {
  if (file.empty()) return outcome::success();
  auto report = properties::json_of_fields<nlohmann::ordered_json>(score.report());
  report["detector"] = detector;
  const auto status = write_json_file(file, report);
  if (status) fmt::print("wrote {}\n", file);
  return status;
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
  BOOST_OUTCOME_TRY(results, detector.judge(queries, names));
  for (std::size_t i = 0; i < set.size(); ++i) {
    const auto& one = results[i];
    if (!one || one->runs[0].steps.empty()) continue;
    const auto& run = one->runs[0];
    const auto answer = run.steps[0].answer;
    if (answer != detector::Answer::free && answer != detector::Answer::collision) continue;
    // A label is true only for its own question.
    const double separation = detector.separation();
    const bool is_rounded = one->c.frames != properties::case_of_query(set[i].query, "").frames;
    const bool is_asked = !is_rounded && set[i].separation.value_or(0) == separation;
    const auto truth = is_asked ? set[i].truth : std::nullopt;
    score.add_answer(file, i,
                     {answer == detector::Answer::collision, truth,
                      separation > 0 ? std::optional(separation) : std::nullopt,
                      truth && *truth == one->truth[0].pairs.empty(), 1e6 * run.times->steps[0]});
  }
  return outcome::success();
}

Expected<int> check_plugin(const QueryQuestion& task, const std::vector<QuerySet>& sets) {
  BOOST_OUTCOME_TRY(detector, QueryDetector::open(task.detector));
  if (task.separation.value_or(detector.separation()) != detector.separation()) {
    return Problem{fmt::format("--separation {}: {} answers by that of its contract, {}",
                               *task.separation, detector.name(), detector.separation())};
  }
  fmt::print("{}\n", detector.title());
  std::fflush(stdout);
  QueryScore score(detector.name(), task.files, nullptr);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    BOOST_OUTCOME_TRY(ask_plugin(detector, task.files[i], sets[i], score));
  }
  score.print();
  fmt::print("{}", detector.text());
  BOOST_OUTCOME_TRY(write_report(task.json_file, score, detector.to_json()));
  return detector.exit_code();
}

// Refuses a method that knows no distance, if some query has a separation.
Expected<void> check_method(const QueryQuestion& task, const std::vector<QuerySet>& sets) {
  if (task.method->knows_distance) return outcome::success();
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const auto asks = std::find_if(sets[i].begin(), sets[i].end(),
                                   [](const auto& query) { return query.separation.has_value(); });
    if (asks == sets[i].end()) continue;
    std::vector<const char*> others;
    for (const auto& method : properties::query_methods()) {
      if (method.knows_distance) others.push_back(method.word);
    }
    return Problem{fmt::format("{} query {}: --method {} knows no separation; these do: {}",
                               task.files[i], asks - sets[i].begin(), task.method->word,
                               join(others, ", "))};
  }
  return outcome::success();
}

}  // namespace

Expected<int> check_queries(const QueryQuestion& task) {
  if (!task.truths.empty() && task.truths.size() != task.files.size()) {
    return Problem{
        fmt::format("{} truth files for {} query files: give one for each, in the same order",
                    task.truths.size(), task.files.size())};
  }
  auto inputs = task.files;
  inputs.insert(inputs.end(), task.truths.begin(), task.truths.end());
  BOOST_OUTCOME_TRY(may_write({task.json_file}, inputs));
  std::vector<QuerySet> sets;
  for (std::size_t i = 0; i < task.files.size(); ++i) {
    std::optional<std::filesystem::path> truth;
    if (!task.truths.empty()) truth = task.truths[i];
    BOOST_OUTCOME_TRY(queries, corpus::read_queries(task.files[i], truth));
    for (auto& query : queries) {
      if (!query.separation) query.separation = task.separation;
    }
    sets.push_back(std::move(queries));
  }
  if (!task.detector.library.empty()) return check_plugin(task, sets);
  BOOST_OUTCOME_TRY(check_method(task, sets));
  QueryScore score(task.method->word, task.files, task.method);
  for (std::size_t i = 0; i < sets.size(); ++i) score.add(task.files[i], sets[i]);
  score.print();
  BOOST_OUTCOME_TRY(write_report(task.json_file, score, nullptr));
  if (score.is_unsound()) return exit_unsound;
  return score.is_wrong() ? exit_defect : exit_holds;
}

void add_query_options(CLI::App& verb, QueryQuestion& task) {
  add(verb, "--truth FILE", task.truths, "Labels (.json), one file for each query file");
  std::vector<const char*> words;
  for (const auto& method : properties::query_methods()) {
    if (method.word) words.push_back(method.word);
  }
  const auto parse = [](std::string_view word) {
    const auto* method = properties::method_of(word);
    return method ? std::optional(method) : std::nullopt;
  };
  add_choice(verb, "--method", task.method, join(words, ", "), parse,
             "Who answers queries (default oracle)");
}

}  // namespace assay::reports
