// `assay check-queries` asks one method labelled vertex-face and edge-edge queries, scores the
// answers against their truth, and times them one by one. The query of a plug-in may answer
// instead; then its claims are judged too.
#include <fmt/format.h>

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
    const auto truth = one.is_rounded ? std::nullopt : set[i].truth;
    score.add_answer(file, i,
                     {answer == detector::Answer::collision, truth, truth && *truth != one.contact,
                      1e6 * one.run.times->steps[0]});
  }
  return outcome::success();
}

Expected<int> check_plugin(const CheckQueriesRequest& request, const std::vector<QuerySet>& sets) {
  BOOST_OUTCOME_TRY(detector, QueryDetector::open(request.detector));
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

Expected<int> run_check_queries(const CheckQueriesRequest& request) {
  if (!request.truths.empty() && request.truths.size() != request.files.size()) {
    return Problem{
        fmt::format("{} truth files for {} query files: give one for each, in the same order",
                    request.truths.size(), request.files.size())};
  }
  BOOST_OUTCOME_TRY(may_write(request.json_file, request.files));
  std::vector<QuerySet> sets;
  for (std::size_t i = 0; i < request.files.size(); ++i) {
    std::optional<std::filesystem::path> truth;
    if (!request.truths.empty()) truth = request.truths[i];
    BOOST_OUTCOME_TRY(queries, corpus::read_queries(request.files[i], truth));
    sets.push_back(std::move(queries));
  }
  if (!request.detector.library.empty()) return check_plugin(request, sets);
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
  verb.add("files", request.files, "Query files (.csv, .csv.gz)").required();
  verb.add("--truth", request.truths, "Labels (.json), one file for each query file");
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
  add_detector(verb, request.detector, "A plug-in's library: its query answers").excludes(method);
  verb.add("--json", request.json_file, "Write the report here (assay-queries/1)");
}

}  // namespace

Action add_check_queries(CLI::App& app) {
  return make_verb(app, "check-queries", "Labelled VF and EE queries against their truth",
                   add_options, run_check_queries);
}

}  // namespace assay::reports
