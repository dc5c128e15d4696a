// `assay report`: runs as one HTML page that works offline.
#include <fmt/format.h>

#include <boost/outcome/try.hpp>

#include "reports/commands.h"
#include "reports/complaint.h"
#include "reports/json_output.h"
#include "reports/page_data/certificate_json.h"
#include "reports/page_data/failure_scenes.h"
#include "reports/page_data/page_file.h"
#include "reports/page_data/run_json.h"
#include "reports/plain_progress.h"

namespace assay::reports {

namespace {

using Json = nlohmann::ordered_json;

// All that the page says of the run in a folder.
corpus::Expected<Json> describe_run(const std::string& folder, PlainProgress& progress) {
  BOOST_OUTCOME_TRY(run, read_run(folder));
  progress.show(
      fmt::format("{}: {} trials, {} failures kept", folder, run.trials(), run.failures.size()));
  Json json = run_json(run);
  BOOST_OUTCOME_TRY(certificate, read_certificate(folder));
  if (!certificate.is_null()) {
    BOOST_OUTCOME_TRY(take_certificate(certificate, json));
  }
  json["failures"] = failures_json(run);
  return json;
}

}  // namespace

int run_report(const ReportRequest& request) {
  if (auto problem = cannot_write(request.out, {})) return refuse(*problem);
  Json runs = Json::array();
  PlainProgress progress("report");
  for (const auto& folder : request.folders) {
    auto run = describe_run(folder, progress);
    if (!run) return refuse(run.error().message);
    runs.push_back(std::move(run.value()));
  }
  progress.finish();
  const Json data = {
      {"schema", "assay-report/1"}, {"version", version_text()}, {"runs", std::move(runs)}};
  if (auto problem = write_text_file(request.out, page_text(page_template(), data)))
    return refuse(*problem);
  for (const auto& run : data["runs"]) {
    fmt::print("{}: {}; {}\n", run["folder"].get<std::string>(), run["verdict"].get<std::string>(),
               run["why"].get<std::string>());
  }
  fmt::print("page {}: opens in a browser, without a network\n", request.out);
  return exit_holds;
}

}  // namespace assay::reports
