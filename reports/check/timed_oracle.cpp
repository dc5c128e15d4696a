#include "reports/check/timed_oracle.h"

#include <chrono>
#include <new>

namespace assay::reports {
namespace {

// Returns what `ask` answers, or an empty answer if memory fails.
template <class Ask>
auto timed(Limits& limits, const Ask& ask) {
  const auto begin = std::chrono::steady_clock::now();
  Timed<decltype(ask())> timed;
  try {
    timed.answer = ask();
  } catch (const std::bad_alloc&) {
    limits.memory_failed();
  }
  timed.milliseconds =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  return timed;
}

}  // namespace

Timed<oracle::StepJudgement> TimedOracle::judge(const detector::Positions& x_t0,
                                                const detector::Positions& x_t1,
                                                const detector::Triangles& triangles,
                                                const detector::StopFunction& stop) const {
  return timed(limits_, [&] {
    return oracle::judge_step({x_t0, x_t1}, triangles, {jobs_, stop, asked_});
  });
}

Timed<oracle::SecondOpinion> TimedOracle::second_opinion(const detector::Positions& x_t0,
                                                         const detector::Positions& x_t1,
                                                         const detector::Triangles& triangles,
                                                         const oracle::StepJudgement& judgement,
                                                         double share,
                                                         const detector::StopFunction& stop) const {
  return timed(limits_, [&] {
    return oracle::second_opinion({x_t0, x_t1}, triangles, judgement, {share, jobs_, stop, {}});
  });
}

}  // namespace assay::reports
