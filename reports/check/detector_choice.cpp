#include "reports/check/detector_choice.h"

#include <fmt/format.h>

#include <boost/outcome/try.hpp>

#include "properties/campaign/plan.h"
#include "properties/printable.h"
#include "properties/worker/worker_process.h"
#include "reports/terminal/words.h"

namespace assay::reports {

namespace {

std::vector<std::string> unjudged_parts(const properties::PluginDescription& plugin,
                                        const properties::DetectorUnderTest& detector) {
  std::vector<std::string> parts;
  if (plugin.parts.steps && detector.of_queries) parts.emplace_back("whole steps");
  if (plugin.parts.candidates &&
      (detector.of_queries || !detector.claims.has(properties::Claim::candidates)))
    parts.emplace_back("broad phase");
  if (plugin.parts.query && detector.query_claims == properties::Claims())
    parts.emplace_back("elementary query");
  return parts;
}

}  // namespace

DetectorPart part_asked_by(const properties::CampaignPlan& plan) {
  if (properties::asks_queries_alone(plan)) return DetectorPart::query;
  return properties::asks_queries(plan) ? DetectorPart::by_library : DetectorPart::steps;
}

Expected<properties::Subject> choose_detector(const DetectorWords& words,
                                              const std::filesystem::path& folder) {
  properties::Subject subject;
  subject.worker = properties::worker_program();
  subject.detector = properties::built_in_detector();
  subject.threads = words.threads;
  if (words.library.empty()) return subject;
  subject.plugin = words.library;
  subject.judged = properties::JudgedLibrary::of(words.library, subject.worker);
  subject.isolation = words.isolation;
  properties::WorkerProcess worker(
      subject.worker, subject.plugin,
      {.isolation = subject.isolation, .threads = subject.threads, .unread = folder});
  BOOST_OUTCOME_TRY(description, worker.describe());
  subject.isolated = worker.isolation();
  const auto& plugin = description;
  subject.takes_threads = plugin.parts.takes_threads;
  const bool has_steps = plugin.parts.steps || plugin.parts.candidates;
  const bool of_queries =
      words.part == DetectorPart::query || (words.part == DetectorPart::by_library && !has_steps);
  if (of_queries && !plugin.parts.query)
    return Problem{fmt::format("{}: it holds no elementary query", words.library)};
  if (!of_queries && !has_steps)
    return Problem{fmt::format("{}: it holds no steps, but a query alone", words.library)};
  // The words of the plug-in go into ids, files and pages, so they must be printable.
  const auto name = properties::printable(plugin.name);
  subject.detector = {fmt::format("{} {}", name, properties::printable(plugin.version)),
                      false,
                      of_queries ? claims_on_queries(plugin) : claims_on_steps(plugin),
                      plugin.contract,
                      {{name, {}}},
                      of_queries,
                      {},
                      {}};
  const bool is_query_judged = plugin.parts.query && words.part != DetectorPart::steps &&
                               !judged_claims(claims_on_queries(plugin), plugin.contract).empty();
  if (is_query_judged) subject.detector.query_claims = claims_on_queries(plugin);
  subject.detector.unjudged_parts = unjudged_parts(plugin, subject.detector);
  return subject;
}

std::string plugin_text(const std::string& name_and_version, const properties::Claims& claims,
                        const properties::Contract& contract,
                        const properties::Isolation& isolation, std::uint64_t threads) {
  std::vector<const char*> names;
  for (const auto claim : properties::list_of(claims)) names.push_back(name_of(claim));
  const std::string words = joined(names, ", ");
  const std::string left_out = joined(phrases_of(contract), ", ");
  return fmt::format("plug-in {}\nclaims: {}\ncontract: {}\nisolation: {}\nthreads: {}",
                     name_and_version, words.empty() ? "nothing" : words,
                     left_out.empty() ? "leaves nothing out" : left_out, text_of(isolation),
                     threads);
}

std::string printed_text(const std::string& printed) {
  if (printed.empty()) return "";
  return fmt::format("  it printed:\n    {}\n", replaced(printed, {{'\n', "\n    "}}));
}

}  // namespace assay::reports
