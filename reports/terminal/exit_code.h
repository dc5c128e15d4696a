// The exit codes of every verb. If several apply, the first of 2, 4, 1, 3, 5, 0 is used.
#pragma once

namespace assay::reports {

enum ExitCode : int {
  exit_holds = 0,      // all claims hold
  exit_defect = 1,     // detector and oracle (or truth, or expected facts) differ
  exit_usage = 2,      // usage or input error: one line on stderr, nothing else
  exit_undecided = 3,  // a step ended at a limit
  exit_unsound = 4,    // the harness failed a check of itself
  exit_collision = 5,  // with --fail-on-collision: agreement, and a collision
};

}  // namespace assay::reports
