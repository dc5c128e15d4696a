// Compares subjects on sources of cases: each subject plays each case in turn, the oracle judges
// it, and times stand beside errors, summed by family and by subject. All suites of `assay bench`
// are such comparisons. At its default size, on one core, each takes at most five minutes, and all
// together twenty. The report of a suite stands first.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
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

// The result of a suite of benches: rows, wrong answers, and further figures, in forms that are the
// same for all suites. It is written as text, as JSON (schema assay-bench/2,
// reports/schemas/bench.schema.json) and as CSV, each in one way.

// The goals of the suites of `assay bench`, as ratios. Suites hand these values to their rows; the
// comments below name the rows.
//
// Only chosen bounds have a name here. Other goals stand in their rows: no wrong answer
// (at_most(0)), every answer the same (at_least(100) %).

// The goal of a row.
struct Goal {
  bool is_most;  // true: `bound` is the greatest allowed value; false: the least
  double bound;
};
constexpr Goal at_most(double bound) { return {true, bound}; }
constexpr Goal at_least(double bound) { return {false, bound}; }
inline std::optional<Goal> goal_if(bool condition, Goal goal) {
  return condition ? std::optional(goal) : std::nullopt;
}

namespace goal {

// For the time of whole steps of any mesh. view-auto falls back to bvh if views do not pay, so it
// loses only the time to find that out.
inline constexpr Goal view_auto_over_bvh = at_most(1.05);
inline constexpr Goal exact_over_double = at_most(1.3);

// For whole sequences with culling auto. The first two are ratios to the single culling that takes
// the least time for the sequence: the first for the sum and the median step, the second for the
// worst step of a millisecond or more. The third is the first step over the first step of bvh,
// which looks at the same pairs. The last is the time of one thread over the time of two.
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

  // Returns "holds", "fails", "no data", or "-" if there is no goal. The median alone decides; the
  // interval shows how far it can be trusted.
  const char* outcome() const;
};

struct BenchReport {
  std::string suite = {};
  std::vector<BenchRow> rows = {};
  // One line for each wrong answer. A single wrong answer fails the run: answers have no noise.
  std::vector<std::string> wrong_answers = {};
  std::string above = {}, below = {};  // tables of the suite, above and below the rows
  // The fields that the suite adds to the JSON, by name: lists of objects, except `detector`.
  std::map<std::string, nlohmann::ordered_json, std::less<>> figures = {};
  // The suite's own CSV: the names of its columns, and its lines, each with the number of columns
  // that it fills; the other columns of a line are empty. No lines: the CSV has the rows' samples.
  std::vector<std::string> columns = {};
  std::vector<std::pair<std::size_t, std::string>> samples = {};

  void add(std::string label, std::string unit, Estimate estimate,
           std::optional<Goal> goal = std::nullopt, std::string note = {});
  // Adds a row that says that the folder or file `missing` does not exist.
  void add_no_data(std::string label, const std::string& missing);
  // Adds a line to `samples`. A field that is an object has a column for each of its fields
  // ("late_steps"). Numbers of a list are separated by blanks; other lists are left out.
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

// Returns the headings of the first row, and all rows, a line each, with `gap` blanks between
// columns. Empty without rows.
std::string table_text(const std::vector<std::vector<Column>>& rows, int gap = 1);

// Returns "2: 0.01": the number of steps whose first times are off, and the worst error, as a share
// of a step.
std::string text_of(const properties::TimesOff& off);

// Returns the text above the rows, the rows as a table, one line each, the text below them, and the
// wrong answers.
std::string text_of(const BenchReport& report);
// Returns the report as JSON. `version` is that of the program.
nlohmann::ordered_json to_json(const BenchReport& report, const std::string& version);
// Returns one line for each sample.
std::string csv_of(const BenchReport& report);

// Writes {median, interval, samples}.
void to_json(nlohmann::ordered_json& json, const Estimate& estimate);

// Returns an object with these fields: names and values in turn. An empty optional becomes null.
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

// The subjects that are compared: the built-in detector by its options, in this process or in a
// worker, and plug-ins.
struct BenchSubject : properties::Subject {
  std::string name = {};
  detector::Options options = {};  // of the built-in detector; `start` is set by the case
  bool is_here = false;            // it runs in this process
  MakeStages stages = detector::standard_stages;  // in this process
  bool is_vouched_for = true;                     // known clean starts are not verified
  bool must_hold = true;                          // a broken claim is a wrong answer of the suite
  // The claims by which errors are counted. For every form of the built-in detector these are the
  // claims of exact arithmetic, so that all errors are counted: otherwise doubles, which claim no
  // pair, could miss none. For a plug-in these are its own claims.
  properties::Claims error_claims = {};
  // The contract by which the subject gets steps, if that is not its own.
  std::optional<properties::Contract> contract_of_input = std::nullopt;

  const properties::Contract& contract_of_steps() const {
    return contract_of_input ? *contract_of_input : detector.contract;
  }
  // Returns a worker that runs the subject, not yet started.
  properties::WorkerProcess make_worker(double seconds) const;
};

// Returns an assembly that a user may choose by options, named "exact view-auto all", in this
// process.
BenchSubject variant_of(detector::Arithmetic arithmetic, detector::Culling culling,
                        detector::Pairs pairs);
// Returns every arithmetic with every culling, for all pairs and for first pairs; exact, bvh, all
// is the first.
std::vector<BenchSubject> all_variants();

// Returns the built-in detector in a worker, "built-in, exact, bvh".
BenchSubject built_in_in_worker(const detector::Options& options);

// A detector that is known but cannot be run here.
struct AbsentPeer {
  std::string name, why;
};
struct Peers {
  std::vector<BenchSubject> subjects;  // the first is the built-in detector, exact, bvh
  std::vector<AbsentPeer> absent;
};
// Returns the built-in detector in three arithmetics, and the peers in the folder: each library
// NAME.so, by name. A library is absent if it cannot be loaded, has no steps, or answers about a
// distance in place of contact. A known peer without a library is absent too; `why` says its needs.
Peers find_peers(const std::string& folder);

// The counts of answers that the oracle judged.
struct JudgedCounts {
  properties::StepErrors errors;       // of the steps that the contract takes
  std::uint64_t left_out = 0;          // steps that the contract does not take
  std::uint64_t confirmed = 0;         // unsafe steps confirmed without the oracle (is_confirmed)
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

// The results of one subject on one family.
struct FamilyRow {
  std::string subject, family, kind;
  JudgedCounts counts = {};
  std::uint64_t triangles_of_case = 0;     // triangles of the last case
  std::uint64_t steps = 0, triangles = 0;  // sums over all steps that have results
  std::uint64_t box_tests = 0, candidates = 0, elementary_tests = 0;
  std::uint64_t hash = first_hash;  // over the results of all steps, in order
  // Sums over the timed cases, one sample for each round: the times of the subject and of the
  // reference (the first subject) on the same steps.
  std::vector<double> ms = {}, reference_ms = {}, create_ms = {}, reference_create_ms = {};
  std::uint64_t cases = 0, cases_timed = 0, steps_timed = 0;
  std::string first_end = {};              // of the first run that stopped early: "CASE: cause"
  std::vector<std::string> breaches = {};  // broken claims, each once

  std::optional<Estimate> over() const;  // ratio to the reference, round by round
  std::optional<double> create_over() const;
};

// A share of steps, with its interval of Clopper and Pearson, 95 %.
struct ShareOfSteps {
  double share = 0, lo = 0, hi = 0;
  bool on_pareto_line = false;  // no subject as fast has a smaller share
};

// The results of one subject on all families.
struct SubjectRow {
  const BenchSubject* subject = nullptr;
  std::string answers = {};                // the kinds of its answers: "answer, time, pairs"
  std::optional<Estimate> over = {};       // median over families, with a bootstrap interval
  std::optional<double> create_over = {};  // median over families
  std::uint64_t families = 0;              // number of families with times
  JudgedCounts counts = {};
  ShareOfSteps unsafe = {}, alarming = {};  // of the judged steps
  std::optional<double> bytes_a_triangle = {};
};

// Returns rows in the order of the subjects; a subject that took part in nothing is left out.
// Subjects in this process that are asked for the same pairs share a Pareto line for each error.
// Culling::none has no place on the line, because only the smallest meshes are run with it.
std::vector<SubjectRow> by_subject(std::span<const FamilyRow> families,
                                   const std::vector<BenchSubject>& subjects);

// A case played by subjects that are asked the same question.
struct Match {
  const corpus::Case& c;  // as fitted to the contract of the subjects
  std::vector<SweptSubject> subjects = {};
  std::vector<SweptRuns> runs = {};
  // If cases are judged: the oracle's judgement of each step, and a verdict on the first run of
  // each subject. `outcome` is by the claims by which errors are counted, `own` by the subject's
  // own claims.
  std::vector<oracle::StepJudgement> truth = {};
  struct Verdict {
    properties::StepErrors errors = {};
    properties::Outcome outcome = properties::Outcome::holds, own = properties::Outcome::holds;
  };
  std::vector<Verdict> verdicts = {};
};

struct ComparisonPlan {
  SweepPlan sweep = {};       // the rounds are those of the families
  double small_seconds = 10;  // processor time for a worker's run of a generated or hard case
  double large_seconds = 60;  // the same for a scene or a public sequence
  int jobs = 1;               // threads of the oracle
  bool is_judged = true;      // else cases are only played and timed
  // A suite's own work on each case.
  std::function<void(const Match&)> on_case = [](const Match&) {};
};

// Is told the progress of a suite: `phase` gets the name of each part, and `tick` is called often.
struct BenchProgress {
  std::function<void(const std::string& name)> phase = [](const std::string&) {};
  std::function<void()> tick = [] {};
};

// Runs and judges cases. The first subject is the reference.
class Comparison {
 public:
  // The references must outlive this object. Wrong answers, and a line of the CSV for each step
  // and subject, go into the report.
  Comparison(const std::vector<BenchSubject>& subjects, ComparisonPlan plan, BenchReport& report,
             const BenchProgress& progress = {});

  // Runs all cases of the families, and adds a row for each family and subject that had one. A
  // subject is given the steps that its contract takes, and the reference is given the same steps.
  // If steps were left out, the start of the others is not vouched for. Culling::none takes part up
  // to 64 triangles. The times of a run that ended early do not count, and its steps are undecided.
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
  // By subject: a worker for small cases, and one for large ones. Each is started when it is first
  // needed.
  std::vector<std::array<properties::WorkerProcess, 2>> workers_;
  std::vector<FamilyRow> rows_;
  std::vector<UnsafeAnswer> unsafe_;
};

// Returns whether another method shows that step s has a contact that was missed or reported too
// late, or one of the missing pairs. If the contact may be at any time of the step, the method is
// the referee (a proof without roots). Otherwise it is rational arithmetic at a witness: a time
// before the detector's at which the two features meet, or two times between which they are proved
// to meet (oracle/referee/referee.h). If the contract asks for all features, their two triangles
// may meet instead. REQUIRES an unsafe diff of that step.
bool is_confirmed(const corpus::Case& c, std::size_t s, const properties::StepDiff& diff,
                  const detector::StepResult& result, const properties::Contract& contract);

// Returns a line for each subject: times beside errors. `heading` stands above their names. If
// workers took part, an explanation of the columns stands below the table.
std::string subjects_text(std::span<const SubjectRow> rows, const std::string& heading);

// Returns the runs that ended early, the absent peers, and a line for each unsafe answer that only
// the oracle calls unsafe.
std::string remarks_text(const Comparison& comparison, std::span<const AbsentPeer> absent);

// Adds `subjects`, `families` and `unsafe_answers`.
void add_figures(std::span<const SubjectRow> rows, const Comparison& comparison,
                 BenchReport& report);

// The suites.

using RunSuite = BenchReport(const BenchSettings& settings, const BenchProgress& progress);

// Shows where each arithmetic breaks, in the corpus's hard families.
RunSuite stability_suite;
// Compares every arithmetic, culling and kind of pairs on the same steps: time, and error against
// the oracle.
RunSuite speed_error_suite;
// Plays whole sequences by each culling and by several threads, and compares the default with the
// best choice.
RunSuite sequences_suite;
// Compares the peers that are there with the built-in detector: time and error.
RunSuite peers_suite;

// Times a plug-in beside the built-in detector, on the same steps of scenes and public sequences:
// each in a worker of its own, in turn, a whole sequence each time. The built-in detector is asked
// for what the plug-in claims. A claim that either breaks is a wrong answer. With a scale below 1,
// public sequences of more than 10,000 triangles are left out. REQUIRES a plug-in that has steps;
// its `limits.seconds` is the processor time that one run of a sequence may take.
BenchReport detector_suite(const BenchSettings& settings, const properties::Subject& plugin,
                           const BenchProgress& progress);

// Runs suite `stability` over any families and subjects in this process, so that tests can hand in
// wrong ones. The rows go family by family and subject by subject. Wrong answers are: a wrong exact
// subject, a refuted bounded one, and an oracle that contradicts a construction.
BenchReport stability_of(std::span<const corpus::HardFamily> families,
                         const std::vector<BenchSubject>& subjects, const BenchSettings& settings,
                         const BenchProgress& progress);
// Returns a subject for each arithmetic: exact, bounded, double and float. Each plays a case with
// the culling and view primitive that the case states; if it states none, with Culling::view_point.
std::vector<BenchSubject> all_arithmetics();

// Returns the changes of a hard case that must not change its answer, by their names: permutation
// (of vertices, triangles, first corners), mirror (all triangles reversed, so that outside stays
// outside), power of two (up or down, by the case's id), and translation (as far as it can be
// exact). The case's view primitive is changed too, and its facts stay. There is no form if a
// coordinate would be rounded.
using MakeForm = std::optional<properties::Form> (*)(const corpus::Case&);
std::span<const std::pair<const char*, MakeForm>> case_changes();

}  // namespace assay::reports
