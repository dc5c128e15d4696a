// `assay replay` runs one case again, by its id or from its file, and explains one pair of its
// triangles.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "corpus/problem.h"
#include "detector/step_result.h"
#include "properties/campaign/request.h"
#include "properties/campaign/trials/trials.h"
#include "properties/generators/draft.h"
#include "properties/judging/case_options.h"
#include "properties/judging/exam.h"
#include "properties/queries/query_families.h"
#include "properties/reducer/reducer.h"
#include "properties/words.h"
#include "properties/worker/plugin/query_case.h"
#include "properties/worker/worker_process.h"
#include "reports/check/check_run.h"
#include "reports/pictures/case_scene.h"
#include "reports/steps/case_export.h"
#include "reports/steps/step_report.h"
#include "reports/terminal/words.h"
#include "reports/terminal/work.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

struct ReplayRequest {
  std::string id_or_file;
  std::string export_folder;  // empty: nothing is exported
  std::optional<detector::TrianglePair> why;
  DetectorWords detector;
};

using properties::Outcome;

struct TrialName {
  const properties::Family* family;
  std::uint64_t index;
};

// Reads an id "campaign:seed:family:index". Returns nothing if it is none. A round may stand
// behind the number of the seed, as in "quick:1.canary:broken:7".
std::optional<TrialName> trial_of(std::string_view id) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= id.size();) {
    const auto end = std::min(id.find(':', begin), id.size());
    parts.push_back(id.substr(begin, end - begin));
    begin = end + 1;
  }
  if (parts.size() != 4 || parts[0].empty()) return std::nullopt;
  const auto index = whole_number_of(parts[3]);
  const std::string seed(parts[1].substr(0, parts[1].find('.')));
  if (!index || seed.empty() || seed.find_first_not_of("0123456789") != std::string::npos)
    return std::nullopt;
  const auto* family = properties::find_family(parts[2]);
  if (!family) return std::nullopt;
  return TrialName{family, *index};
}

// Chooses configurations: that of the case's options if it states some, else every one.
std::optional<std::string> choose_configurations(const corpus::Case& c,
                                                 properties::DetectorUnderTest& detector) {
  if (!detector.built_in || c.options.empty()) return std::nullopt;
  auto configuration = properties::read_configuration(c, "");
  if (!configuration) return configuration.error().message;
  auto& [name, options, fault, is_timed, asks_limits] = configuration.value();
  name = fmt::format("{}{}{}", properties::name_of(options.culling),
                     options.pairs == detector::Pairs::first ? "/first" : "",
                     asks_limits ? "/limits" : "");
  detector = detector.in(configuration.value());
  return std::nullopt;
}

// Prints the contacts that count under the contract, and names those that it leaves out.
void print_steps(const corpus::Case& c, const std::vector<oracle::StepJudgement>& judgements,
                 const properties::Contract& contract) {
  const auto script = corpus::steps_of(c);
  const bool is_query = properties::says_query(c);
  for (std::size_t s = 0; s < script.size(); ++s) {
    const auto truth = truth_of(c, judgements[s], contract);
    if (is_query) {
      fmt::print("the query: oracle {}", properties::name_of(truth.answer()));
    } else {
      fmt::print("step {} (frame {} to {}, {}): oracle {}", s + 1, script[s].from, script[s].to,
                 script[s].commit ? "committed" : "evaluated only",
                 properties::name_of(truth.answer()));
    }
    if (truth.first) fmt::print(" at t = {}", time_text(truth.first->time));
    if (truth.first && !is_query) {
      fmt::print(", {} pair{} {}", truth.pairs.size(), truth.pairs.size() == 1 ? "" : "s",
                 met_text(contract.separation));
    }
    fmt::print("{}\n", left_out_text(truth));
  }
}

std::string sets_text(const detector::StepResult& result) {
  if (result.doubts.empty()) return "";
  return fmt::format("; V+ {}  V- {}  V0 {}  Vv {} (violated {}, dirty {})", result.view_positive,
                     result.view_negative, result.view_zero, result.against_all, result.violated,
                     result.dirty);
}

// Returns the result of one configuration, without its name.
std::string run_text(const properties::CaseRun& run, const properties::Verdict& verdict,
                     bool is_query) {
  std::string text = fmt::format("{}{}\n", properties::name_of(verdict.outcome),
                                 run.explanation.empty() ? "" : " (" + run.explanation + ")");
  for (std::size_t s = 0; s < run.steps.size(); ++s) {
    const auto& result = run.steps[s];
    if (s < run.candidates.size() && run.candidates[s])
      text += fmt::format("  step {}: {} candidate pairs\n", s + 1, run.candidates[s]->size());
    const auto error = error_of(run, s);
    if (!error.empty()) text += fmt::format("  {}\n", error);
    if (!run.has_answers) continue;
    text += fmt::format(
        "  {}: {}{}{}\n", is_query ? "the query" : fmt::format("step {}", s + 1),
        properties::name_of(result.answer),
        result.answer == detector::Answer::collision
            ? fmt::format(" at t = {}", time_text(result.first))
            : "",
        is_query ? "" : fmt::format(", {} pairs{}", result.pairs.size(), sets_text(result)));
  }
  if (verdict.failure) {
    const auto where = fmt::format("step {}: ", verdict.failure->step + 1);
    const auto& explanation = verdict.failure->explanation;
    text += fmt::format(
        "  DEFECT {}{}{}\n", verdict.failure->signature(), is_query ? ": " : " in " + where,
        explanation.starts_with(where) ? explanation.substr(where.size()) : explanation);
  }
  if (verdict.outcome != Outcome::holds) text += printed_text(run.output);
  return text;
}

// A text, and the configurations with this result.
struct RunText {
  std::vector<std::string> configurations;
  std::string text;
};

// Prints the broken laws. Returns whether there are any.
bool print_broken_laws(const properties::CaseResults& results,
                       const properties::DetectorUnderTest& detector) {
  const properties::TallyInput one{results, detector.configurations};
  const auto tally = properties::tally_cases({&one, 1}).front();
  for (const auto& failure : tally.failures) {
    fmt::print("BROKEN LAW {} ({}): {}\n", failure.law, failure.configuration, failure.explanation);
  }
  return !tally.failures.empty();
}

// Writes a strip of the first step with a counted contact, beside the exported files. Writes none
// for a mesh that is too large for a picture.
Expected<void> write_strip(const std::string& folder, const corpus::Case& c,
                           const std::vector<oracle::StepJudgement>& judgements,
                           const properties::Contract& contract) {
  if (c.triangles.rows() > most_shown_triangles) return outcome::success();
  CaseScene scene;
  scene.c = c;
  scene.contract = contract;
  const auto script = corpus::steps_of(c);
  for (std::size_t s = 0; s < script.size(); ++s)
    scene.steps.push_back({script[s], truth_of(c, judgements[s], contract), {}, {}});
  if (!scene.shown_pair()) return outcome::success();
  return write_text_file((std::filesystem::path(folder) / "strip.svg").string(),
                         strip_svg(scene, properties::printable(c.about)));
}

// Returns a remark on an id whose campaign has nearly the name of a built-in one. A case is made
// from the text of its id, so a misspelt name makes another case. It is no error, because a
// campaign from a file may have that name.
std::string misspelt(const std::string& id) {
  const auto campaign = id.substr(0, id.find(':'));
  const auto hint = corpus::did_you_mean(corpus::names_among(properties::named_plans()), campaign);
  return hint.empty() ? "" : fmt::format("no built-in campaign is called {}{}\n", campaign, hint);
}

// Judges a step of a log again.
Expected<int> replay_log(const LogName& log, const ReplayRequest& request) {
  if (request.why) return Problem{"--why explains the built-in detector, and this is a log"};
  BOOST_OUTCOME_TRY(input, read_log(log, {}));
  CheckQuestion question;
  question.files = {log.file};
  const CheckListener terminal{[](const std::string& text) { fmt::print("{}", text); }};
  BOOST_OUTCOME_TRY(answer,
                    check_keeping(question, input, {request.export_folder, log.file}, terminal));
  return answer.outcome.end(false);
}

Expected<int> run_replay(const ReplayRequest& request) {
  const auto log = log_name(request.id_or_file);
  if (log.step && request.detector.library.empty()) return replay_log(log, request);
  // If a file has this name, the case is read from it. Otherwise an id makes the case again.
  std::error_code ignored;
  std::optional<TrialName> trial;
  if (!std::filesystem::exists(request.id_or_file, ignored)) trial = trial_of(request.id_or_file);
  corpus::Case c;
  if (!trial) {
    auto input = read_case_of({request.id_or_file});
    if (!input) {
      return Problem{
          input.error().message +
          (request.id_or_file.find(':') == std::string::npos
               ? ""
               : " (an id is CAMPAIGN:SEED:FAMILY:INDEX, with a family of this build; a case that "
                 "a search found is replayed by its file: assay list failures DIR)")};
    }
    c = std::move(input.value());
  }
  BOOST_OUTCOME_TRY(may_fill(request.export_folder));
  auto words = request.detector;
  const bool is_query =
      trial ? properties::is_query_family(trial->family->name) : properties::says_query(c);
  if (is_query && words.library.empty())
    return Problem{"this is a query of a plug-in: name its library by --detector"};
  words.part = is_query ? DetectorPart::query : DetectorPart::steps;
  BOOST_OUTCOME_TRY(subject, choose_detector(words));
  if (trial) subject.detector = subject.detector.in_stratum(trial->family->name);
  const auto& contract = subject.detector.contract;
  if (trial) c = properties::case_within(contract, *trial->family, request.id_or_file).source.c;
  if (auto problem = choose_configurations(c, subject.detector)) {
    return Problem{fmt::format("{}: {}", request.id_or_file, *problem)};
  }
  const bool vouched = trial && properties::is_vouched_for(subject.detector, c, trial->index);
  if (vouched) {
    subject.detector.configurations = properties::with_clean_start(subject.detector.configurations);
  }
  if (request.why && !subject.detector.built_in) {
    return Problem{"--why explains the built-in detector: a plug-in does not show its stages"};
  }
  if (request.why && (request.why->a < 0 || request.why->b >= c.triangles.rows())) {
    return Problem{fmt::format("--why {},{}: the mesh has {} triangles", request.why->a,
                               request.why->b, c.triangles.rows())};
  }
  const auto contracted_case = properties::contract_case(c, subject.detector.contract);
  if (!contracted_case) {
    return Problem{fmt::format("{}: none of its steps is within the detector's contract: {}",
                               request.id_or_file, properties::why_left_out(c, contract))};
  }
  // A plug-in that claims to be deterministic is asked again, as in a campaign: in another process,
  // in which each step is evaluated twice.
  const bool asks_twice =
      !subject.detector.built_in && subject.detector.claims.has(properties::Claim::deterministic);
  auto worker = subject.process(), second = subject.process(1, true);
  const auto results = properties::examine(
      {subject.detector, subject.detector.configurations, &worker, asks_twice ? &second : nullptr},
      *contracted_case);
  if (auto why = results.why_not_run(); !why.empty()) return Problem{std::move(why)};
  const auto& runs = results.runs;
  const auto& truth = results.truth;
  fmt::print("{}: {}{}\n", properties::printable(c.id), properties::size_text(c),
             c.about.empty() ? "" : "; " + properties::printable(c.about));
  if (trial) fmt::print("{}", misspelt(request.id_or_file));
  if (vouched) fmt::print("as in the campaign, the detector is told that the start is clean\n");
  print_steps(*contracted_case, truth, contract);
  int code = exit_holds;
  std::vector<RunText> texts;
  std::optional<properties::Claim> claim;
  auto exported = subject.detector;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto& configuration = subject.detector.configurations[i];
    const auto& verdict = results.verdicts[i];
    std::string text = run_text(runs[i], verdict, is_query);
    if (verdict.outcome == Outcome::defect) code = exit_defect;
    if (verdict.failure && !claim) {
      claim = verdict.failure->claim;
      exported = subject.detector.in(configuration);
    }
    const bool is_open = verdict.outcome == Outcome::undecided || verdict.outcome == Outcome::error;
    if (is_open && code == exit_holds) code = exit_undecided;
    if (request.why) text += pair_story(c, configuration.options, *request.why, truth);
    auto same = std::ranges::find(texts, text, &RunText::text);
    if (same == texts.end()) same = texts.insert(same, {{}, text});
    same->configurations.push_back(configuration.name);
  }
  for (const auto& [configurations, text] : texts)
    fmt::print("{}: {}", fmt::join(configurations, ", "), text);
  if (subject.detector.built_in && print_broken_laws(results, subject.detector)) {
    code = exit_defect;
  }
  if (!request.export_folder.empty()) {
    BOOST_OUTCOME_TRY(export_case(request.export_folder, *contracted_case, exported, truth, claim));
    BOOST_OUTCOME_TRY(write_strip(request.export_folder, *contracted_case, truth, contract));
    fmt::print("exported to {}\n", request.export_folder);
  }
  return code;
}

// Reads "3,17", for example.
std::optional<detector::TrianglePair> parse_pair(const std::string& word) {
  const auto two = two_numbers(word);
  if (!two || (*two)[0] == (*two)[1]) return std::nullopt;
  const auto [a, b] = std::minmax((*two)[0], (*two)[1]);
  return detector::TrianglePair{a, b};
}

void add_options(CLI::App& verb, ReplayRequest& request) {
  add(verb, "CASE", request.id_or_file,
      "A case's id, CAMPAIGN:SEED:FAMILY:INDEX, or a file; LOG#N: step N of a log")
      ->required();
  add(verb, "--export DIR", request.export_folder,
      "Write frames as OBJ, a picture of the first contact and a test in C++ into this folder: "
      "plain arrays with a GoogleTest, or for a plug-in with a program that loads it")
      ->group(OptionGroup::output);
  add_choice(verb, "--why A,B", request.why, "A,B: two triangles", parse_pair,
             "A,B: why this pair of triangles was or was not tested");
  add_detector(verb, request.detector);
}

}  // namespace

VerbAction add_replay(CLI::App& app) {
  return make_verb(app, "replay", "Run one case of a campaign again, or a case file", add_options,
                   run_replay);
}

}  // namespace assay::reports
