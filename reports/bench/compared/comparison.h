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

#include "detector/options.h"
#include "oracle/mesh/step.h"
#include "properties/judging/step_errors.h"
#include "properties/judging/subject.h"
#include "reports/bench/cases.h"
#include "reports/bench/sweep.h"
#include "reports/estimate.h"

namespace assay::reports {

// Who is compared: the built-in detector by its options, in this process or in a worker, and
// plug-ins.
struct BenchSubject : properties::Subject {
  std::string name = {};
  detector::Options options = {};  // of the built-in detector; the start is the case's
  bool is_here = false;            // it runs in this process
  bool is_vouched_for = true;      // nobody verifies the start of a case that is known to be clean
  bool must_hold = true;           // a claim that it breaks is a wrong answer of the suite
  // The claims by which its errors are counted. Every form of the built-in detector is asked for
  // what exact arithmetic claims, so that the errors of all forms are seen: otherwise doubles,
  // which claim no pair, could miss none. A plug-in is asked for what it claims.
  properties::Claims counted = {};
  // The contract by which it is given steps, if that is not its own.
  std::optional<properties::Contract> given = std::nullopt;

  const properties::Contract& contract_of_steps() const {
    return given ? *given : detector.contract;
  }
  // A worker that runs it, not yet started.
  properties::WorkerProcess make_worker(double seconds) const;
};

// An assembly that a user may choose by options, in this process. "exact view-auto all" is a name.
BenchSubject variant_of(detector::Arithmetic arithmetic, detector::Culling culling,
                        detector::Pairs pairs);
// Every arithmetic with every culling, for all pairs and for first pairs; exact, bvh, all is the
// first.
std::vector<BenchSubject> all_variants();

// The built-in detector in a worker, "built-in, exact, bvh".
BenchSubject built_in_in_worker(const detector::Options& options);

// A detector that is known but cannot be run here.
struct AbsentPeer {
  std::string name, why;
};
struct Peers {
  std::vector<BenchSubject> subjects;  // the first is the built-in detector, exact, bvh
  std::vector<AbsentPeer> absent;
};
// The built-in detector in three arithmetics, and the peers in the folder: each library NAME.so, by
// name. A library that cannot be loaded, has no steps, or is asked for a distance and not for
// contact, is absent. So is a known peer whose library is not there; `why` says what it needs.
Peers find_peers(const std::string& folder);

// What was counted of answers that the oracle judged.
struct JudgedCounts {
  properties::StepErrors errors;       // of the steps that the contract takes
  std::uint64_t left_out = 0;          // steps that it does not take
  std::uint64_t confirmed = 0;         // of the unsafe ones: without the oracle (is_confirmed)
  std::uint64_t timed_collisions = 0;  // collisions with another first time than [0, 1]

  JudgedCounts& operator+=(const JudgedCounts& other);
};
ASSAY_FIELDS(JudgedCounts, errors, left_out, confirmed, timed_collisions)

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

// Whether another method shows that step s has a contact that was missed or met too late, or one
// of the pairs that are missing. If any time of the step will do, this is the referee (a proof
// without roots). Otherwise it is rational arithmetic at a witness: a time before the one that the
// detector told at which the two features meet or, if the contract asks for all features, their
// two triangles; or two times between which the features are proved to meet
// (oracle/referee/rational_bracket.h). REQUIRES an unsafe diff of that step.
bool is_confirmed(const corpus::Case& c, std::size_t s, const properties::StepDiff& diff,
                  const detector::StepResult& result, const properties::Contract& contract);

// A line for each subject: times beside errors. `heading` is that of their names. If workers took
// part, what the columns say stands below the table.
std::string subjects_text(std::span<const SubjectRow> rows, const std::string& heading);

// The runs that ended early; who is absent; and a line for each unsafe answer that only the oracle
// calls so.
std::string remarks_text(const Comparison& comparison, std::span<const AbsentPeer> absent);

// Adds `subjects`, `families` and `unsafe_answers`.
void add_figures(std::span<const SubjectRow> rows, const Comparison& comparison,
                 BenchReport& report);

}  // namespace assay::reports
