// Runs `check` on one mesh, for the command line and for Python. The detector and, unless it is
// left out, the oracle answer each step, and their answers are compared.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "detector/mesh/step_types.h"
#include "detector/mesh/topology.h"
#include "properties/campaign/gates/gates.h"
#include "reports/check/step_answers.h"
#include "reports/terminal/option_words.h"

namespace assay::reports {

// The result of one claim of a plug-in.
struct ClaimResult {
  enum class State : std::uint8_t { holds, broken, undecided, not_judged };
  std::string claim;
  State state;
  std::string why;  // "first in step 3", "undecided", or why it is not judged
};

struct CheckOutcome {
  bool is_judged = true;  // the oracle judged the steps
  bool defect = false, undecided = false;
  bool unsound = false;       // a second opinion contradicts the oracle
  bool facts_differ = false;  // expected facts of a case file do not hold
  bool judged_by_claims = false;
  bool has_answers = true;  // false: the library gives only candidates
  std::string ending;       // how a plug-in's run ended; empty: it completed
  std::string limit_reached;
  std::string rest;       // for a mesh at rest: the bodies that meet; empty if unknown
  std::string unwritten;  // why a requested file was not written
  std::vector<std::string> asked_again;  // the answers of a plug-in about kept steps
  std::vector<std::string> losses;       // descriptions of lost parts of the input
  // By claim: the first step that breaks it, from 0.
  std::map<properties::Claim, std::uint64_t> first_broken;
  std::optional<std::uint64_t>
      first_missed;  // the first step that has a contact and was answered free, whatever is claimed
  std::size_t judged_steps = 0;
  // Only for a plug-in: the claims that hold, the claims that were not judged, and measures that do
  // not depend on claims.
  std::vector<std::string> held_claims;
  std::vector<properties::NotJudged> not_judged;
  properties::StepMeasures measures;
  std::optional<std::size_t> collision_step;  // the first step with a collision, counted from 0
  detector::TimeEnclosure collision_time;
  // The first step with a contact by the oracle and no answer that can be judged, the time of the
  // contact, and the detector's error in place of an answer.
  std::optional<std::size_t> unanswered_step;
  detector::TimeEnclosure unanswered_time;
  std::string unanswered_error;

  // Counts a judged step of a plug-in.
  void count(const properties::StepDiff& diff, const detector::StepResult& result);
  // Judges the claims by all counted steps. `steps_left_out` is the number of steps of the input
  // that the contract leaves out.
  void judge_claims(const properties::DetectorUnderTest& plugin, std::size_t steps_left_out);

  // Returns the results in the order of claims, unjudged claims last. REQUIRES that judge_claims
  // was called.
  std::vector<ClaimResult> claim_results() const;
  // Returns the last lines of the output of `check`, each with its end of line.
  std::string summary() const;
  const char* word() const;
  int exit_code(bool fail_on_collision) const;
  // Returns the exit code, or the problem if a file was not written.
  Expected<int> end(bool fail_on_collision) const;
};

// Returns the report of `check`, schema assay-check/1 (reports/schemas/check.schema.json). `steps`:
// an entry for each judged step (steps/step_report.h).
nlohmann::ordered_json check_report(const std::vector<std::string>& files,
                                    const detector::Topology& mesh, const StepAnswers& answers,
                                    const CheckOutcome& outcome, nlohmann::ordered_json steps);

// Opens frames of one mesh, which are read only when their steps are reached, or reads one case
// file. Fails if the options of the case are not understood. REQUIRES a file.
corpus::Expected<CheckInput> read_check_input(const std::vector<std::string>& files);
// Reads several meshes as bodies of one mesh, or frames in which not all pairs count. `rest` states
// everything about the input except the files. REQUIRES at least one file for each body.
using BodyWords = std::vector<std::vector<std::string>>;
corpus::Expected<CheckInput> read_bodies(const BodyWords& bodies, corpus::BodyFiles rest);

// Finite lengths of 0 or more, in the mesh's units.
struct AskedDistance {
  double separation = 0;
  // By body. If there are offsets, the distance for two triangles is the exact sum of the offsets
  // of their bodies, in place of `separation`.
  std::vector<double> offsets;
};

struct CheckQuestion {
  // The files of the input, for reports and replay lines; `bodies` is empty if it has no bodies.
  std::vector<std::string> files;
  BodyWords bodies;
  std::vector<std::array<std::int32_t, 2>> apart;
  BuiltInChoice built_in;
  DetectorWords detector;     // its `threads` is not used; the next member is
  std::uint64_t threads = 0;  // 0: 1 for a plug-in, else all cores
  std::string answers;        // table of answers (GivenAnswers) in place of a detector, or empty
  properties::Adjacency adjacency = properties::Adjacency::all;  // of the answers in the table
  bool no_oracle = false;
  // The share in (0,1] of the oracle's questions that get a second opinion. REQUIRES the oracle.
  std::optional<double> second_opinion;
  int jobs = 1;
  std::optional<double> time_limit;           // seconds
  std::optional<std::uint64_t> memory_limit;  // bytes
  bool wants_report = false;                  // without it no report is built, which saves memory
  std::string announced_file;                 // the file of the report, to be named to the user
  std::string ply_file;  // file for the mesh with its contacts marked; empty: no file
  // The line to paste that repeats this check; empty if there is no line.
  std::string again;
  bool shows_all_steps = true;  // false: only steps that are not as claimed
  // If stated, no detector runs: only the oracle is asked, about this distance (check_separation).
  // Of the other members, it uses only the files, the jobs, the limits, and what concerns the
  // report. REQUIRES as many offsets as bodies, or no offsets.
  std::optional<AskedDistance> distance;
};

// A step that breaks a claim, or differs from the oracle.
struct StepFailure {
  std::uint64_t number = 0;  // the step's number in its input, from 0
  const corpus::StepSource& source;
  const corpus::SourceStep& step;
  const detector::StepResult& result;
  const properties::StepDiff& diff;
  const properties::DetectorUnderTest& detector;
};

struct CheckListener {
  std::function<void(const std::string& text)> say;  // gets each text to print, as it becomes known
  detector::StopFunction stop = {};                  // may be empty; unreached steps are undecided
  // Is called with each failing step; the text that it returns is printed. May be empty.
  std::function<std::string(const StepFailure&)> on_failure = {};
};

struct CheckAnswer {
  CheckOutcome outcome;
  nlohmann::ordered_json report;  // schema assay-check/1; null if no report is wanted
};

// Checks one mesh. `input` is used up; for a plug-in, its steps become the steps that the contract
// takes. If the file of a later frame is refused, `listener` has been told of all steps before that
// frame. `worker` is the program assay-worker, for a plug-in. If the input has recorded answers,
// these are judged, and no detector runs here.
Expected<CheckAnswer> check_mesh(const CheckQuestion& question, CheckInput& input,
                                 const std::filesystem::path& worker,
                                 const CheckListener& listener);

// Asks the oracle whether triangles that share no vertex come within question.distance, which ones,
// when first, and how near any two come. The outcome's collision is the first step in which a pair
// comes within that distance. REQUIRES a question with a distance.
Expected<CheckAnswer> check_separation(const CheckQuestion& question, CheckInput& input,
                                       const CheckListener& listener);

// Keeps failing steps: writes, for each of them, the part of the mesh that shows the failure, as
// files for other programs (steps/case_export.h).

// Where failing steps are kept, and how long they are shrunk.
struct Keeping {
  std::string folder;          // step N, from 1, goes into FOLDER/step-N; empty: nothing is kept
  std::string origin;          // names the input for people
  double shrink_seconds = 20;  // for each step on which the plug-in fails again
};

// Calls check_mesh, and keeps failing steps. If the question names a plug-in, the plug-in is asked
// about each failing step by itself, and the steps on which it fails again are shrunk. For a log,
// the plug-in should have the code of the recorded detector.
Expected<CheckAnswer> check_keeping(const CheckQuestion& question, CheckInput& input,
                                    const Keeping& keeping, CheckListener listener);

}  // namespace assay::reports
