#include "reports/bench/peers/peer_counts.h"

#include "reports/bench/peers/confirmation.h"

namespace assay::reports {
namespace {

using detector::Answer;

void count_step(const properties::StepDiff& diff, const detector::StepResult& result,
                PeerCounts& counts) {
  counts.contact += diff.first_contact ? 1 : 0;
  const bool has_answer = result.answer == Answer::free || result.answer == Answer::collision;
  counts.undecided += has_answer ? 0 : 1;
  counts.missed += diff.answered_free ? 1 : 0;
  counts.false_alarms += diff.answered_collision ? 1 : 0;
  counts.missing += diff.missing.size();
  counts.spurious += diff.spurious.size();
  if (result.answer != Answer::collision) return;
  counts.timed_collisions += result.first.lo > 0 || result.first.hi < 1 ? 1 : 0;
  if (!diff.first) return;
  const auto& off = diff.first->off;
  if (off.late > 0) counts.late.add(off.late);
  if (off.early > 0) counts.early.add(off.early);
}

bool is_unsafe(const PeerSubject& subject, const properties::StepDiff& diff) {
  const auto asked = subject.asked();
  const bool asked_for_pairs =
      asked.has(properties::Claim::all_pairs) || asked.has(properties::Claim::first_pairs);
  return diff.answered_free || diff.late_first || (asked_for_pairs && !diff.missing.empty());
}

}  // namespace

void PeerCounts::add(const PeerCounts& other) {
  for (const auto member :
       {&PeerCounts::steps, &PeerCounts::left_out, &PeerCounts::contact, &PeerCounts::undecided,
        &PeerCounts::unsafe, &PeerCounts::missed, &PeerCounts::confirmed, &PeerCounts::false_alarms,
        &PeerCounts::missing, &PeerCounts::spurious, &PeerCounts::timed_collisions})
    this->*member += other.*member;
  late.add(other.late);
  early.add(other.early);
}

PeerCounts counts_of(const PeerSubject& subject, const corpus::Case& seen,
                     const properties::CaseRun& run,
                     const std::vector<oracle::StepJudgement>& truth,
                     std::vector<UnsafeAnswer>& unsafe) {
  PeerCounts counts;
  counts.steps = truth.size();
  const auto verdict = judge_run(seen, run, truth, subject.asked(), subject.contract);
  if (verdict.steps.empty()) {
    counts.undecided = truth.size();
    for (const auto& step : truth) counts.contact += step.answer == Answer::collision ? 1 : 0;
    return counts;
  }
  for (std::size_t s = 0; s < verdict.steps.size(); ++s) {
    const auto& diff = verdict.steps[s];
    count_step(diff, run.steps[s], counts);
    if (!is_unsafe(subject, diff)) continue;
    const bool confirmed = is_confirmed(seen, s, diff, run.steps[s], subject.contract);
    ++counts.unsafe;
    counts.confirmed += confirmed ? 1 : 0;
    const char* defect = diff.answered_free ? "missed" : diff.late_first ? "late" : "pairs missing";
    unsafe.push_back({subject.name, seen.id, s, defect, confirmed});
  }
  return counts;
}

}  // namespace assay::reports
