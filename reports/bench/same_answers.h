// Two exact cullings asked for all pairs of one step must find the same.
#pragma once

#include <string>

#include "detector/options.h"
#include "detector/step_result.h"
#include "reports/bench/bench_report.h"

namespace assay::reports {

// Compares answers, pairs and their times. A difference is a wrong answer in the report.
inline void check_same_pairs(const std::string& name, const detector::StepResult& a,
                             const detector::StepResult& b, BenchReport& report) {
  bool same = a.pairs.size() == b.pairs.size() && a.answer == b.answer && a.first == b.first;
  for (std::size_t i = 0; same && i < a.pairs.size(); ++i) {
    same = a.pairs[i].pair == b.pairs[i].pair && a.pairs[i].time == b.pairs[i].time;
  }
  if (!same) report.wrong_answers.push_back(name + ": two cullings find different pairs");
}

}  // namespace assay::reports
