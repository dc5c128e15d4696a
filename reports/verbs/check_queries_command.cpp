// `assay check-queries`: labelled vertex-face and edge-edge queries answered by one method, scored
// against their truth, and timed one by one.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "properties/words.h"
#include "reports/check/query_score.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/joined.h"
#include "reports/terminal/option_words.h"
#include "reports/terminal/text_file.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

struct CheckQueriesRequest {
  std::vector<std::string> files;
  std::vector<std::string> truths;  // none, or one a file
  QueryMethod method = QueryMethod::oracle;
  std::string json_file;
};

int run_check_queries(const CheckQueriesRequest& request) {
  if (!request.truths.empty() && request.truths.size() != request.files.size()) {
    return refuse(
        fmt::format("{} truth files for {} query files: give one for each, in the same order",
                    request.truths.size(), request.files.size()));
  }
  if (auto may = may_write(request.json_file, request.files); !may) return refuse(may.error());
  std::vector<std::vector<corpus::LabelledQuery>> sets;
  for (std::size_t i = 0; i < request.files.size(); ++i) {
    std::optional<std::filesystem::path> truth;
    if (!request.truths.empty()) truth = request.truths[i];
    auto queries = corpus::read_queries(request.files[i], truth);
    if (!queries) return refuse(Refusal(queries.error()));
    sets.push_back(std::move(queries.value()));
  }
  QueryScore score(request.method);
  for (std::size_t i = 0; i < sets.size(); ++i) score.add(request.files[i], sets[i]);
  score.print();
  if (!request.json_file.empty()) {
    const auto written = write_json_file(request.json_file, score.to_json(request.files));
    if (!written) return refuse(written.error());
    fmt::print("wrote {}\n", request.json_file);
  }
  if (score.is_unsound()) return exit_unsound;
  return score.is_wrong() ? exit_defect : exit_holds;
}

void add_options(Verb& verb, CheckQueriesRequest& request) {
  verb.add("files", request.files, "Query files (.csv, .csv.gz)").required();
  verb.add("--truth", request.truths, "Labels (.json), one file for each query file");
  const auto parse = [](std::string_view word) {
    return properties::value_of<QueryMethod>(query_method_names, word);
  };
  add_choice(verb, "--method", request.method, joined(query_method_names, ", "), parse,
             "Who answers (default oracle)");
  verb.add("--json", request.json_file, "Write the report here (assay-queries/1)");
}

}  // namespace

Action add_check_queries(CLI::App& app) {
  return make_verb(app, "check-queries", "Labelled VF and EE queries against their truth",
                   add_options, run_check_queries);
}

}  // namespace assay::reports
