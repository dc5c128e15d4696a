// What is kept of steps that fail: of each the part of the mesh that shows it, as files that other
// programs read (steps/case_export.h).
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "properties/judging/subject.h"
#include "reports/check/check_outcome.h"
#include "reports/check/check_run.h"

namespace assay::reports {

class KeptFailures {
 public:
  // Into FOLDER/step-N of step N, from 1. `origin` names the input, for people, and `again(number)`
  // is the line that judges this step again, with all that came before it where that may matter.
  // With `plugin`, of the same code, that is asked about each step alone, and what it fails on is
  // shrunk for so many seconds.
  KeptFailures(std::filesystem::path folder, std::string origin,
               std::function<std::string(std::uint64_t number)> again,
               std::optional<properties::Subject> plugin = {}, double shrink_seconds = 20);

  // Keeps the step, unless many that fail in the same way are kept already. Returns what is to be
  // printed.
  std::string keep(const FailedStep& failed);

  // Writes FOLDER/page.html: the verdict, what each claim came to, and the steps that are kept,
  // with their pictures. It is one file that asks for nothing. The report lists the steps, and the
  // outcome gets the first problem of all files.
  void end(CheckAnswer& answer) const;

 private:
  struct Kept {
    std::uint64_t number = 0;  // from 1
    std::string what, size;    // "14 triangles, 12 vertices, 1 step"
    std::string folder;        // in the folder of all
    std::string again;
    std::string picture = {};             // SVG; empty: too large
    std::optional<bool> reproduced = {};  // by the plug-in; nothing: it was not asked
    std::string asked = {};               // what came of asking it, in words
    std::string replay = {};              // the line that replays the smallest case; or empty
  };

  // Returns what is to be printed. Fails if a file cannot be written.
  Expected<std::string> write_step(const FailedStep& failed, const properties::Failure& failure,
                                   const std::string& again);
  Expected<void> write_page(const CheckOutcome& outcome) const;
  // Asks the plug-in about the case, in a process that was asked nothing before, and shrinks what
  // it fails on.
  Expected<void> ask_plugin(const corpus::Case& c, Kept& kept) const;

  const std::filesystem::path folder_;
  const std::string origin_;
  const std::function<std::string(std::uint64_t)> again_;
  const std::optional<properties::Subject> plugin_;
  const double shrink_seconds_;
  std::map<std::string, int> met_;  // by signature
  std::vector<Kept> steps_;
  std::string unwritten_;  // the first problem of a file
};

}  // namespace assay::reports
