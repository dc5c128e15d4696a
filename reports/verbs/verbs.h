// The verbs of the command line.
//
// There is one file for each verb: NAME_command.cpp holds its request, its options and its action,
// so that a new option changes one file. `certify` is in the file of `run`, because it certifies
// the shares of `run`; the part of `check` for query files is in check_queries.cpp.
#pragma once

#include "properties/queries/query_methods.h"
#include "reports/campaign/campaign_terminal.h"
#include "reports/terminal/options.h"

namespace assay::reports {

// Each function adds its verb, with all its options, to the command line.
VerbAction add_bench(CLI::App& app);
VerbAction add_certify(CLI::App& app);
VerbAction add_check(CLI::App& app);
VerbAction add_list(CLI::App& app);
VerbAction add_replay(CLI::App& app);
VerbAction add_report(CLI::App& app);
VerbAction add_run(CLI::App& app);
VerbAction add_scene(CLI::App& app);
VerbAction add_self_test(CLI::App& app);
VerbAction add_shrink(CLI::App& app);
VerbAction add_verify(CLI::App& app);

// The question to `check` about query files.
struct QueryQuestion {
  std::vector<std::string> files;
  std::vector<std::string> truths;  // none, or one for each file
  const properties::QueryMethod* method = properties::method_of("oracle");
  std::optional<double> separation;  // the distance for queries whose rows state none
  DetectorWords detector;
  std::string json_file;
};
// Adds --truth and --method.
void add_query_options(CLI::App& verb, QueryQuestion& question);
Expected<int> check_queries(const QueryQuestion& question);

}  // namespace assay::reports
