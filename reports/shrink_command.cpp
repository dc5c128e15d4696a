// `assay shrink`: the smallest case that fails as this one does.
#include <fmt/format.h>

#include "properties/campaign/shrink.h"
#include "properties/case_check.h"
#include "properties/reducer/mesh_size.h"
#include "reports/commands.h"
#include "reports/complaint.h"
#include "reports/detector_choice.h"
#include "reports/json_output.h"
#include "reports/plain_progress.h"

namespace assay::reports {
namespace {

// The configuration in which the case fails, or nothing.
std::optional<properties::Configuration> failing_configuration(
    const corpus::Case& c, const properties::DetectorUnderTest& detector,
    properties::WorkerProcess& worker, std::string& signature) {
  for (const auto& configuration : detector.configurations) {
    const auto finding = properties::judge_of_detector(detector, configuration, worker)(c);
    if (!finding) continue;
    signature = finding->signature;
    return configuration;
  }
  return std::nullopt;
}

}  // namespace

int run_shrink(const ShrinkRequest& request) {
  if (auto problem = cannot_write(request.out, {})) return refuse(*problem);
  auto read = corpus::read_case(request.file);
  if (!read) return refuse(read.error().message);
  const corpus::Case& c = read.value();
  if (auto wrong = properties::wrong_option(c)) {
    return refuse(fmt::format("{}: {}", request.file, *wrong));
  }
  properties::CampaignRequest subject;
  subject.worker = properties::worker_program();
  if (auto problem = choose_detector(request.detector, subject)) return refuse(*problem);
  if (subject.detector.built_in && !c.options.empty()) {
    subject.detector.configurations = {{"the case's own", properties::options_of(c)}};
  }
  constexpr double hang_seconds = 10;
  properties::WorkerProcess worker(subject.worker, subject.plugin, {hang_seconds, 0});
  std::string signature;
  const auto configuration = failing_configuration(c, subject.detector, worker, signature);
  if (!configuration) {
    fmt::print("{}: holds in every configuration; there is nothing to shrink\n", request.file);
    return exit_holds;
  }
  fmt::print("{} ({}); at most {} s; writes {}\n", signature, configuration->name, request.seconds,
             request.out);
  PlainProgress progress("shrinking");
  std::optional<std::string> problem;
  const auto reduction =
      properties::shrink_case(c, subject.detector, *configuration, worker,
                              {request.seconds, 10'000'000}, [&](const corpus::Case& better) {
                                progress.show(properties::size_text(properties::size_of(better)));
                                problem = write_text_file(request.out, corpus::case_text(better));
                              });
  progress.finish();
  if (reduction.calls > 0 && !problem) {
    problem = write_text_file(request.out, corpus::case_text(reduction.smallest));
  }
  if (problem) return refuse(*problem);
  fmt::print("{}; {} runs, {:.1f} s{}\nreplay: assay replay {}{}\n",
             properties::size_text(properties::size_of(c), properties::size_of(reduction.smallest)),
             reduction.calls, reduction.seconds, reduction.fixed_point ? "" : "; the time was over",
             request.out, request.detector.empty() ? "" : " --detector " + request.detector);
  return exit_defect;
}

}  // namespace assay::reports
