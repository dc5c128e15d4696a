// Asks the oracle for `check`, within the user's limits, and measures the time that it takes.
#pragma once

#include <optional>

#include "oracle/mesh/step.h"
#include "oracle/referee/second_opinion.h"
#include "reports/terminal/limits.h"

namespace assay::reports {

template <class Answer>
struct Timed {
  Answer answer;
  double milliseconds = 0;  // wall clock
};

class TimedOracle {
 public:
  // Judges in `jobs` threads. If memory fails, the limits remember it and the answer is not
  // complete.
  TimedOracle(int jobs, oracle::AskedFeatures asked, Limits& limits)
      : jobs_(jobs), asked_(asked), limits_(limits) {}

  Timed<oracle::StepJudgement> judge(const detector::Positions& x_t0,
                                     const detector::Positions& x_t1,
                                     const detector::Triangles& triangles,
                                     const detector::StopFunction& stop) const;

  // Asks other methods this share of the questions behind a judgement.
  Timed<oracle::SecondOpinion> second_opinion(const detector::Positions& x_t0,
                                              const detector::Positions& x_t1,
                                              const detector::Triangles& triangles,
                                              const oracle::StepJudgement& judgement, double share,
                                              const detector::StopFunction& stop) const;

 private:
  int jobs_;
  oracle::AskedFeatures asked_;
  Limits& limits_;
};

}  // namespace assay::reports
