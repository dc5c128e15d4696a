#include "reports/bench/compared/comparison.h"

#include <fmt/format.h>

#include <algorithm>

#include "properties/campaign/ledger/step_measures.h"
#include "properties/judging/contracted_case.h"
#include "properties/judging/judged_run.h"

namespace assay::reports {

using detector::Culling;
using properties::Outcome;

JudgedCounts& JudgedCounts::operator+=(const JudgedCounts& other) {
  return properties::add_fields(*this, other);
}

std::optional<Estimate> FamilyRow::over() const {
  return cases_timed > 0 ? std::optional(bootstrap_ratio(ms, reference_ms)) : std::nullopt;
}

std::optional<double> FamilyRow::create_over() const {
  return cases_timed > 0 && reference_create_ms.back() > 0
             ? std::optional(ratio_of(create_ms, reference_create_ms).value)
             : std::nullopt;
}

// Subjects that are asked the same question: the same steps, and the same features in them.
struct Comparison::Group {
  corpus::Case c;
  properties::Contract contract;  // that of the first subject
  std::vector<std::size_t> subjects;
  std::uint64_t left_out = 0;
};

namespace {

bool same_steps(const corpus::Case& a, const corpus::Case& b) {
  const auto *counted = corpus::counted_of(a), *other = corpus::counted_of(b);
  return a.frames == b.frames && corpus::steps_of(a) == corpus::steps_of(b) &&
         (counted && other ? *counted == *other : counted == other);
}

// Whether one judgement of the oracle serves both contracts.
bool asks_alike(const properties::Contract& a, const properties::Contract& b) {
  const auto judged_slack = [](const auto& c) { return c.judges_alarms() ? c.margin : 0; };
  return a.features == b.features && a.counts == b.counts && a.rings == b.rings &&
         a.rest_distance == b.rest_distance && a.separation == b.separation &&
         judged_slack(a) == judged_slack(b);
}

bool takes_part(const BenchSubject& subject, const corpus::Case& c) {
  constexpr Eigen::Index most_triangles_for_none = 64;
  return subject.options.culling != Culling::none || c.triangles.rows() <= most_triangles_for_none;
}

void add(std::vector<double>& sums, const std::vector<double>& values) {
  sums.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) sums[i] += values[i];
}

}  // namespace

Comparison::Comparison(const std::vector<BenchSubject>& subjects, const ComparisonLimits& limits,
                       BenchReport& report, std::function<void()> tick)
    : subjects_(subjects), limits_(limits), report_(report), tick_(std::move(tick)) {
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    if (subjects[i].is_here) continue;
    workers_.emplace(std::pair(i, false), subjects[i].make_worker(limits.small_seconds));
    workers_.emplace(std::pair(i, true), subjects[i].make_worker(limits.large_seconds));
  }
}

std::vector<Comparison::Group> Comparison::groups_of(const corpus::Case& c) const {
  std::vector<Group> groups;
  const auto planned = corpus::steps_of(c).size();
  for (std::size_t i = 0; i < subjects_.size(); ++i) {
    if (!takes_part(subjects_[i], c)) continue;
    const auto& contract = subjects_[i].contract_of_steps();
    auto seen = properties::contracted(c, contract);
    if (!seen) continue;
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
      return asks_alike(group.contract, contract) && same_steps(group.c, *seen);
    });
    if (same != groups.end()) {
      same->subjects.push_back(i);
      continue;
    }
    const auto left_out = planned - corpus::steps_of(*seen).size();
    groups.push_back({std::move(*seen), contract, {i}, left_out});
  }
  return groups;
}

void Comparison::run(const CaseFamily& family) {
  std::vector<FamilyRow> rows;
  for (const auto& subject : subjects_) rows.push_back({subject.name, family.name, family.kind});
  for (const auto& timed : family.cases()) {
    const auto groups = groups_of(timed.c);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (!takes_part(subjects_[i], timed.c)) continue;
      ++rows[i].cases;
      rows[i].triangles_of_case = static_cast<std::uint64_t>(timed.c.triangles.rows());
      const bool is_taken = std::any_of(groups.begin(), groups.end(), [&](const Group& group) {
        return std::count(group.subjects.begin(), group.subjects.end(), i) > 0;
      });
      if (!is_taken) rows[i].counts.left_out += corpus::steps_of(timed.c).size();
    }
    for (const auto& group : groups) run_group(family, timed, group, rows);
  }
  for (auto& row : rows) {
    if (row.cases > 0) rows_.push_back(std::move(row));
  }
}

void Comparison::run_group(const CaseFamily& family, const TimedCase& timed, const Group& group,
                           std::vector<FamilyRow>& rows) {
  const bool has_reference = group.subjects.front() == 0;
  std::vector<std::size_t> places = group.subjects;
  if (!has_reference) places.insert(places.begin(), 0);
  std::vector<SweptSubject> swept;
  for (const std::size_t i : places) {
    auto options = subjects_[i].options;
    // A gap in the sequence makes a new start, and nobody says that it is clean.
    options.start = group.left_out == 0 && subjects_[i].is_vouched_for ? timed.start
                                                                       : detector::Start::verified;
    const auto worker = workers_.find(std::pair(i, family.is_large()));
    swept.push_back({worker == workers_.end() ? nullptr : &worker->second,
                     {subjects_[i].name, options, {}, true}});
  }
  const auto runs = sweep(group.c, swept,
                          {.rounds = family.rounds,
                           .is_warm = true,
                           .longest_repeated = limits_.longest_repeated,
                           .tick = tick_});
  tick_();
  const auto truth = properties::judge_case(group.c, group.contract, limits_.jobs);
  for (std::size_t k = has_reference ? 0 : 1; k < places.size(); ++k) {
    auto& row = rows[places[k]];
    row.slow += runs[k].is_once ? 1 : 0;
    row.ended += runs[k].ended.empty() ? 0 : 1;
    if (row.first_end.empty() && !runs[k].ended.empty())
      row.first_end = timed.c.id + ": " + runs[k].ended;
    row.counts.left_out += group.left_out;
    judge(group.c, runs[k], truth, subjects_[places[k]], row);
    if (!runs[k].ended.empty() || !runs[0].ended.empty()) continue;
    ++row.cases_timed;
    row.steps_timed += truth.size();
    add(row.ms, runs[k].sums());
    add(row.reference_ms, runs[0].sums());
    add(row.create_ms, runs[k].create_ms());
    add(row.reference_create_ms, runs[0].create_ms());
  }
}

JudgedCounts counts_of(const BenchSubject& subject, const corpus::Case& seen,
                       const properties::CaseRun& run,
                       const std::vector<oracle::StepJudgement>& truth,
                       std::vector<UnsafeAnswer>* unsafe,
                       std::vector<properties::StepErrors>* of_steps) {
  JudgedCounts counts;
  const auto verdict = judge_run(seen, run, truth, subject.counted, subject.detector.contract);
  // A run that broke off has no steps.
  if (verdict.steps.empty()) counts.errors.steps = counts.errors.undecided = truth.size();
  for (std::size_t s = 0; s < verdict.steps.size(); ++s) {
    const auto& diff = verdict.steps[s];
    const auto& result = run.steps[s];
    const auto errors = errors_of(diff);
    counts.errors += errors;
    if (of_steps) of_steps->push_back(errors);
    const bool is_timed = result.first.lo > 0 || result.first.hi < 1;
    counts.timed_collisions += result.answer == detector::Answer::collision && is_timed ? 1 : 0;
    if (errors.unsafe == 0 || !unsafe) continue;
    const bool confirmed = is_confirmed(seen, s, diff, result, subject.detector.contract);
    counts.confirmed += confirmed ? 1 : 0;
    const char* defect = diff.answered_free ? "missed" : diff.late_first ? "late" : "pairs missing";
    unsafe->push_back({subject.name, seen.id, s, defect, confirmed});
  }
  return counts;
}

void Comparison::judge(const corpus::Case& c, const SweptRuns& runs,
                       const std::vector<oracle::StepJudgement>& truth, const BenchSubject& subject,
                       FamilyRow& row) {
  const auto& run = *runs.first;
  std::vector<properties::StepErrors> errors;
  row.counts += counts_of(subject, c, run, truth, subject.is_here ? nullptr : &unsafe_, &errors);
  const auto own = judge_run(c, run, truth, subject.detector.claims, subject.detector.contract);
  std::vector<std::string> complaints;
  for (const auto claim : own.broken)
    complaints.push_back(fmt::format("breaks {}", name_of(claim)));
  const auto deterministic = properties::Claim::deterministic;
  if (runs.has_differing_runs && subject.detector.claims.has(deterministic))
    complaints.push_back(fmt::format("breaks {}", name_of(deterministic)));
  if (subject.detector.built_in && complaints.empty() && own.outcome != Outcome::holds)
    complaints.push_back(fmt::format("is {}", name_of(own.outcome)));
  const auto place = c.id == row.family ? c.id : fmt::format("{}, case {}", row.family, c.id);
  for (const auto& complaint : complaints) {
    if (subject.must_hold)
      report_.wrong_answers.push_back(fmt::format("{}: {} {}", place, subject.name, complaint));
    if (std::find(row.broken.begin(), row.broken.end(), complaint) == row.broken.end())
      row.broken.push_back(complaint);
  }
  const auto triangles = static_cast<std::uint64_t>(c.triangles.rows());
  for (std::size_t s = 0; s < errors.size(); ++s) {
    const auto hash = result_hash(run.steps[s]);
    const auto& search = run.steps[s].counts.search;
    const auto& narrow = run.steps[s].counts.narrow;
    ++row.steps;
    row.triangles += triangles;
    row.hash = (row.hash ^ hash) * 0x100000001b3u;
    row.box_tests += search.box_tests;
    row.candidates += search.candidate_pairs;
    row.elementary_tests += narrow.elementary_tests;
    report_.add_sample(json_object(
        "family", row.family, "kind", row.kind, "case", c.id, "step", s + 1, "triangles", triangles,
        "subject", subject.name, "hash", fmt::format("{:016x}", hash), "box_tests",
        search.box_tests, "candidates", search.candidate_pairs, "elementary_tests",
        narrow.elementary_tests, "errors", errors[s], "ms", runs.of_step(s)));
  }
}

ShareOfSteps share_of(std::size_t part, std::size_t all) {
  constexpr double risk_of_a_side = 0.025;
  ShareOfSteps out;
  if (all > 0) out.share = static_cast<double>(part) / static_cast<double>(all);
  out.hi = properties::upper_bound(part, all, risk_of_a_side);
  out.lo = 1 - properties::upper_bound(all - part, all, risk_of_a_side);
  return out;
}

namespace {

// Marks the subjects in this process with these pairs that no other one beats in speed and error at
// once: fastest first, each with a smaller share of errors than all that are faster.
void mark_pareto_line(std::vector<SubjectRow>& rows, detector::Pairs pairs,
                      ShareOfSteps SubjectRow::*error) {
  std::vector<SubjectRow*> sorted;
  for (auto& row : rows) {
    if (row.subject->is_here && row.over && row.subject->options.pairs == pairs &&
        row.subject->options.culling != Culling::none)
      sorted.push_back(&row);
  }
  std::sort(sorted.begin(), sorted.end(), [error](const auto* a, const auto* b) {
    return std::pair(a->over->value, (a->*error).share) <
           std::pair(b->over->value, (b->*error).share);
  });
  double least = 2;
  for (auto* row : sorted) {
    auto& share = row->*error;
    share.on_pareto_line = share.share < least;
    least = std::min(least, share.share);
  }
}

}  // namespace

std::vector<SubjectRow> by_subject(std::span<const FamilyRow> families,
                                   const std::vector<BenchSubject>& subjects) {
  std::vector<SubjectRow> rows;
  for (const auto& subject : subjects) {
    SubjectRow row{&subject};
    std::vector<double> over, create_over;
    bool has_part = false;
    for (const auto& family : families) {
      if (family.subject != subject.name) continue;
      has_part = true;
      row.counts += family.counts;
      row.slow += family.slow;
      row.ended += family.ended;
      if (const auto time = family.over()) over.push_back(time->value);
      if (const auto create = family.create_over()) create_over.push_back(*create);
    }
    if (!has_part) continue;
    row.families = over.size();
    row.answers = row.counts.timed_collisions > 0 ? "answer, time" : "answer";
    if (subject.detector.contract.reports_pairs) row.answers += ", pairs";
    if (!over.empty()) row.over = bootstrap_median(std::move(over));
    if (!create_over.empty()) row.create_over = median_of(std::move(create_over)).value;
    row.unsafe = share_of(row.counts.errors.unsafe, row.counts.errors.steps);
    row.alarming = share_of(row.counts.errors.alarming, row.counts.errors.steps);
    rows.push_back(std::move(row));
  }
  for (const auto pairs : all_values<detector::Pairs>) {
    mark_pareto_line(rows, pairs, &SubjectRow::unsafe);
    mark_pareto_line(rows, pairs, &SubjectRow::alarming);
  }
  return rows;
}

}  // namespace assay::reports
