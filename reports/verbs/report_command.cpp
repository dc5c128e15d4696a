// `assay report` shows runs as one HTML page that works offline.
#include <fmt/format.h>

#include "properties/campaign/gates/findings.h"
#include "properties/campaign/ledger/run_folder.h"
#include "reports/certificate/verify.h"
#include "reports/page/run_json.h"
#include "reports/terminal/text_file.h"
#include "reports/terminal/words.h"
#include "reports/terminal/work.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {

namespace {

struct ReportRequest {
  std::vector<std::string> folders;  // the folders of the runs, oldest first
  std::string out;                   // the HTML file that is written
};

using Json = nlohmann::ordered_json;

// Everything that the page says of the run in a folder. A certificate that stands there is
// believed only if it verifies.
properties::Expected<Json> describe_run(const std::string& folder, PlainProgress& progress) {
  BOOST_OUTCOME_TRY(findings, properties::read_findings(folder));
  progress.show(fmt::format("{}: {} trials, {} failures kept", folder, findings.tally.trials(),
                            findings.failures.size()));
  const auto certificate = properties::certificate_file(folder);
  std::error_code ignored;
  Json json;
  if (std::filesystem::exists(certificate, ignored)) {
    const auto [differences, statement, others] = verify_certificate(certificate);
    json = differences.empty() ? run_json(findings, judge(findings), statement)
                               : run_json(findings, judge(findings), nullptr, differences.front());
  } else {
    json = run_json(findings, judge(findings, properties::asked_of_a_run(findings)));
  }
  json["failures"] = failure_scenes(findings);
  return json;
}

Expected<int> run_report(const ReportRequest& request) {
  // A page may stand beside the run and take the place of an older one, not that of another file.
  std::vector<std::string> files;
  for (const auto& folder : request.folders) {
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
      if (entry.path().extension() != ".html") files.push_back(entry.path().string());
    }
  }
  BOOST_OUTCOME_TRY(may_write({request.out}, files));
  Json runs = Json::array();
  PlainProgress progress("report");
  for (const auto& folder : request.folders) {
    if (const auto line = sent_alone(certificate_in(folder)); !line.empty()) return Problem{line};
    BOOST_OUTCOME_TRY(run, describe_run(folder, progress));
    runs.push_back(std::move(run));
  }
  progress.finish();
  const Json data = {
      {"schema", "assay-report/3"}, {"version", version_text()}, {"runs", std::move(runs)}};
  BOOST_OUTCOME_TRY(write_text_file(request.out, page_text(page_template(), data)));
  for (std::size_t i = 0; i < request.folders.size(); ++i) {
    const auto& run = data["runs"][i];
    fmt::print("{}: {}; {}\n", request.folders[i], run["verdict"].get<std::string>(),
               run["why"].get<std::string>());
  }
  fmt::print("page {}: opens in a browser, without a network\n", request.out);
  return exit_holds;
}

void add_options(Verb& verb, ReportRequest& request) {
  verb.add("DIR", request.folders, "Folders of runs, the oldest first").required();
  verb.add("--out FILE", request.out, "The page (.html)").required().in(OptionGroup::output);
}

}  // namespace

AddedVerb add_report(CLI::App& app) {
  return make_verb(app, "report", "Runs as one HTML page that works offline", add_options,
                   run_report);
}

}  // namespace assay::reports
