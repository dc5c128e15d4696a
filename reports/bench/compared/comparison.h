// Compares subjects on families of cases. A subject is a plug-in, or the built-in detector with
// certain options. The subjects play each case in turn, and the oracle judges their answers. The
// report shows times beside errors, summed by family and by subject. Every suite of `assay bench`
// is such a comparison. At default size, on one core, a suite takes at most five minutes, and all
// suites together take at most twenty. This header begins with the report of a suite.
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

// The report of a suite has rows, wrong answers, and further figures. It is written as text, as
// JSON (schema assay-bench/2, reports/schemas/bench.schema.json) and as CSV, in the same form for
// all suites.

// The goals of the suites of `assay bench`, as ratios. Suites give these goals to their rows; the
// comments below say to which rows.
//
// A goal has a name here only if somebody had to choose its bound. Where only one bound makes
// sense, the goal is written where its rows are made: no wrong answer (at_most(0)), every answer
// the same (at_least(100) %).

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

// Goals for the time of whole steps, on any mesh. Where views do not pay, Culling::view_auto
// searches like Culling::bvh, so it loses only the time to find out that they do not pay.
inline constexpr Goal view_auto_over_bvh = at_most(1.05);
inline constexpr Goal exact_over_double = at_most(1.3);

// Goals for whole sequences with Culling::automatic. "Best culling" is the single other culling
// that takes the least time for the sequence. auto_over_best_culling is for the sum and for the
// median step, auto_step_over_best_culling for the worst step of a millisecond or more.
// first_step_over_bvh compares the first step with the first step of Culling::bvh, which looks at
// the same pairs. two_threads_gain is the time of one thread over the time of two threads.
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
  // that it fills; the other columns of a line are empty. If there are no lines, the CSV has the
  // samples of the rows.
  std::vector<std::string> columns = {};
  std::vector<std::pair<std::size_t, std::string>> samples = {};

  void add(std::string label, std::string unit, Estimate estimate,
           std::optional<Goal> goal = std::nullopt, std::string note = {});
  // Adds a row that says that the folder or file `missing` does not exist.
  void add_no_data(std::string label, const std::string& missing);
  // Adds a line to `samples`. A field that is an object has a column for each of its fields
  // ("late_steps"). A list of numbers fills one column, with blanks between the numbers; other
  // lists are left out.
  void add_sample(const nlohmann::ordered_json& object);
  // Adds a row without a measurement. `why` is its note, such as "left out: ...".
  void add_left_out(std::string label, std::string why);
};

std::string text_of(const Goal& goal);

// A word of a table, with the heading and the width of its column. The word is aligned to the
// right, or to the left if the width is below 0. The last column has width 0 or above; if its word
// is empty, the line ends before this column.
struct Column {
  std::string heading;
  int width;
  std::string word;
};

// Returns a line with the headings of the first row, then a line for each row, with `gap` blanks
// between columns. Empty if there are no rows.
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

// A subject of a comparison: the built-in detector with certain options, in this process or in a
// worker, or a plug-in.
struct BenchSubject : properties::Subject {
  std::string name = {};
  detector::Options options = {};  // of the built-in detector; `start` is set by the case
  bool is_here = false;            // the subject runs in this process
  MakeStages stages = detector::standard_stages;  // of a subject in this process
  bool is_vouched_for = true;                     // true: starts known to be clean are not verified
  bool must_hold = true;                          // if this subject breaks a claim, the suite fails
  // The claims by which errors are counted. For every form of the built-in detector these are the
  // claims of exact arithmetic, so that all errors are counted. Arithmetic::double_precision claims
  // no pairs, so by its own claims no missing pair would be an error. For a plug-in, these are its
  // own claims.
  properties::Claims error_claims = {};
  // If stated, the steps that the subject gets are chosen by this contract, and not by the contract
  // of the subject.
  std::optional<properties::Contract> contract_of_input = std::nullopt;

  const properties::Contract& contract_of_steps() const {
    return contract_of_input ? *contract_of_input : detector.contract;
  }
  // Returns a worker for the subject. The worker is not started yet.
  properties::WorkerProcess make_worker(double seconds) const;
};

// Returns the built-in detector with these options, in this process, under a name like "exact
// view-auto all".
BenchSubject variant_of(detector::Arithmetic arithmetic, detector::Culling culling,
                        detector::Pairs pairs);
// Returns a subject for every arithmetic, every culling, and both values of Pairs. The first is
// "exact bvh all".
std::vector<BenchSubject> all_variants();

// Returns the built-in detector in a worker, under a name like "built-in, exact, bvh".
BenchSubject built_in_in_worker(const detector::Options& options);

// A detector that is known but cannot be run here.
struct AbsentPeer {
  std::string name, why;
};
struct Peers {
  std::vector<BenchSubject> subjects;  // the first is "built-in, exact, bvh"
  std::vector<AbsentPeer> absent;
};
// Returns the built-in detector in three arithmetics, and the peers, which are the libraries
// NAME.so in the folder: known peers first, then the others by name. A library counts as absent if
// it cannot be loaded, answers no steps, or answers about a distance in place of contact. A known
// peer without a library is absent too; its `why` says what is missing.
Peers find_peers(const std::string& folder);

// The counts of answers that the oracle judged.
struct JudgedCounts {
  properties::StepErrors errors;       // of the steps that the contract takes
  std::uint64_t left_out = 0;          // steps that the contract does not take
  std::uint64_t confirmed = 0;         // unsafe steps confirmed without the oracle (is_confirmed)
  std::uint64_t timed_collisions = 0;  // collisions whose first time is not [0, 1]
  std::uint64_t slow = 0;              // cases run only once, because a step took too long
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
  std::string first_end = {};              // the first run that stopped early: "CASE: cause"
  std::vector<std::string> breaches = {};  // broken claims, each once

  std::optional<Estimate> over() const;  // ratio to the reference, round by round
  std::optional<double> create_over() const;
};

// A share of steps, with its interval of Clopper and Pearson, 95 %.
struct ShareOfSteps {
  double share = 0, lo = 0, hi = 0;
  bool on_pareto_line = false;  // no subject that is as fast has a smaller share
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

// Returns rows in the order of the subjects; a subject that took part in nothing is left out. For
// each kind of error there is a Pareto line of the subjects in this process that are asked for the
// same pairs. Subjects with Culling::none are on no line, because they run only the smallest
// meshes.
std::vector<SubjectRow> by_subject(std::span<const FamilyRow> families,
                                   const std::vector<BenchSubject>& subjects);

// A case played by subjects that are asked the same question.
struct Match {
  const corpus::Case& c;  // as fitted to the contract of the subjects
  std::vector<SweptSubject> subjects = {};
  std::vector<SweptRuns> runs = {};
  // If cases are judged: the oracle's judgement of each step, and a verdict on the first run of
  // each subject. `outcome` is judged by the subject's error_claims, `own` by its own claims.
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
  double large_seconds = 60;  // processor time for a run of a scene or a public sequence
  int jobs = 1;               // threads of the oracle
  bool is_judged = true;      // false: cases are only played and timed
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
  // `subjects` and `report` must outlive this object. Wrong answers, and a line of the CSV for each
  // step and subject, go into the report.
  Comparison(const std::vector<BenchSubject>& subjects, ComparisonPlan plan, BenchReport& report,
             const BenchProgress& progress = {});

  // Runs all cases of the families, and adds a row for each family and each subject that played a
  // case of it. A subject is given the steps that its contract takes, and the reference is given
  // the same steps. If steps are left out of a case, its starts are verified. Subjects with
  // Culling::none play only cases of at most 64 triangles. The times of a run that ended early do
  // not count, and its steps are undecided.
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

// Returns whether another method than the oracle confirms the unsafe diff of step s. The diff is
// confirmed if the contact that the detector missed or reported too late is proved, or if a missing
// pair is proved to be in contact. Two methods look at the whole step, or, for a late contact, at
// the part before the detector's time. The referee proves without roots that the two features meet
// (oracle/referee/referee.h). Rational arithmetic looks for a witness: a time at which the features
// meet, or two times between which they are proved to meet. If the contract asks for all features,
// it suffices that the two triangles meet. REQUIRES an unsafe diff.
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
// Compares the peers that can be run with the built-in detector: time and error.
RunSuite peers_suite;

// Times a plug-in beside the built-in detector, on the same steps of scenes and public sequences.
// Each detector has a worker of its own, and the two take turns, a whole sequence each time. The
// built-in detector is asked only for what the plug-in claims. If one of the two detectors breaks a
// claim, that is a wrong answer. With a scale below 1, public sequences of more than 10,000
// triangles are left out. REQUIRES a plug-in that has steps; its `limits.seconds` is the processor
// time that one run of a sequence may take.
BenchReport detector_suite(const BenchSettings& settings, const properties::Subject& plugin,
                           const BenchProgress& progress);

// Runs suite `stability` over the given families and the given subjects, which run in this process.
// A test can give it subjects that are wrong. The rows are sorted by family, then by subject. There
// is a wrong answer if a subject with exact arithmetic is wrong, if an answer with bounded
// arithmetic is refuted, or if the oracle contradicts the construction of a case.
BenchReport stability_of(std::span<const corpus::HardFamily> families,
                         const std::vector<BenchSubject>& subjects, const BenchSettings& settings,
                         const BenchProgress& progress);
// Returns a subject for each arithmetic: exact, bounded, double and float. Each plays a case with
// the culling and view primitive that the case states; if it states none, with Culling::view_point.
std::vector<BenchSubject> all_arithmetics();

// Returns the changes of a hard case that must not change its answer, by their names: permutation
// (of vertices, triangles, first corners), mirror (all triangles reversed, so that outside stays
// outside), power of two (up or down, by the case's id), and translation (as far as it can be
// exact). The case's view primitive is changed too, and its facts stay. A change returns nothing if
// it would round a coordinate.
using MakeForm = std::optional<properties::Form> (*)(const corpus::Case&);
std::span<const std::pair<const char*, MakeForm>> case_changes();

}  // namespace assay::reports
