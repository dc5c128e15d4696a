// `assay report`: runs as one HTML page that works offline.
#include <fmt/format.h>

#include "reports/commands.h"
#include "reports/complaint.h"
#include "reports/json_output.h"
#include "reports/page_data/failure_scenes.h"
#include "reports/page_data/page_file.h"
#include "reports/page_data/run_json.h"
#include "reports/plain_progress.h"

namespace assay::reports {

int run_report(const ReportRequest& request) {
  using Json = nlohmann::ordered_json;
  if (auto problem = cannot_write(request.out, {})) return refuse(*problem);
  Json runs = Json::array();
  PlainProgress progress("report");
  for (const auto& folder : request.folders) {
    auto run = read_run(folder);
    if (!run) return refuse(run.error().message);
    progress.show(fmt::format("{}: {} trials, {} failures kept", folder, run.value().trials(),
                              run.value().failures.size()));
    Json json = run_json(run.value());
    json["failures"] = failures_json(run.value());
    runs.push_back(std::move(json));
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
