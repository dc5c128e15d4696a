// One sequence through a plug-in and through the built-in detector, timed in turn and judged.
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
  bool starts_clean = false;  // in no contact at its first frame, and closed
  int rounds = 5;
};

// A worker each, kept from sequence to sequence.
class ComparedWorkers {
 public:
  explicit ComparedWorkers(const BenchedPlugin& plugin);

  // Lines for `wrong`: a claim of the plug-in that is broken, two runs that differ where it claims
  // to be deterministic, anything that the built-in detector has wrong. `tick` is called between
  // runs.
  ComparedSequence compare(const SequenceToCompare& sequence, std::vector<std::string>& wrong,
                           const std::function<void()>& tick);

  // How the plug-in's process is isolated, once it has run.
  const properties::Isolation& isolation() const { return of_plugin_.isolation(); }

 private:
  const BenchedPlugin& plugin_;
  properties::WorkerProcess of_plugin_, of_built_in_;
};

}  // namespace assay::reports
