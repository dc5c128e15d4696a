// `check` on one mesh, whoever asks: each step goes through the detector and, unless left out, the
// oracle, and the two are compared.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "detector/mesh/step_types.h"
#include "detector/mesh/topology.h"
#include "properties/campaign/gates/gates.h"
#include "reports/check/step_answers.h"
#include "reports/terminal/option_words.h"

namespace assay::reports {

// What one claim of a plug-in came to.
struct ClaimResult {
  enum class State : std::uint8_t { holds, broken, undecided, not_judged };
  std::string claim;
  State state;
  std::string why;  // "first in step 3", "undecided", or why it is not judged
};

struct CheckOutcome {
  bool is_judged = true;  // the oracle judged it
  bool defect = false, undecided = false;
  bool unsound = false;       // a second opinion contradicts the oracle
  bool facts_differ = false;  // expected facts of a case file do not hold
  bool judged_by_claims = false;
  bool has_answers = true;  // false: a library of candidates alone
  std::string ending;       // how a plug-in's run ended; empty: it went through
  std::string limit_reached;
  std::string rest;       // of a mesh at rest, which bodies meet; empty where that is not known
  std::string unwritten;  // why a file that was asked for was not written
  std::vector<std::string> asked_again;  // what came of asking a plug-in about steps that are kept
  std::vector<std::string> losses;       // of the input
  std::map<properties::Claim, std::uint64_t> first_broken;  // of each claim: its step, from 0
  std::optional<std::uint64_t>
      first_missed;  // the first contact answered free, whatever is claimed
  std::size_t judged_steps = 0;
  // Only for a plug-in: the claims that hold, those of which nothing is known, and what the
  // plug-in does whatever it claims.
  std::vector<std::string> held_claims;
  std::vector<properties::NotJudged> not_judged;
  properties::StepMeasures measures;
  std::optional<std::size_t> collision_step;  // the first step with a collision, counted from 0
  detector::TimeEnclosure collision_time;
  // The first step in which the oracle finds a contact and there is no answer to be judged, when
  // that contact is, and what the detector gave instead.
  std::optional<std::size_t> unanswered_step;
  detector::TimeEnclosure unanswered_time;
  std::string unanswered_error;

  // Counts a judged step of a plug-in.
  void count(const properties::StepDiff& diff, const detector::StepResult& result);
  // What all of them come to. `steps_left_out` is the number of steps of the input that the
  // contract leaves out.
  void judge_claims(const properties::DetectorUnderTest& plugin, std::size_t steps_left_out);

  // In the order of claims, those that are not judged last. REQUIRES judge_claims.
  std::vector<ClaimResult> claim_results() const;
  // The last lines of what `check` prints, each with its end of line.
  std::string summary() const;
  const char* word() const;
  int exit_code(bool fail_on_collision) const;
  // The exit code, or the problem if a file was not written.
  Expected<int> end(bool fail_on_collision) const;
};

// The report of `check`, schema assay-check/1 (reports/schemas/check.schema.json). `steps`: an
// entry for each step that was judged (steps/step_report.h).
nlohmann::ordered_json check_report(const std::vector<std::string>& files,
                                    const detector::Topology& mesh, const StepAnswers& answers,
                                    const CheckOutcome& outcome, nlohmann::ordered_json steps);

// Takes frames of one mesh, which are read as their steps come, or reads one case file. Fails if
// its options are not understood. REQUIRES a file.
corpus::Expected<CheckInput> read_check_input(const std::vector<std::string>& files);
// The same of several meshes as bodies of one, or of frames of which not all pairs count: `rest`
// has all but the files. REQUIRES a file of each.
using BodyWords = std::vector<std::vector<std::string>>;
corpus::Expected<CheckInput> read_bodies(const BodyWords& bodies, corpus::BodyFiles rest);

struct CheckQuestion {
  // What the input was read from, for reports and replay lines; bodies are empty if it has none.
  std::vector<std::string> files;
  BodyWords bodies;
  std::vector<std::array<std::int32_t, 2>> apart;
  BuiltInChoice built_in;
  DetectorWords detector;     // its `threads` is not used; the one below is
  std::uint64_t threads = 0;  // 0: all cores; a plug-in is told 1
  std::string answers;        // a table of answers (GivenAnswers), in place of a detector; or empty
  properties::Adjacency adjacency = properties::Adjacency::all;  // of these
  bool no_oracle = false;
  // The share in (0,1] of the oracle's questions that get a second opinion. REQUIRES the oracle.
  std::optional<double> second_opinion;
  int jobs = 1;
  std::optional<double> time_limit;           // seconds
  std::optional<std::uint64_t> memory_limit;  // bytes
  bool wants_report = false;                  // without it no report is built, which saves memory
  std::string announced_file;                 // the file of the report, to be named to the user
  std::string ply_file;  // where the mesh is written with what is in contact marked; empty: nowhere
  std::string again;     // the line that asks this again, to be pasted; empty where there is none
  bool shows_all_steps = true;  // false: only those that are not as claimed
};

// A step that breaks a claim, or differs from the oracle.
struct StepFailure {
  std::uint64_t number = 0;  // in its input, from 0
  const corpus::StepSource& source;
  const corpus::SourceStep& step;
  const detector::StepResult& result;
  const properties::StepDiff& diff;
  const properties::DetectorUnderTest& detector;
};

struct CheckListener {
  std::function<void(const std::string& text)> say;  // what is printed, as it becomes known
  detector::StopFunction stop = {};                  // may be empty; what it leaves is undecided
  // What is to be done with a step that fails; the text is printed. May be empty.
  std::function<std::string(const StepFailure&)> on_failure = {};
};

struct CheckAnswer {
  CheckOutcome outcome;
  nlohmann::ordered_json report;  // schema assay-check/1; null unless wanted
};

// Checks one mesh. The steps of `input` are used up; for a plug-in they become those that its
// contract takes. If a file that is read on the way is refused, `listener` was told of all steps
// before its frame. `worker` is the program assay-worker, for a plug-in. Recorded answers of the
// input are judged, and then no detector runs here.
Expected<CheckAnswer> check_mesh(const CheckQuestion& question, CheckInput& input,
                                 const std::filesystem::path& worker,
                                 const CheckListener& listener);

// `check --separation D` or `--offset` on one mesh: whether triangles that share no vertex come
// within D of each other, which, when first, and how near any two of them come. The oracle alone is
// asked.

// Finite lengths of 0 or more, in the mesh's units.
struct AskedDistance {
  double separation = 0;
  // By body. If there are any, the distance asked of two triangles is the exact sum of the offsets
  // of their bodies, in place of `separation`.
  std::vector<double> offsets;
};

struct SeparationAnswer {
  int exit_code = 0;              // 3 if a limit was reached; else 5 if near and asked for; else 0
  nlohmann::ordered_json report;  // schema assay-check/1; null unless wanted
};

// Asks the oracle for each step. Of the question only what bears on the oracle is used: files,
// jobs, limits, and whether a report is wanted. REQUIRES as many offsets as bodies, or none.
// `fail_when_near`: exit code 5 where a step is near.
Expected<SeparationAnswer> check_separation(const CheckQuestion& question, const AskedDistance& d,
                                            bool fail_when_near, CheckInput& input,
                                            const CheckListener& listener);

// What is kept of steps that fail: of each the part of the mesh that shows it, as files that other
// programs read (steps/case_export.h).

// What is to be kept of the steps that fail, and where.
struct Keeping {
  std::string folder;          // step N, from 1, goes into FOLDER/step-N; empty: nothing is kept
  std::string origin;          // the input, for people
  double shrink_seconds = 20;  // for each failing step that the plug-in fails on again
};

// Checks one mesh (check_run.h) and keeps what fails. With a plug-in in the question, which a log
// is of the same code as, that is asked about each step alone, and what it fails on is shrunk.
Expected<CheckAnswer> check_keeping(const CheckQuestion& question, CheckInput& input,
                                    const Keeping& keeping, CheckListener listener);

// What each claim of a log came to, as a suite of JUnit XML. A claim that is broken fails, and one
// of which the log tells nothing, or not enough, is skipped.
std::string junit_suite(const std::string& log, const CheckOutcome& outcome);
// The suite of a log that could not be judged.
std::string junit_suite_of_problem(const std::string& log, const std::string& message);

}  // namespace assay::reports
