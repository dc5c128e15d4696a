#include "reports/certificate/again.h"

#include <fmt/format.h>

#include <boost/outcome/try.hpp>
#include <nlohmann/json.hpp>

#include "properties/campaign/gates/findings.h"
#include "properties/worker/plugin/judged_library.h"
#include "properties/worker/worker_process.h"
#include "reports/check/detector_choice.h"

namespace assay::reports {
namespace {

using properties::BoundRun;

// Finds the library of the plug-in and checks that it is the certified one, before any of its code
// runs. `judged` keeps it as it is.
Expected<std::string> certified_library(const properties::RunFindings& findings,
                                        const std::string& named,
                                        std::shared_ptr<const properties::JudgedLibrary>& judged) {
  const auto& run = findings.run;
  if (run.detector.built_in) {
    if (!named.empty())
      return Problem{"--detector: the certificate is of the built-in detector, not of a plug-in"};
    return std::string();
  }
  const auto library = named.empty() ? findings.library : named;
  if (library.empty())
    return Problem{"the stores do not say where the plug-in lies: name it by --detector"};
  judged = properties::JudgedLibrary::of(library, properties::worker_program());
  BOOST_OUTCOME_TRY(digest, judged->digest());
  if (digest != run.digests.plugin)
    return Problem{
        fmt::format("{}: not the library that was certified: its SHA-256 is {}, {} is "
                    "certified",
                    library, digest, run.digests.plugin.value_or("none"))};
  return library;
}

// Says what in this build keeps it from making the trials again. Empty if nothing does.
std::string difference_of_builds(const BoundRun& certified, const BoundRun& ours) {
  if (certified.digests.generator != ours.digests.generator)
    return "the generator of this assay makes other cases than that of the certificate";
  if (certified.detector.built_in && certified.digests.worker != ours.digests.worker)
    return "the built-in detector of this assay is not that of the certificate";
  if (json_of(certified.detector) != json_of(ours.detector))
    return "the detector has other claims, another contract or other configurations now";
  return "";
}

}  // namespace

Expected<properties::TrialsAgain> run_certified_again(
    const std::filesystem::path& folder, const AgainRequest& asked,
    const std::function<void(const properties::TrialProgress&)>& progress) {
  BOOST_OUTCOME_TRY(findings, properties::read_findings(folder));
  const auto& run = findings.run;
  std::shared_ptr<const properties::JudgedLibrary> judged;
  BOOST_OUTCOME_TRY(library, certified_library(findings, asked.detector.library, judged));
  properties::CampaignRequest request;
  request.plan = run.plan;
  request.seed = run.seed;
  request.jobs = asked.jobs;
  const DetectorWords words{library, asked.detector.isolation, run.detector.threads,
                            part_asked_by(run.plan)};
  BOOST_OUTCOME_TRY(subject, choose_detector(words));
  static_cast<properties::Subject&>(request) = std::move(subject);
  BOOST_OUTCOME_TRY(ours, properties::read_binding(properties::binding_of(request), folder));
  const auto difference = difference_of_builds(run, ours);
  if (!difference.empty())
    return Problem{
        fmt::format("{}: its trials cannot be run again: {}", folder.string(), difference)};
  BOOST_OUTCOME_TRY(again,
                    properties::run_again(request, folder, asked.share, asked.seed, progress));
  return std::move(again);
}

}  // namespace assay::reports
