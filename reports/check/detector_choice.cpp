#include "reports/check/detector_choice.h"

#include <fmt/format.h>

#include "properties/printable.h"
#include "properties/worker/worker_process.h"

namespace assay::reports {

Expected<void> choose_detector(const DetectorWords& words, properties::CampaignRequest& request) {
  request.detector = properties::built_in_detector();
  request.threads = words.threads;
  if (words.library.empty()) return outcome::success();
  request.plugin = words.library;
  request.isolation = words.isolation;
  properties::WorkerProcess worker(request.worker, request.plugin,
                                   {.isolation = request.isolation, .threads = request.threads});
  const auto description = worker.describe();
  if (!description) return Refusal(description.error());
  request.isolated = worker.isolation();
  const auto& plugin = description.value();
  request.takes_threads = plugin.parts.takes_threads;
  const bool has_steps = plugin.parts.steps || plugin.parts.candidates;
  const bool of_queries =
      words.part == DetectorPart::query || (words.part == DetectorPart::by_library && !has_steps);
  if (of_queries && !plugin.parts.query)
    return Refusal(fmt::format("{}: it holds no elementary query", words.library));
  if (!of_queries && !has_steps)
    return Refusal(fmt::format("{}: it holds no steps, but a query alone", words.library));
  // The words of the plug-in go into ids, files and pages, so they must be printable.
  const auto name = properties::printable(plugin.name);
  request.detector = {fmt::format("{} {}", name, properties::printable(plugin.version)),
                      false,
                      of_queries ? claims_on_queries(plugin) : claims_on_steps(plugin),
                      plugin.contract,
                      {{name, {}}},
                      of_queries};
  return outcome::success();
}

}  // namespace assay::reports
