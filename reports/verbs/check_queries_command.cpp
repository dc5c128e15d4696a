// `assay check-queries` asks one method labelled vertex-face and edge-edge queries, scores the
// answers against their truth, and times them one by one. The query of a plug-in may answer
// instead; then its claims are judged too.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "reports/queries/query_detector.h"
#include "reports/queries/query_score.h"
#include "reports/terminal/text_file.h"
#include "reports/terminal/words.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

using QuerySet = std::vector<corpus::LabelledQuery>;

struct CheckQueriesRequest {
  std::vector<std::string> files;
  std::vector<std::string> truths;  // none, or one for each file
  const properties::QueryMethod* method = &properties::oracle_method();
  std::optional<double> separation;  // of the queries whose rows say none
  DetectorWords detector;
  std::string json_file;
};

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

Expected<int> check_plugin(const CheckQueriesRequest& request, const std::vector<QuerySet>& sets) {
  BOOST_OUTCOME_TRY(detector, QueryDetector::open(request.detector));
  if (request.separation.value_or(detector.separation()) != detector.separation()) {
    return Problem{fmt::format("--separation {}: {} answers by that of its contract, {}",
                               *request.separation, detector.name(), detector.separation())};
  }
  fmt::print("{}\n", detector.title());
  std::fflush(stdout);
  QueryScore score(detector.name());
  for (std::size_t i = 0; i < sets.size(); ++i) {
    BOOST_OUTCOME_TRY(ask_plugin(detector, request.files[i], sets[i], score));
  }
  score.print();
  fmt::print("{}", detector.text());
  auto report = score.to_json(request.files);
  report["detector"] = detector.to_json();
  BOOST_OUTCOME_TRY(write_report(request.json_file, report));
  return detector.exit_code();
}

// The problem of a method that knows no distance, if some query has a separation.
Expected<void> check_method(const CheckQueriesRequest& request, const std::vector<QuerySet>& sets) {
  if (request.method->within) return outcome::success();
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const auto asks = std::find_if(sets[i].begin(), sets[i].end(),
                                   [](const auto& query) { return query.separation.has_value(); });
    if (asks == sets[i].end()) continue;
    std::vector<const char*> others;
    for (const auto& method : properties::named_methods()) {
      if (method.within) others.push_back(method.name);
    }
    return Problem{fmt::format("{} query {}: --method {} knows no separation; these do: {}",
                               request.files[i], asks - sets[i].begin(), request.method->name,
                               joined(others, ", "))};
  }
  return outcome::success();
}

Expected<int> run_check_queries(const CheckQueriesRequest& request) {
  if (!request.truths.empty() && request.truths.size() != request.files.size()) {
    return Problem{
        fmt::format("{} truth files for {} query files: give one for each, in the same order",
                    request.truths.size(), request.files.size())};
  }
  auto inputs = request.files;
  inputs.insert(inputs.end(), request.truths.begin(), request.truths.end());
  BOOST_OUTCOME_TRY(may_write({request.json_file}, inputs));
  std::vector<QuerySet> sets;
  for (std::size_t i = 0; i < request.files.size(); ++i) {
    std::optional<std::filesystem::path> truth;
    if (!request.truths.empty()) truth = request.truths[i];
    BOOST_OUTCOME_TRY(queries, corpus::read_queries(request.files[i], truth));
    for (auto& query : queries) {
      if (!query.separation) query.separation = request.separation;
    }
    sets.push_back(std::move(queries));
  }
  if (!request.detector.library.empty()) return check_plugin(request, sets);
  BOOST_OUTCOME_TRY(check_method(request, sets));
  QueryScore score(*request.method);
  for (std::size_t i = 0; i < sets.size(); ++i) score.add(request.files[i], sets[i]);
  score.print();
  auto report = score.to_json(request.files);
  report["detector"] = nullptr;
  BOOST_OUTCOME_TRY(write_report(request.json_file, report));
  if (score.is_unsound()) return exit_unsound;
  return score.is_wrong() ? exit_defect : exit_holds;
}

void add_options(Verb& verb, CheckQueriesRequest& request) {
  verb.add("FILE", request.files, "Query files (.csv, .csv.gz)").required();
  verb.add("--truth FILE", request.truths, "Labels (.json), one file for each query file");
  std::vector<const char*> words;
  for (const auto& method : properties::named_methods()) words.push_back(method.name);
  const auto parse = [](std::string_view word) -> std::optional<const properties::QueryMethod*> {
    for (const auto& method : properties::named_methods()) {
      if (word == method.name) return &method;
    }
    return std::nullopt;
  };
  const auto method = add_choice(verb, "--method", request.method, joined(words, ", "), parse,
                                 "Who answers (default oracle)");
  verb.add("--separation LENGTH", request.separation,
           "Ask for this distance, and not for contact, where a query's rows say none")
      .with(length());
  add_detector(verb, request.detector, "A plug-in's library: its query answers").excludes(method);
  verb.add("--json FILE", request.json_file, "Write the report here (assay-queries/1)")
      .in(OptionGroup::output);
}

}  // namespace

AddedVerb add_check_queries(CLI::App& app) {
  return make_verb(app, "check-queries",
                   "Labelled vertex-face and edge-edge queries against their truth", add_options,
                   run_check_queries);
}

}  // namespace assay::reports
