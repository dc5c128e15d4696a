#include "reports/check/detector_choice.h"

#include <fmt/format.h>

#include "properties/printable.h"
#include "properties/worker/worker_process.h"

namespace assay::reports {

Expected<void> choose_detector(const DetectorWords& words, properties::CampaignRequest& request) {
  request.detector = properties::built_in_detector();
  if (words.library.empty()) return outcome::success();
  request.plugin = words.library;
  request.isolation = words.isolation;
  properties::WorkerProcess worker(request.worker, request.plugin,
                                   {.isolation = request.isolation});
  const auto description = worker.describe();
  if (!description) return Refusal(description.error());
  request.isolated = worker.isolation();
  const auto& plugin = description.value();
  // Its words go into ids, files and pages.
  const auto name = properties::printable(plugin.name);
  request.detector = {fmt::format("{} {}", name, properties::printable(plugin.version)),
                      false,
                      plugin.claims,
                      plugin.contract,
                      {{name, {}}}};
  return outcome::success();
}

}  // namespace assay::reports
