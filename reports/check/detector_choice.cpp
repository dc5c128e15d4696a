#include "reports/check/detector_choice.h"

#include "properties/worker/worker_process.h"

namespace assay::reports {

Expected<void> choose_detector(const std::string& library, properties::CampaignRequest& request) {
  request.detector = properties::built_in_detector();
  if (library.empty()) return outcome::success();
  request.plugin = library;
  properties::WorkerProcess worker(request.worker, request.plugin);
  const auto description = worker.describe();
  if (!description) return Refusal(description.error());
  const auto& plugin = description.value();
  request.detector = {plugin.name + " " + plugin.version,
                      false,
                      plugin.claims,
                      plugin.contract,
                      {{plugin.name, {}}}};
  return outcome::success();
}

}  // namespace assay::reports
