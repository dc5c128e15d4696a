// Runs one sequence through a plug-in and through the built-in detector, timed in turn and judged.
#pragma once

#include <functional>

#include "corpus/cases/case_file.h"
#include "detector/options.h"
#include "reports/bench/detector/compared_sequence.h"
#include "reports/bench/detector/detector_suite.h"

namespace assay::reports {

struct SequenceToCompare {
  corpus::Case c;
  std::string kind;
  bool starts_clean = false;  // closed, and without contact at the first frame
  int rounds = 5;
};

// One worker for each of the two detectors, kept from sequence to sequence.
class ComparedWorkers {
 public:
  explicit ComparedWorkers(const BenchedPlugin& plugin);

  // Adds a line to `wrong` for a broken claim of the plug-in, for two runs that differ although it
  // claims to be deterministic, and for anything that the built-in detector has wrong. `tick` is
  // called between runs.
  ComparedSequence compare(const SequenceToCompare& sequence, std::vector<std::string>& wrong,
                           const std::function<void()>& tick);

  // How the plug-in's process is isolated. Known once it has run.
  const properties::Isolation& isolation() const { return of_plugin_.isolation(); }

 private:
  const BenchedPlugin& plugin_;
  properties::WorkerProcess of_plugin_, of_built_in_;
};

}  // namespace assay::reports
