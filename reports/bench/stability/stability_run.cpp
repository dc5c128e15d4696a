#include "reports/bench/stability/stability_run.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/view/view_sign.h"
#include "properties/judging/case_check.h"
#include "properties/worker/case_player.h"
#include "reports/bench/judged_step.h"

namespace assay::reports {

using detector::Answer;
using detector::StepResult;
using detector::ViewSign;

std::vector<StabilitySubject> all_arithmetics() {
  std::vector<StabilitySubject> subjects;
  for (const auto arithmetic : every_arithmetic) {
    subjects.push_back({properties::name_of(arithmetic), arithmetic});
  }
  return subjects;
}

StepResult run_hard_case(const corpus::Case& c, const StabilitySubject& subject) {
  detector::Options options = properties::options_of(c);
  if (!c.options.contains("culling")) options.culling = detector::Culling::view_point;
  options.arithmetic = subject.arithmetic;
  auto made = properties::CasePlayer::make(c, options, subject.stages(options));
  if (!made) {
    StepResult refused;
    refused.problem = made.error();
    return refused;
  }
  return made.value().look(0);
}

HardTruth::HardTruth(const corpus::Case& c)
    : case_(c), judgement_(oracle::judge_step({c.frames[0], c.frames[1]}, c.triangles, {})) {
  component_of_triangle_ =
      detector::make_topology(c.triangles, c.frames[0].rows()).component_of_triangle;
}

bool HardTruth::agrees_with_construction() const {
  const auto& known = case_.expected.steps.front();
  if (judgement_.answer != known.answer) return false;
  if (known.first_time && judgement_.first != *known.first_time) return false;
  if (!known.view_signs) return true;
  const auto view = corpus::view_of_step(case_, 0);
  return oracle::view_signs({case_.frames[0], case_.frames[1]}, case_.triangles, {&*view, 1}, 1) ==
         *known.view_signs;
}

const std::vector<ViewSign>& HardTruth::signs(const StepResult& result) {
  const auto same_place = [](const detector::ViewPrimitive& a, const detector::ViewPrimitive& b) {
    return a.q0.t0 == b.q0.t0 && a.q0.t1 == b.q0.t1 && a.q1.t0 == b.q1.t0 && a.q1.t1 == b.q1.t1;
  };
  const auto& from = result.primitives;
  if (!signs_.empty() &&
      std::equal(from.begin(), from.end(), seen_from_.begin(), seen_from_.end(), same_place)) {
    return signs_;
  }
  seen_from_ = from;
  std::vector<detector::ViewPrimitive> of_triangle;
  for (const auto component : component_of_triangle_) {
    of_triangle.push_back(from[static_cast<std::size_t>(component)]);
  }
  signs_ = oracle::view_signs({case_.frames[0], case_.frames[1]}, case_.triangles, of_triangle, 1);
  return signs_;
}

namespace {

double ulp_of(double t) { return std::nextafter(t, 2) - t; }

// t* is lo if lo == hi, else it lies between the two. So an error is measured from the nearer end.
void judge_first_time(const detector::TimeEnclosure& ours, const detector::TimeEnclosure& truth,
                      HardOutcome& outcome) {
  outcome.late = ours.lo > truth.lo;
  outcome.early = ours.hi < truth.hi;
  if (outcome.late) outcome.time_error = std::max(0., ours.lo - truth.hi);
  if (outcome.early) outcome.time_error = -std::max(0., truth.lo - ours.hi);
  outcome.time_error_ulps = outcome.time_error / ulp_of(std::max(ours.lo, truth.lo));
}

void judge_pairs(const StepResult& result, const oracle::StepJudgement& truth,
                 HardOutcome& outcome) {
  auto ours = result.pairs.begin();
  auto theirs = truth.pairs.begin();
  while (ours != result.pairs.end() || theirs != truth.pairs.end()) {
    if (theirs == truth.pairs.end() || (ours != result.pairs.end() && ours->pair < theirs->pair)) {
      outcome.spurious = true;
      ++ours;
    } else if (ours == result.pairs.end() || theirs->pair < ours->pair) {
      outcome.missed = true;
      ++theirs;
    } else {
      outcome.exactly_right &= ours->time == theirs->time;
      outcome.late |= ours->time.lo > theirs->time.lo;
      ++ours;
      ++theirs;
    }
  }
}

}  // namespace

HardOutcome judge_hard_case(const StepResult& result, HardTruth& truth) {
  HardOutcome outcome;
  const auto& judged = truth.judgement();
  const bool contact = judged.answer == Answer::collision;
  if (result.answer != Answer::free && result.answer != Answer::collision) {
    outcome.missed = contact;
    return outcome;
  }
  const bool collision = result.answer == Answer::collision;
  outcome.exactly_right = true;
  outcome.missed = contact && !collision;
  outcome.spurious = collision && !contact;
  if (contact && collision) judge_first_time(result.first, judged.first, outcome);
  outcome.exactly_right &= !collision || result.first == judged.first;
  judge_pairs(result, judged, outcome);
  if (!result.signs.empty()) {
    const auto& signs = truth.signs(result);
    for (std::size_t t = 0; t < signs.size(); ++t) {
      outcome.exactly_right &= result.signs[t] == signs[t];
      outcome.wrong_signs |= result.signs[t] != signs[t] && result.signs[t] != ViewSign::zero;
    }
  }
  outcome.right =
      !outcome.missed && !outcome.spurious && !(outcome.wrong_signs && truth.gives_view());
  outcome.exactly_right &= outcome.right;
  return outcome;
}

}  // namespace assay::reports
