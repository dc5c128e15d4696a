// Subjects on families of cases: each case is played by each subject in turn and judged by the
// oracle, and times stand beside errors, summed by family and by subject.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "oracle/mesh/step.h"
#include "properties/judging/step_errors.h"
#include "reports/bench/cases.h"
#include "reports/bench/compared/subjects.h"
#include "reports/bench/sweep.h"
#include "reports/estimate.h"

namespace assay::reports {

// What was counted of answers that the oracle judged.
struct JudgedCounts {
  properties::StepErrors errors;       // of the steps that the contract takes
  std::uint64_t left_out = 0;          // steps that it does not take
  std::uint64_t confirmed = 0;         // of the unsafe ones: without the oracle (confirmation.h)
  std::uint64_t timed_collisions = 0;  // collisions with another first time than [0, 1]

  JudgedCounts& operator+=(const JudgedCounts& other);
};

// A step whose answer was unsafe.
struct UnsafeAnswer {
  std::string subject, case_id;
  std::size_t step = 0;  // number among the steps that the contract takes
  std::string defect;    // "missed", "late", "pairs missing"
  bool is_confirmed = false;
};

// One subject on one family.
struct FamilyRow {
  std::string subject, family, kind;
  JudgedCounts counts = {};
  std::uint64_t triangles_of_case = 0;     // of the last one
  std::uint64_t steps = 0, triangles = 0;  // sums over all steps that have results
  std::uint64_t box_tests = 0, candidates = 0, elementary_tests = 0;
  std::uint64_t hash = 0xcbf29ce484222325u;  // over the results of all steps, in order
  // Sums over the cases that were timed, one sample for each round: the time of the subject, and
  // that of the reference, the first subject, on the same steps.
  std::vector<double> ms = {}, reference_ms = {}, create_ms = {}, reference_create_ms = {};
  std::uint64_t cases = 0, cases_timed = 0, steps_timed = 0;
  std::uint64_t slow = 0;                // cases run once, because a step took so long
  std::uint64_t ended = 0;               // cases whose run ended early
  std::string first_end = {};            // how the first of these ended
  std::vector<std::string> broken = {};  // claims, each once

  std::optional<Estimate> over() const;  // over the reference, round by round
  std::optional<double> create_over() const;
};

// A share of steps, with its interval of Clopper and Pearson, 95 %.
struct ShareOfSteps {
  double share = 0, lo = 0, hi = 0;
  bool on_pareto_line = false;  // nothing else is as fast and better
};
ShareOfSteps share_of(std::size_t part, std::size_t all);

// One subject on everything.
struct SubjectRow {
  const BenchSubject* subject = nullptr;
  std::string answers = {};                // what it answers at all: "answer, time, pairs"
  std::optional<Estimate> over = {};       // median of families, interval by drawing families
  std::optional<double> create_over = {};  // median of families
  std::uint64_t families = 0;              // that have times
  JudgedCounts counts = {};
  std::uint64_t slow = 0, ended = 0;
  ShareOfSteps unsafe = {}, alarming = {};  // of the judged steps
  std::optional<double> bytes_a_triangle = {};
};

// In the order of the subjects; those that took part in nothing are left out. Of subjects in this
// process those that are asked for the same pairs have a Pareto line for each error, without
// culling none, which only the smallest meshes are run with.
std::vector<SubjectRow> by_subject(std::span<const FamilyRow> families,
                                   const std::vector<BenchSubject>& subjects);

struct ComparisonLimits {
  double small_seconds = 10;    // processor time of a worker's run of a generated or hard case
  double large_seconds = 60;    // of a scene or a public sequence
  double longest_repeated = 5;  // seconds: a case with a longer step is run once
  int jobs = 1;                 // threads of the oracle
};

// The first subject is the reference.
class Comparison {
 public:
  // The references must outlive this object. Wrong answers, and a line of the CSV for each step
  // and subject, go into the report.
  Comparison(
      const std::vector<BenchSubject>& subjects, const ComparisonLimits& limits,
      BenchReport& report, std::function<void()> tick = [] {});

  // Runs all cases of the family, and adds a row for each subject that had one. A subject is given
  // the steps that its contract takes, and the reference is given the same. If steps were left
  // out, nobody vouches for the start of the others. Culling none takes part up to 64 triangles.
  // The times of a run that ended early count for nothing, and its steps are undecided.
  void run(const CaseFamily& family);

  const std::vector<FamilyRow>& rows() const { return rows_; }
  const std::vector<UnsafeAnswer>& unsafe() const { return unsafe_; }

 private:
  struct Group;
  std::vector<Group> groups_of(const corpus::Case& c) const;
  void run_group(const CaseFamily& family, const TimedCase& timed, const Group& group,
                 std::vector<FamilyRow>& rows);
  void judge(const corpus::Case& c, const SweptRuns& runs,
             const std::vector<oracle::StepJudgement>& truth, const BenchSubject& subject,
             FamilyRow& row);

  const std::vector<BenchSubject>& subjects_;
  const ComparisonLimits limits_;
  BenchReport& report_;
  const std::function<void()> tick_;
  std::map<std::pair<std::size_t, bool>, properties::WorkerProcess> workers_;  // if not here
  std::vector<FamilyRow> rows_;
  std::vector<UnsafeAnswer> unsafe_;
};

// The counts of one case. `seen` is the case as the contract has it, `run` the first of its runs.
// Adds to `unsafe`, if it is given, and confirms what is unsafe. Adds the errors of each step.
JudgedCounts counts_of(const BenchSubject& subject, const corpus::Case& seen,
                       const properties::CaseRun& run,
                       const std::vector<oracle::StepJudgement>& truth,
                       std::vector<UnsafeAnswer>* unsafe,
                       std::vector<properties::StepErrors>* of_steps = nullptr);

}  // namespace assay::reports
