// What is kept of steps that fail: of each the part of the mesh that shows it, as files that other
// programs read (steps/case_export.h).
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "properties/judging/subject.h"
#include "reports/check/check_run.h"

namespace assay::reports {

class KeptFailures {
 public:
  // Into FOLDER/step-N of step N, from 1. `origin` names the input, for people, and
  // `replay(number)` is the line that judges this step again. With `again`, a plug-in of the same
  // code is asked about each step, and what it fails on is shrunk for so many seconds.
  KeptFailures(std::filesystem::path folder, std::string origin,
               std::function<std::string(std::uint64_t number)> replay,
               std::optional<properties::Subject> again = {}, double shrink_seconds = 20);

  // Keeps the step, unless many that fail in the same way are kept already. Returns what is to be
  // printed. Fails if a file cannot be written.
  Expected<std::string> keep(const FailedStep& failed);

 private:
  Expected<std::string> ask_again(const corpus::Case& c, const std::filesystem::path& folder);

  const std::filesystem::path folder_;
  const std::string origin_;
  const std::function<std::string(std::uint64_t)> replay_;
  const std::optional<properties::Subject> again_;
  std::unique_ptr<properties::WorkerProcess> worker_;
  const double shrink_seconds_;
  std::map<std::string, int> kept_;  // by signature
};

}  // namespace assay::reports
