// What is kept of steps that fail: of each the part of the mesh that shows it, as files that other
// programs read (steps/case_export.h).
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "properties/judging/subject.h"
#include "reports/check/check_outcome.h"
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

  // Writes FOLDER/page.html: the verdict, what each claim came to, and the steps that are kept,
  // with their pictures. It is one file that asks for nothing. Fails if it cannot be written.
  Expected<void> write_page(const CheckOutcome& outcome) const;

 private:
  struct Kept {
    std::uint64_t number = 0;            // from 1
    std::string what, size;              // "14 triangles, 12 vertices, 1 step"
    std::string folder;                  // in the folder of all
    std::string replay, picture, again;  // pictures are SVG; empty: too large, not asked
  };

  Expected<std::string> ask_again(const corpus::Case& c, const std::filesystem::path& folder);

  const std::filesystem::path folder_;
  const std::string origin_;
  const std::function<std::string(std::uint64_t)> replay_;
  const std::optional<properties::Subject> again_;
  std::unique_ptr<properties::WorkerProcess> worker_;
  const double shrink_seconds_;
  std::map<std::string, int> met_;  // by signature
  std::vector<Kept> steps_;
};

}  // namespace assay::reports
