#include "reports/certificate/again.h"

#include <fmt/format.h>

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
  const auto& digest = judged->digest();
  if (!digest) return digest.error();
  if (digest.value() != run.digests.plugin)
    return Problem{
        fmt::format("{}: not the library that was certified: its SHA-256 is {}, {} is "
                    "certified",
                    library, digest.value(), run.digests.plugin.value_or("none"))};
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
  const auto findings = properties::read_findings(folder);
  if (!findings) return findings.error();
  const auto& run = findings.value().run;
  std::shared_ptr<const properties::JudgedLibrary> judged;
  const auto library = certified_library(findings.value(), asked.detector.library, judged);
  if (!library) return library.error();
  properties::CampaignRequest request;
  request.plan = run.plan;
  request.seed = run.seed;
  request.jobs = asked.jobs;
  request.worker = properties::worker_program();
  const DetectorWords words{library.value(), asked.detector.isolation, run.detector.threads,
                            part_asked_by(run.plan)};
  if (auto chosen = choose_detector(words, request); !chosen) return chosen.error();
  const auto ours = properties::read_binding(properties::binding_of(request), folder);
  if (!ours) return ours.error();
  const auto difference = difference_of_builds(run, ours.value());
  if (!difference.empty())
    return Problem{
        fmt::format("{}: its trials cannot be run again: {}", folder.string(), difference)};
  auto again = properties::run_again(request, folder, asked.share, asked.seed, progress);
  if (!again) return again.error();
  return std::move(again.value());
}

}  // namespace assay::reports
