// Subjects over sources of cases: each case is played by each subject in turn and judged by the
// oracle, and times stand beside errors, summed by family and by subject. All suites of `assay
// bench` are calls of it. Each takes at most five minutes at its default size on one core, all of
// them together twenty. What a suite comes to stands first.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/hard/hard_families.h"
#include "detector/options.h"
#include "oracle/mesh/step.h"
#include "properties/changes/changes.h"
#include "properties/judging/step_measures.h"
#include "properties/judging/subject.h"
#include "reports/bench/cases.h"
#include "reports/bench/sweep.h"

namespace assay::reports {

// The result of a suite of benches: rows, wrong answers, and what else a suite tells, in forms that
// do not depend on the suite. It is written as text, as JSON (schema assay-bench/2,
// reports/schemas/bench.schema.json) and as CSV, each in one way.

// What the suites of `assay bench` want to see: ratios. Suites hand these values to their rows; the
// comments below say to which.
//
// Only a bound that somebody chose has a name here. The others stand in their rows: no wrong
// answer (at_most(0)), every answer the same (at_least(100) %).

// What a row is held against.
struct Goal {
  bool is_most;  // else it is the least
  double bound;
};
constexpr Goal at_most(double bound) { return {true, bound}; }
constexpr Goal at_least(double bound) { return {false, bound}; }
inline std::optional<Goal> goal_if(bool condition, Goal goal) {
  return condition ? std::optional(goal) : std::nullopt;
}

namespace goal {

// The whole step of any mesh. view-auto falls back to bvh if views do not pay, so it may lose only
// what it takes to find that out.
inline constexpr Goal view_auto_over_bvh = at_most(1.05);
inline constexpr Goal exact_over_double = at_most(1.3);

// Whole sequences with culling auto, over the one culling that takes the least for the whole of
// each sequence: the ratio of the sums, of the median steps, and of any step of a millisecond or
// more. Then a first step over that of bvh, whose pairs it has to look at; and one thread over
// two.
inline constexpr Goal auto_over_best_culling = at_most(1.05);
inline constexpr Goal auto_step_over_best_culling = at_most(1.15);
inline constexpr Goal first_step_over_bvh = at_most(1.1);
inline constexpr Goal two_threads_gain = at_least(1.8);

}  // namespace goal

struct BenchRow {
  std::string label;
  std::string unit;                  // "ns", "times", "%", ...; may be empty
  std::optional<Estimate> estimate;  // none: no data
  std::optional<Goal> goal;          // none: for information
  std::string note;                  // may be empty

  // "holds", "fails", "no data", or "-" if nothing is wanted. Decided by the median alone; the
  // interval shows how far that can be trusted.
  const char* outcome() const;
};

struct BenchReport {
  std::string suite = {};
  std::vector<BenchRow> rows = {};
  // One line for each wrong answer. Any of them fails the run, because times are noisy but answers
  // are not.
  std::vector<std::string> wrong_answers = {};
  std::string above = {}, below = {};  // tables of the suite, above and below the rows
  // The fields that the suite adds to the JSON, by name: lists of objects, but for `detector`.
  std::map<std::string, nlohmann::ordered_json, std::less<>> figures = {};
  // The suite's own CSV: the names of its columns, and its lines with the number of columns that
  // each has; the others of a line are empty. No lines: the CSV is of the samples of the rows.
  std::vector<std::string> columns = {};
  std::vector<std::pair<std::size_t, std::string>> samples = {};

  void add(std::string label, std::string unit, Estimate estimate,
           std::optional<Goal> goal = std::nullopt, std::string note = {});
  // Adds a row that says that the folder or file `missing` is not there.
  void add_no_data(std::string label, const std::string& missing);
  // Adds a line to `samples`. A field that is an object itself has a column for each of its own
  // fields ("late_steps"). Numbers of a list are separated by blanks; other lists are left out.
  void add_sample(const nlohmann::ordered_json& object);
  // Adds a row without a measurement. `why` is its note, such as "left out: ...".
  void add_left_out(std::string label, std::string why);
};

std::string text_of(const Goal& goal);

// A word of a table, the heading of its column, and the width that it fills. A word ends at the
// right of its column, or begins at the left if the width is below 0. The last column has width 0
// or above; where its word is empty, the line ends before it.
struct Column {
  std::string heading;
  int width;
  std::string word;
};

// The headings of the first row, and all rows, a line each, with `gap` blanks between columns.
// Nothing without rows.
std::string table_text(const std::vector<std::vector<Column>>& rows, int gap = 1);

// "2: 0.01": in how many steps first times are off, and by which share of a step at worst.
std::string text_of(const properties::TimesOff& off);

// What stands above the rows; the rows as a table, one line each; what stands below them; the
// wrong answers.
std::string text_of(const BenchReport& report);
// `version` is that of the program.
nlohmann::ordered_json to_json(const BenchReport& report, const std::string& version);
// One line for each sample.
std::string csv_of(const BenchReport& report);

// {median, interval, samples}
void to_json(nlohmann::ordered_json& json, const Estimate& estimate);

// An object with these fields: a name and its value in turn. What is not there is null.
template <class T, class... Rest>
nlohmann::ordered_json json_object(const char* name, const T& value, const Rest&... rest) {
  nlohmann::ordered_json json;
  if constexpr (requires { value.has_value(); })
    json[name] = value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
  else
    json[name] = value;
  if constexpr (sizeof...(rest) > 0) json.update(json_object(rest...));
  return json;
}

// Who is compared: the built-in detector by its options, in this process or in a worker, and
// plug-ins.
struct BenchSubject : properties::Subject {
  std::string name = {};
  detector::Options options = {};  // of the built-in detector; the start is the case's
  bool is_here = false;            // it runs in this process
  MakeStages stages = detector::standard_stages;  // in this process
  bool is_vouched_for = true;  // nobody verifies the start of a case that is known to be clean
  bool must_hold = true;       // a claim that it breaks is a wrong answer of the suite
  // The claims by which its errors are counted. Every form of the built-in detector is asked for
  // what exact arithmetic claims, so that the errors of all forms are seen: otherwise doubles,
  // which claim no pair, could miss none. A plug-in is asked for what it claims.
  properties::Claims error_claims = {};
  // The contract by which it is given steps, if that is not its own.
  std::optional<properties::Contract> contract_of_input = std::nullopt;

  const properties::Contract& contract_of_steps() const {
    return contract_of_input ? *contract_of_input : detector.contract;
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
  std::uint64_t slow = 0;              // cases run once, because a step took so long
  std::uint64_t ended = 0;             // cases whose run ended early

  JudgedCounts& operator+=(const JudgedCounts& other) {
    return properties::add_fields(*this, other);
  }
};
ASSAY_FIELDS(JudgedCounts, errors, left_out, confirmed, timed_collisions, slow, ended)

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
  std::uint64_t hash = first_hash;  // over the results of all steps, in order
  // Sums over the cases that were timed, one sample for each round: the time of the subject, and
  // that of the reference, the first subject, on the same steps.
  std::vector<double> ms = {}, reference_ms = {}, create_ms = {}, reference_create_ms = {};
  std::uint64_t cases = 0, cases_timed = 0, steps_timed = 0;
  std::string first_end = {};              // how the first ended that ended early
  std::vector<std::string> breaches = {};  // claims, each once

  std::optional<Estimate> over() const;  // over the reference, round by round
  std::optional<double> create_over() const;
};

// A share of steps, with its interval of Clopper and Pearson, 95 %.
struct ShareOfSteps {
  double share = 0, lo = 0, hi = 0;
  bool on_pareto_line = false;  // nothing else is as fast and better
};

// One subject on everything.
struct SubjectRow {
  const BenchSubject* subject = nullptr;
  std::string answers = {};                // what it answers at all: "answer, time, pairs"
  std::optional<Estimate> over = {};       // median of families, interval by drawing families
  std::optional<double> create_over = {};  // median of families
  std::uint64_t families = 0;              // that have times
  JudgedCounts counts = {};
  ShareOfSteps unsafe = {}, alarming = {};  // of the judged steps
  std::optional<double> bytes_a_triangle = {};
};

// In the order of the subjects; those that took part in nothing are left out. Of subjects in this
// process those that are asked for the same pairs have a Pareto line for each error, without
// culling none, which only the smallest meshes are run with.
std::vector<SubjectRow> by_subject(std::span<const FamilyRow> families,
                                   const std::vector<BenchSubject>& subjects);

// A case that subjects have played who are asked the same question.
struct Match {
  const corpus::Case& c;  // as the contract of the subjects has it
  std::vector<SweptSubject> subjects = {};
  std::vector<SweptRuns> runs = {};
  // If anything is judged: what the oracle says of each step; and by subject, the errors of the
  // first run, and its outcome by the claims by which these are counted, and by its own.
  std::vector<oracle::StepJudgement> truth = {};
  struct Verdict {
    properties::StepErrors errors = {};
    properties::Outcome outcome = properties::Outcome::holds, own = properties::Outcome::holds;
  };
  std::vector<Verdict> verdicts = {};
};

struct ComparisonPlan {
  SweepPlan sweep = {};       // the rounds are those of the families
  double small_seconds = 10;  // processor time of a worker's run of a generated or hard case
  double large_seconds = 60;  // of a scene or a public sequence
  int jobs = 1;               // threads of the oracle
  bool is_judged = true;      // else cases are played and timed alone
  // What a suite does with each case beside what all have.
  std::function<void(const Match&)> on_case = [](const Match&) {};
};

// What a suite tells while it runs: what it turns to, and that it is alive. `tick` is called often.
struct BenchProgress {
  std::function<void(const std::string& name)> phase = [](const std::string&) {};
  std::function<void()> tick = [] {};
};

// The first subject is the reference.
class Comparison {
 public:
  // The references must outlive this object. Wrong answers, and a line of the CSV for each step
  // and subject, go into the report.
  Comparison(const std::vector<BenchSubject>& subjects, ComparisonPlan plan, BenchReport& report,
             const BenchProgress& progress = {});

  // Runs all cases of the families, and adds a row for each family and subject that had one. A
  // subject is given the steps that its contract takes, and the reference is given the same. If
  // steps were left out, nobody vouches for the start of the others. Culling none takes part up to
  // 64 triangles. The times of a run that ended early count for nothing, and its steps are
  // undecided.
  void run(const std::vector<CaseFamily>& families);

  const std::vector<FamilyRow>& rows() const { return rows_; }
  const std::vector<UnsafeAnswer>& unsafe() const { return unsafe_; }
  std::vector<SubjectRow> subjects() const { return by_subject(rows_, subjects_); }

 private:
  struct Group;
  std::vector<Group> groups_of(const corpus::Case& c, std::vector<FamilyRow>& rows) const;
  void run_group(const CaseFamily& family, const BenchCase& entry, const Group& group,
                 std::vector<FamilyRow>& rows);
  Match::Verdict judge(const Match& match, const SweptRuns& runs, const BenchSubject& subject,
                       FamilyRow& row);

  const std::vector<BenchSubject>& subjects_;
  const ComparisonPlan plan_;
  BenchReport& report_;
  const BenchProgress progress_;
  // By subject: for small cases, and for large ones. They are started where they are needed.
  std::vector<std::array<properties::WorkerProcess, 2>> workers_;
  std::vector<FamilyRow> rows_;
  std::vector<UnsafeAnswer> unsafe_;
};

// Whether another method shows that step s has a contact that was missed or met too late, or one
// of the pairs that are missing. If any time of the step will do, this is the referee (a proof
// without roots). Otherwise it is rational arithmetic at a witness: a time before the one that the
// detector told at which the two features meet or, if the contract asks for all features, their
// two triangles; or two times between which the features are proved to meet
// (oracle/referee/referee.h). REQUIRES an unsafe diff of that step.
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

// The suites.

using RunSuite = BenchReport(const BenchSettings& settings, const BenchProgress& progress);

// Where each arithmetic breaks, in the corpus's hard families.
RunSuite stability_suite;
// Every arithmetic, culling and kind of pairs on the same steps: time, and error against the
// oracle.
RunSuite speed_error_suite;
// Whole sequences by each culling and by several threads: what the default costs beside the best
// choice.
RunSuite sequences_suite;
// Those detectors of others that are there, beside the built-in one: time and error.
RunSuite peers_suite;

// Times a plug-in beside the built-in detector, on the same steps of scenes and public sequences:
// each in a worker of its own, in turn, a whole sequence each time. The built-in detector answers
// what the plug-in claims. A claim that either breaks is a wrong answer. With a scale below 1,
// public sequences of more than 10,000 triangles are left out. REQUIRES a plug-in that has steps.
// `limits.seconds` of it is the processor time that one run of a sequence may take.
BenchReport detector_suite(const BenchSettings& settings, const properties::Subject& plugin,
                           const BenchProgress& progress);

// Suite `stability` over any families and subjects in this process, so that tests can hand in wrong
// ones. The rows are family by family and subject by subject. These are wrong answers: an exact
// subject that is wrong, a bounded one that is refuted, and an oracle that contradicts a
// construction.
BenchReport stability_of(std::span<const corpus::HardFamily> families,
                         const std::vector<BenchSubject>& subjects, const BenchSettings& settings,
                         const BenchProgress& progress);
// exact, bounded, double, float: each plays a case with the culling and the view primitive that it
// states, or else with view-point.
std::vector<BenchSubject> all_arithmetics();

// Changes of a hard case that must not change its answer, by their names: permutation (of vertices,
// triangles, first corners), mirror (with all triangles turned, so that outside stays outside),
// power of two (up or down, by the case's id), and translation (as far as it can be exact). The
// case's view primitive is changed with it, and its facts stay as they were. There is no form if a
// coordinate would be rounded.
using MakeForm = std::optional<properties::Form> (*)(const corpus::Case&);
std::span<const std::pair<const char*, MakeForm>> case_changes();

}  // namespace assay::reports
