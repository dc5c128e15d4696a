#include "reports/check/detector_choice.h"

#include <fmt/format.h>

#include "properties/campaign/plan.h"
#include "reports/terminal/words.h"

namespace assay::reports {

DetectorPart part_asked_by(const properties::CampaignPlan& plan) {
  if (properties::asks_queries_alone(plan)) return DetectorPart::query;
  return properties::asks_queries(plan) ? DetectorPart::by_library : DetectorPart::steps;
}

Expected<properties::Subject> choose_detector(const DetectorWords& words,
                                              properties::WorkerLimits limits,
                                              const std::filesystem::path& worker) {
  limits.isolation = words.isolation;
  limits.threads = words.threads;
  return properties::Subject::open(worker, words.library, words.part, limits);
}

std::string detector_text(const properties::DetectorUnderTest& detector) {
  std::vector<const char*> claims;
  for (const auto claim : list_of(detector.claims)) claims.push_back(name_of(claim));
  const std::string left_out = joined(phrases_of(detector.contract), ", ");
  return fmt::format("{}\nclaims: {}\ncontract: {}", detector.name,
                     claims.empty() ? "nothing" : joined(claims, ", "),
                     left_out.empty() ? "leaves nothing out" : left_out);
}

std::string plugin_text(const properties::Subject& plugin) {
  return fmt::format("plug-in {}\nisolation: {}\nthreads: {}", detector_text(plugin.detector),
                     text_of(plugin.isolation), plugin.limits.threads);
}

std::string printed_text(const std::string& printed) {
  if (printed.empty()) return "";
  return fmt::format("  it printed:\n    {}\n", replaced(printed, {{'\n', "\n    "}}));
}

}  // namespace assay::reports
