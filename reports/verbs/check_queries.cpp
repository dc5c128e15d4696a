// `assay check` of query files asks one method the vertex-face and edge-edge queries of the files,
// scores the answers against the labelled truth, and times each query alone. If a plug-in is named,
// its query function answers, and its claims are judged too.
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
#include "properties/judging/exam.h"
#include "properties/judging/step_measures.h"
#include "properties/queries/query_methods.h"
#include "properties/words.h"
#include "properties/worker/plugin/query_case.h"
#include "reports/bench/sweep.h"
#include "reports/steps/measures_text.h"
#include "reports/terminal/option_words.h"
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

// A way in which the query of a plug-in breaks a claim.
struct BrokenWay {
  std::string signature;  // of the failure
  std::uint64_t met = 0;  // how many queries had it
  std::string query;      // the first of them: "FILE query 12"
  std::string what;       // explains it
};
ASSAY_FIELDS(BrokenWay, signature, met, query, what)

// What the claims of a plug-in's query came to.
struct ClaimsOnQueries {
  std::uint64_t judged = 0, left_out = 0, undecided = 0, not_asked = 0;
  nlohmann::ordered_json measures;
  std::map<std::string, std::uint64_t> broken;  // how many queries broke each claim
  std::vector<BrokenWay> failures;
};
ASSAY_FIELDS(ClaimsOnQueries, judged, left_out, undecided, not_asked, measures, broken, failures)

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
  std::optional<ClaimsOnQueries> detector;                    // of a plug-in
};
ASSAY_FIELDS(QueryReport, schema, version, method, files, separation, count, yes, unlabelled,
             false_positives, false_negatives, disputed_labels, differences, mean_us, median_us,
             p99_us, p999_us, max_us, open, contradictions, rungs, detector)

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
  // If there is no method, this is the score of a plug-in (QueryPlugin).
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
    fmt::print("{}: {} queries{}, {} answers yes, {} without a label{}\n", r.method, r.count,
               of_distance, r.yes, r.unlabelled,
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
                 : method_ ? "; coplanar throughout: both exact methods contradict the label"
                           : "; the oracle contradicts the label as well");
    }
    if (r.differences.size() > most_listed)
      fmt::print("  ... {} more differences\n", r.differences.size() - most_listed);
    fmt::print("microseconds: mean {:.2f}, median {:.2f}, p99 {:.2f}, p99.9 {:.2f}, max {:.2f}\n",
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

  // Of a method: whether the referee contradicts the oracle, and then whether an answer differs
  // from its truth in a way that the method claims to avoid.
  int exit_code() const {
    using properties::Claim;
    if (!contradictions_.empty()) return exit_unsound;
    const bool is_wrong =
        (report_.false_positives > 0 && method_->claims.has(Claim::no_spurious)) ||
        (report_.false_negatives > 0 && method_->claims.has(Claim::free_sound));
    return is_wrong ? exit_defect : exit_holds;
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

// Asks the query of a plug-in, scores its answers, and judges them by its claims. Nothing is
// stored.
class QueryPlugin {
 public:
  explicit QueryPlugin(properties::Subject subject) : subject_(std::move(subject)) {}

  // Asks the queries of a file. Fails if no worker can be started. After too many crashes, the
  // remaining queries count as not asked.
  Expected<void> ask(const std::string& file, const QuerySet& set, QueryScore& score) {
    constexpr std::size_t at_once = 512;
    const auto& plugin = subject_.detector;
    // The second worker is asked in the other order.
    const bool asks_twice = plugin.claims.has(properties::Claim::deterministic);
    for (std::size_t begin = 0; begin < set.size(); begin += at_once) {
      const std::size_t end = std::min(begin + at_once, set.size());
      if (crashes_ > most_crashes) {
        found_.not_asked += end - begin;
        continue;
      }
      std::vector<std::size_t> places;
      std::vector<corpus::Case> cases;
      for (std::size_t i = begin; i < end; ++i) {
        auto contracted_case = properties::contract_case(
            properties::case_of_query(set[i].query, "query"), plugin.contract);
        if (!contracted_case) continue;
        places.push_back(i);
        cases.push_back(std::move(*contracted_case));
      }
      found_.left_out += end - begin - places.size();
      const auto results = properties::examine(
          {plugin, {&asked_query, 1}, &worker_, asks_twice ? &second_ : nullptr}, std::move(cases));
      for (std::size_t i = 0; i < places.size(); ++i) {
        const auto& run = results[i].runs[0];
        if (run.end == properties::RunEnd::not_run) return Problem{run.explanation};
        judge(results[i], fmt::format("{} query {}", file, places[i]));
        if (!run.steps.empty()) add_to(score, file, places[i], set[places[i]], results[i]);
      }
    }
    return outcome::success();
  }

  ClaimsOnQueries found() const {
    auto found = found_;
    found.measures = measures_json(measures_);
    return found;
  }

  // Prints to stdout: the measures that do not depend on claims, the broken claims with the queries
  // that break them, and the verdict.
  void print() const {
    const auto& [judged, left_out, undecided, not_asked, unused, broken, failures] = found_;
    fmt::print("{}\n{}\n", measures_head(true), measures_row(measures_, true));
    if (left_out > 0) fmt::print("{} queries are left out by the plug-in's contract\n", left_out);
    if (not_asked > 0)
      fmt::print("{} queries were not asked: the plug-in crashed {} times\n", not_asked, crashes_);
    for (const auto& way : std::span(failures).first(std::min(most_shown, failures.size())))
      fmt::print("DEFECT {}, met {}\n  {}: {}\n", way.signature, properties::times_text(way.met),
                 way.query, way.what);
    if (failures.size() > most_shown)
      fmt::print("... {} more signatures\n", failures.size() - most_shown);
    for (const auto& [claim, n] : broken) fmt::print("broken: {}, by {} queries\n", claim, n);
    if (!broken.empty()) {
      fmt::print("{} of {} queries break a claim\n", defects_, judged);
    } else if (undecided + not_asked > 0) {
      fmt::print("undecided: {} of {} queries\n", undecided + not_asked, judged + not_asked);
    } else if (judged == 0) {
      fmt::print("undecided: no query is within the plug-in's contract\n");
    } else {
      fmt::print("all claims hold in {} queries\n", judged);
    }
  }

  int exit_code() const {
    if (defects_ > 0) return exit_defect;
    return found_.undecided + found_.not_asked > 0 || found_.judged == 0 ? exit_undecided
                                                                         : exit_holds;
  }

 private:
  // The number is chosen so that a library that crashes at each of a million queries is found out
  // in a minute.
  static constexpr std::uint64_t most_crashes = 100;
  static constexpr std::size_t most_shown = 20;  // signatures

  void judge(const properties::CaseResults& results, const std::string& name) {
    using properties::Outcome;
    const auto& run = results.runs[0];
    const auto& verdict = results.verdicts[0];
    crashes_ += run.end == properties::RunEnd::crashed ? 1 : 0;
    measures_ += properties::measures_of(verdict.steps, run.steps);
    ++found_.judged;
    if (verdict.outcome == Outcome::undecided || verdict.outcome == Outcome::error)
      ++found_.undecided;
    const auto& failure = verdict.failure;
    if (!failure) return;
    ++defects_;
    ++found_.broken[properties::name_of(failure->claim)];
    const auto signature = failure->signature();
    auto way = std::ranges::find(found_.failures, signature, &BrokenWay::signature);
    if (way == found_.failures.end()) {
      const bool is_alone_too = found_.failures.size() >= most_shown || answers_alone(results);
      way = found_.failures.insert(way,
                                   {signature, 0, name,
                                    properties::printable(failure->explanation) +
                                        (is_alone_too ? "" : properties::needs_what_came_before)});
    }
    ++way->met;
  }

  // Returns whether a new process that is asked only this query gives the same answer.
  bool answers_alone(const properties::CaseResults& results) const {
    auto fresh = subject_.process();
    return same_answers(results.runs[0], properties::run_alone(fresh, results.c, asked_query));
  }

  // Scores an answer; nothing if there is none.
  void add_to(QueryScore& score, const std::string& file, std::size_t index,
              const corpus::LabelledQuery& query, const properties::CaseResults& results) const {
    using detector::Answer;
    const auto& run = results.runs[0];
    const auto answer = run.steps[0].answer;
    if (answer != Answer::free && answer != Answer::collision) return;
    // A label is true only for its own question.
    const double separation = subject_.detector.contract.separation;
    const bool is_rounded = results.c.frames != properties::case_of_query(query.query, "").frames;
    const bool is_asked = !is_rounded && query.separation.value_or(0) == separation;
    const auto truth = is_asked ? query.truth : std::nullopt;
    score.add_answer(
        file, index,
        {answer == Answer::collision, truth,
         separation > 0 ? std::optional(separation) : std::nullopt,
         truth && *truth == results.truth[0].pairs.empty(), 1e6 * run.times->steps[0]});
  }

  static inline const properties::Configuration asked_query{"query", {}, {}, true};

  properties::Subject subject_;
  properties::WorkerProcess worker_ = subject_.process(), second_ = subject_.process(1);
  properties::StepMeasures measures_;  // of all queries that were judged
  std::uint64_t crashes_ = 0, defects_ = 0;
  ClaimsOnQueries found_;
};

Expected<void> write_report(const std::string& file, const QueryReport& report) {
  if (file.empty()) return outcome::success();
  const auto status =
      write_json_file(file, properties::json_of_fields<nlohmann::ordered_json>(report));
  if (status) fmt::print("wrote {}\n", file);
  return status;
}

Expected<int> check_plugin(const QueryQuestion& task, const std::vector<QuerySet>& sets) {
  auto words = task.detector;
  words.part = DetectorPart::query;
  BOOST_OUTCOME_TRY(subject, choose_detector(words));
  const auto& detector = subject.detector;
  const double separation = detector.contract.separation;
  if (judged_claims(detector.claims, detector.contract, true).empty())
    return Problem{fmt::format("{}: it makes no claim about its query", words.library)};
  if (task.separation.value_or(separation) != separation) {
    return Problem{fmt::format("--separation {}: {} answers for the separation of its contract, {}",
                               *task.separation, detector.name, separation)};
  }
  fmt::print("{}\n", plugin_text(subject));
  std::fflush(stdout);
  QueryScore score(detector.name, task.files, nullptr);
  QueryPlugin plugin(std::move(subject));
  for (std::size_t i = 0; i < sets.size(); ++i) {
    BOOST_OUTCOME_TRYV(plugin.ask(task.files[i], sets[i], score));
  }
  score.print();
  plugin.print();
  auto report = score.report();
  report.detector = plugin.found();
  BOOST_OUTCOME_TRYV(write_report(task.json_file, report));
  return plugin.exit_code();
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
    return Problem{fmt::format("{} query {}: --method {} knows no separation; these methods do: {}",
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
  BOOST_OUTCOME_TRYV(write_report(task.json_file, score.report()));
  return score.exit_code();
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
             "The method that answers queries (default oracle)");
}

}  // namespace assay::reports
