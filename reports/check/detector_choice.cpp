#include "reports/check/detector_choice.h"

#include <fmt/format.h>

#include "properties/worker/worker_process.h"
#include "reports/terminal/printable.h"

namespace assay::reports {

Expected<void> choose_detector(const std::string& library, properties::CampaignRequest& request) {
  request.detector = properties::built_in_detector();
  if (library.empty()) return outcome::success();
  request.plugin = library;
  properties::WorkerProcess worker(request.worker, request.plugin);
  const auto description = worker.describe();
  if (!description) return Refusal(description.error());
  const auto& plugin = description.value();
  // Its words go into ids, files and pages.
  const auto name = printable(plugin.name);
  request.detector = {fmt::format("{} {}", name, printable(plugin.version)),
                      false,
                      plugin.claims,
                      plugin.contract,
                      {{name, {}}}};
  return outcome::success();
}

}  // namespace assay::reports
