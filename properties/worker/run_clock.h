// Measures what a case takes in the process that runs it, part by part.
#pragma once

#include <optional>

#include "properties/worker/case_run.h"

namespace assay::properties {

// Counts the processor time of this process with all of its threads, and its memory. Counts
// nothing if it is off.
class RunClock {
 public:
  // Begins to time the making of the detector.
  explicit RunClock(bool is_on);
  void created();
  void begin();     // a step begins
  void answered();  // the step that began last has its answer
  std::optional<RunTimes> take();

 private:
  double lap();

  bool is_on_;
  double last_ = 0;
  RunTimes times_;
};

}  // namespace assay::properties
