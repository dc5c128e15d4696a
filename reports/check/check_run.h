// `check` on one mesh, whoever asks: each step goes through the detector and, unless left out, the
// oracle, and the two are compared.
#pragma once

#include <array>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reports/check/check_outcome.h"
#include "reports/check/step_answers.h"
#include "reports/terminal/option_words.h"

namespace assay::reports {

// Takes frames of one mesh, which are read as their steps come, or reads one case file. Fails if
// its options are not understood. REQUIRES a file.
corpus::Expected<CheckInput> read_check_input(const std::vector<std::string>& files);
// The same of several meshes as bodies of one, or of frames of which not all pairs count: `asked`
// has all but the files. REQUIRES a file of each.
using BodyWords = std::vector<std::vector<std::string>>;
corpus::Expected<CheckInput> read_bodies(const BodyWords& bodies, corpus::BodyFiles asked);

struct CheckQuestion {
  // What the input was read from, for reports and replay lines; bodies are empty if it has none.
  std::vector<std::string> files;
  BodyWords bodies;
  std::vector<std::array<std::int32_t, 2>> apart;
  BuiltInChoice built_in;
  DetectorWords detector;     // its `threads` is not used; the one below is
  std::uint64_t threads = 0;  // 0: all cores; a plug-in is told 1
  std::string answers;  // a table of answers (given_answers.h), in place of a detector; or empty
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
struct FailedStep {
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
  std::function<std::string(const FailedStep&)> failed = {};
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

}  // namespace assay::reports
