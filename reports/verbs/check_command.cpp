// `assay check` judges its input: a mesh, whose steps the detector answers and, unless --no-oracle
// is given, the oracle judges; a log, whose recorded answers are judged; or query files
// (check_queries.cpp).
#include <fmt/format.h>

#include <algorithm>
#include <boost/assert.hpp>
#include <limits>

#include "corpus/formats/step_source.h"
#include "properties/judging/case_options.h"
#include "reports/check/check_run.h"
#include "reports/terminal/words.h"
#include "reports/terminal/work.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

struct CheckRequest {
  std::vector<std::string> inputs;
  std::vector<std::string> apart;  // words "A,B"
  std::uint64_t rings = 0;
  double rest_distance = 0;
  bool weld = false;
  CheckQuestion question;
  std::optional<double> separation;
  std::vector<double> offsets;
  LogSelection selection;  // of a log
  bool all_steps = false;  // of a log
  QueryQuestion queries;   // the labels and the method
  bool fail_on_collision = false;
  std::string json_file, junit_file;  // empty: not written
  Keeping keeping;
  std::function<std::vector<std::string>()> option_texts;  // given_options of the verb
};

// The kind of input, as bits, so that an option may be for several kinds.
enum Kind : unsigned { frames = 1, rest = 2, bodies = 4, a_case = 8, a_log = 16, queries = 32 };

struct KindWords {
  Kind kind;
  const char *name, *input;  // for people; behind "assay check"
};
constexpr KindWords kinds[] = {{frames, "frames", "FRAME..."},
                               {rest, "a mesh at rest", "FRAME"},
                               {bodies, "bodies", "--body FRAME..."},
                               {a_case, "a case file", "CASE.json"},
                               {a_log, "a log", "LOG"},
                               {queries, "queries", "QUERIES.csv"}};

// The kinds of input that these options are for, the options that they exclude there, and one that
// they need. An option with a different meaning for other kinds has a row for each meaning.
struct OptionRow {
  std::string options;
  unsigned kinds;
  std::string without = {}, beside = {};
};

const std::vector<OptionRow>& option_rows() {
  constexpr unsigned shapes = frames | rest | bodies, meshes = shapes | a_case,
                     steps = meshes | a_log, all = steps | queries;
  const std::string built_in = " --culling --start --pairs --arithmetic ",
                    of_steps = built_in +
                               "--detector --answers --no-oracle --second-opinion --keep --ply ";
  static const std::vector<OptionRow> rows = {
      {" --body --apart ", bodies},
      {" --rings --rest-distance --weld ", shapes},
      {" --share --from --follow --shrink-time --all-steps --junit ", a_log},
      {" --truth --method ", queries},
      {" --detector ", meshes, built_in + "--answers "},
      {" --detector ", a_log},
      {" --detector ", queries, " --method "},
      {" --answers ", meshes, built_in},
      {built_in + "--ply ", meshes},
      {" --adjacency ", meshes, {}, " --answers "},
      {" --no-oracle ", meshes, " --second-opinion "},
      {" --second-opinion --jobs --time --memory --fail-on-collision --keep ", steps},
      {" --separation ", meshes, of_steps},
      {" --separation ", queries},
      {" --offset ", bodies, of_steps + "--separation "},
      {" --isolation ", all, {}, " --detector "},
      {" --threads ", meshes},
      {" --threads ", a_log | queries, {}, " --detector "},
      {" --json ", all}};
  return rows;
}

Expected<void> refuse_options(Kind kind, const std::string& file,
                              const std::vector<std::string>& option_texts) {
  // The option's name between blanks, as it stands in a row.
  const auto name_in = [](const std::string& word) {
    return " " + word.substr(0, word.find(' ')) + " ";
  };
  const auto holds = [](const std::string& options, const std::string& name) {
    return options.find(name) != std::string::npos;
  };
  for (const auto& word : option_texts) {
    const OptionRow* last_row = nullptr;
    unsigned of = 0;
    for (const auto& row : option_rows()) {
      if (!holds(row.options, name_in(word))) continue;
      of |= row.kinds;
      if ((row.kinds & kind) != 0) last_row = &row;
    }
    BOOST_ASSERT(of != 0);
    std::vector<KindWords> takers, all;
    for (const auto& one : kinds) {
      if ((one.kind & of) != 0) takers.push_back(one);
      if (one.kind == kind) all.push_back(one);
    }
    if (!last_row)
      return Problem{
          fmt::format("{}is for {}, but the input is {} ({}): leave it out, or assay check {} {}",
                      name_in(word).substr(1), join(corpus::names_among(takers), " or "),
                      all[0].name, file, takers[0].input, word)};
    const auto is_beside = [&](const std::string& other) {
      return holds(last_row->beside, name_in(other));
    };
    if (!last_row->beside.empty() && std::ranges::none_of(option_texts, is_beside))
      return Problem{fmt::format("{}means nothing without{}(assay check --help lists options)",
                                 name_in(word).substr(1), last_row->beside)};
    for (const auto& other : option_texts) {
      if (holds(last_row->without, name_in(other)))
        return Problem{fmt::format("{} and{}do not go together (assay check --help lists options)",
                                   name_in(word).substr(1, name_in(word).size() - 2),
                                   name_in(other))};
    }
  }
  return outcome::success();
}

// Returns the kind of the input as a whole. Inputs of two kinds are refused, and so are two inputs
// if only one can be judged.
Expected<Kind> kind_of(const std::vector<std::string>& inputs, const BodyWords& words_of_bodies) {
  using corpus::InputKind;
  auto files = inputs;
  for (const auto& body : words_of_bodies) files.insert(files.end(), body.begin(), body.end());
  if (files.empty())
    return Problem{
        "INPUT is required: frames of a mesh, a case file, a log or query files; or --body for "
        "each mesh"};
  constexpr std::array names = {"a frame", "a case file", "a log", "a query file"};
  std::vector<InputKind> kinds;
  const auto text = [&](std::size_t i) {
    return fmt::format("{} is {}", files[i], names[static_cast<std::size_t>(kinds[i])]);
  };
  for (const auto& file : files)
    kinds.push_back(log_name(file).step ? InputKind::log : corpus::kind_of_file(file));
  // A log that is missing, or cut within its first bytes, does not stop the others from being
  // judged. Alone it is refused as unreadable.
  const bool are_logs = std::ranges::find(kinds, InputKind::log) != kinds.end();
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto start = corpus::read_start(log_name(files[i]).file, 1);
    if (!start && files.size() == 1) return start.error();
    if (are_logs && !start) kinds[i] = InputKind::log;
    if (kinds[i] == InputKind::answers)
      return Problem{fmt::format(
          "{} is a table of answers, which needs frames: assay check FRAME... --answers {}",
          files[i], shell_word(files[i]))};
    const bool is_alone = kinds[i] == InputKind::case_file;
    if (i > 0 && (kinds[i] != kinds[0] || is_alone))
      return Problem{fmt::format("{}, and {}: check one by one: assay check {}", text(0), text(i),
                                 shell_word(files[kinds[i] == InputKind::frames ? 0 : i]))};
  }
  constexpr std::array of_file = {frames, a_case, a_log, queries};
  const auto kind = of_file[static_cast<std::size_t>(kinds[0])];
  if (words_of_bodies.empty()) return kind == frames && files.size() == 1 ? rest : kind;
  if (kind != frames)
    return Problem{
        fmt::format("--body takes frames, but {}: assay check {}", text(0), shell_word(files[0]))};
  if (!inputs.empty())
    return Problem{fmt::format(
        "{} and --body do not go together: assay check --body FRAME... --body FRAME...", files[0])};
  return bodies;
}

bool counts_all(const CheckRequest& request) {
  return request.rings == 0 && request.rest_distance == 0 && !request.weld;
}

// Returns the input in words as they were typed.
std::string words_of(const CheckRequest& request) {
  std::string words = join(request.inputs, " ");
  for (const auto& files : request.question.bodies)
    words += fmt::format("{}--body {}", words.empty() ? "" : " ", join(files, " "));
  for (const auto& apart : request.apart) words += " --apart " + apart;
  if (request.rings > 0) words += fmt::format(" --rings {}", request.rings);
  if (request.rest_distance > 0) words += fmt::format(" --rest-distance {}", request.rest_distance);
  if (request.weld) words += " --weld";
  const auto& answers = request.question.answers;
  return answers.empty() ? words : words + " --answers " + answers;
}

// Returns the mesh and its steps. Fails if their readers fail.
Expected<CheckInput> read_input(Kind kind, const CheckRequest& request,
                                const CheckQuestion& question) {
  if (kind == a_log) return read_log(log_name(request.inputs.front()), request.selection);
  if (question.bodies.empty() && counts_all(request)) return read_check_input(request.inputs);
  return read_bodies(question.bodies.empty() ? BodyWords{request.inputs} : question.bodies,
                     {{},
                      question.apart,
                      static_cast<std::int32_t>(request.rings),
                      request.rest_distance,
                      request.weld});
}

// Returns the result of each claim of a log as a suite of JUnit XML. A broken claim fails; a claim
// about which the log says nothing, or not enough, is skipped.
std::string suite_of(const std::string& log, const CheckOutcome& outcome) {
  using State = ClaimResult::State;
  std::vector<JunitTest> tests;
  for (const auto& [claim, state, why] : outcome.claim_results()) {
    const char* element = state == State::broken ? "failure" : "skipped";
    tests.push_back({claim, state == State::holds ? "" : element, why});
  }
  return junit_suite(log, log, tests, join(outcome.asked_again, "\n"));
}
std::string suite_of(const std::string& log, const Problem& problem) {
  return junit_suite(log, log, {{"log", "error", problem.message}});
}

// Judges steps: of one mesh, or of one log, which adds its suite of JUnit XML.
Expected<int> check_steps(Kind kind, const CheckRequest& request, std::string& suites) {
  CheckQuestion question = request.question;
  const bool is_log = kind == a_log;
  for (const auto& word : request.inputs)
    question.files.push_back(is_log ? log_name(word).file : word);
  for (const auto& files : question.bodies)
    question.files.insert(question.files.end(), files.begin(), files.end());
  for (const auto& word : request.apart) question.apart.push_back(*two_numbers(word));
  if (!request.offsets.empty() && request.offsets.size() != question.bodies.size())
    return Problem{
        fmt::format("{} offsets for {} bodies: give one for each --body, in the same order",
                    request.offsets.size(), question.bodies.size())};
  auto keeping = request.keeping;
  keeping.origin = is_log ? question.files.front() : words_of(request);
  // The files are checked before the work, not after it.
  auto inputs = question.files;
  if (!question.answers.empty()) inputs.push_back(question.answers);
  BOOST_OUTCOME_TRY(may_fill(keeping.folder, {"page.html"}));
  BOOST_OUTCOME_TRY(may_write({request.json_file, request.junit_file, question.ply_file}, inputs));
  const std::filesystem::path ply(question.ply_file);
  if (!ply.empty() && ply.extension() != ".ply")
    return Problem{ply.string() + ": --ply writes PLY: its name has to end with .ply"};
  auto result = read_input(kind, request, question);
  if (!result) {
    if (is_log) suites += suite_of(request.inputs.front(), result.error());
    return result.error();
  }
  auto& input = result.value();
  question.wants_report = !request.json_file.empty();
  question.announced_file = request.json_file;
  question.again = this_command(PastePlace::any_folder);
  question.shows_all_steps = !is_log || request.all_steps;
  if (request.separation || !request.offsets.empty())
    question.distance = {request.separation.value_or(0), request.offsets};
  CheckListener terminal{[](const std::string& text) {
    fmt::print("{}", text);
    std::fflush(stdout);
  }};
  bool has_failed = false;
  terminal.on_failure = [&](const StepFailure&) {
    has_failed = true;
    return "";
  };
  BOOST_OUTCOME_TRY(answer, check_keeping(question, input, keeping, terminal));
  if (has_failed && !is_log)
    fmt::print("next: {} --keep kept\n", this_command(PastePlace::this_folder));
  if (question.wants_report) {
    BOOST_OUTCOME_TRY(write_json_file(request.json_file, answer.report));
  }
  if (is_log) suites += suite_of(request.inputs.front(), answer.outcome);
  return answer.outcome.end(request.fail_on_collision);
}

// Judges each log by itself, whatever the others are. Returns the worst exit code.
Expected<int> check_logs(const CheckRequest& request, std::string& suites) {
  if (!request.json_file.empty()) return Problem{"--json takes one log: check the logs one by one"};
  if (request.selection.follow) return Problem{"--follow takes one log"};
  BOOST_OUTCOME_TRY(may_fill(request.keeping.folder));
  std::vector<std::string> files;
  for (const auto& word : request.inputs) files.push_back(log_name(word).file);
  BOOST_OUTCOME_TRY(may_write({request.junit_file}, files));
  constexpr std::array from_best = {exit_holds,  exit_collision, exit_undecided,
                                    exit_defect, exit_unsound,   exit_usage};
  auto worst = from_best.begin();
  for (std::size_t i = 0; i < request.inputs.size(); ++i) {
    const auto& word = request.inputs[i];
    fmt::print("{}\n", word);
    auto one = request;
    one.inputs = {word};
    // Step 3 of one log is not that of another, and logs of two folders may have one name.
    const auto name = std::filesystem::path(log_name(word).file).filename().string();
    if (!one.keeping.folder.empty())
      one.keeping.folder = fmt::format("{}/{}-{}", request.keeping.folder, i + 1, name);
    const auto before = suites.size();
    const auto code = check_steps(a_log, one, suites);
    if (!code && suites.size() == before) suites += suite_of(word, code.error());
    worst =
        std::max(worst, std::ranges::find(from_best, code ? code.value() : refuse(code.error())));
  }
  return *worst;
}

Expected<int> run_check(const CheckRequest& request) {
  BOOST_OUTCOME_TRY(kind, kind_of(request.inputs, request.question.bodies));
  BOOST_OUTCOME_TRYV(refuse_options(
      kind, request.inputs.empty() ? request.question.bodies[0][0] : request.inputs[0],
      request.option_texts()));
  if (kind == a_log && !request.question.detector.library.empty() && request.keeping.folder.empty())
    return Problem{"for a log, --detector answers only kept steps: name their folder by --keep"};
  if (const auto& which = request.selection;
      kind == a_log && (which.share < 1 || which.from > 1) &&
      std::ranges::any_of(request.inputs,
                          [](const auto& word) { return log_name(word).step.has_value(); }))
    return Problem{
        "LOG#N is one step, and --share and --from choose among all steps: use one or the other"};
  if (kind == queries) {
    auto query_request = request.queries;
    query_request.files = request.inputs;
    query_request.separation = request.separation;
    query_request.detector = request.question.detector;
    query_request.detector.threads = std::max<std::uint64_t>(request.question.threads, 1);
    query_request.json_file = request.json_file;
    return check_queries(query_request);
  }
  std::string suites;
  const bool are_logs = kind == a_log && request.inputs.size() > 1;
  const auto code = are_logs ? check_logs(request, suites) : check_steps(kind, request, suites);
  if (!request.junit_file.empty() && !suites.empty()) {
    suites = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"assay\">\n" + suites;
    BOOST_OUTCOME_TRY(write_text_file(request.junit_file, suites + "</testsuites>\n"));
  }
  return code;
}

// Adds the options that choose steps of a log.
void add_selection(CLI::App& verb, LogSelection& selection) {
  add(verb, "--share SHARE", selection.share, "Judge this share of a log's steps")->check(share());
  add(verb, "--from N", selection.from, "Begin with this step of a log, counted from 1")
      ->check(in_range(1, std::numeric_limits<std::int64_t>::max()));
  verb.add_flag("--follow", selection.follow, "Wait for steps until the recorder ends the log");
}

void add_options(CLI::App& verb, CheckRequest& request) {
  auto& question = request.question;
  add(verb, "INPUT", request.inputs,
      "Frames of a mesh (OBJ, PLY, OFF; .gz too), whose steps are judged; one frame is a mesh at "
      "rest. Or one case file (.json). Or logs of a recorder (assay_record.h, assay.Recorder), "
      "each judged by itself; LOG#N is only step N. Or query files (.csv, .csv.gz)");
  add(verb, "--body FRAME", question.bodies,
      "The frames of one body, if the mesh has several bodies. Each --body is one body; bodies are "
      "numbered from 0. A body of one frame stands still");
  add(verb, "--apart A,B", request.apart,
      "A,B: bodies that do not meet; A,A: a body that does not meet itself")
      ->check(one_of("A,B: two bodies by number", two_numbers));
  add(verb, "--rings K", request.rings,
      "Leave out pairs of triangles that a path of fewer than K edges joins (1: those that share a "
      "vertex)")
      ->check(in_range(0, std::numeric_limits<std::int32_t>::max()));
  add(verb, "--rest-distance LENGTH", request.rest_distance,
      "Pairs of triangles that are nearer than this in the first frame do not count")
      ->check(length());
  verb.add_flag("--weld", request.weld,
                "Vertices of a body that stand at one place in every frame count as one vertex");
  add_selection(verb, request.selection);
  add_query_options(verb, request.queries);
  add_detector_alone(verb, question.detector,
                     "A plug-in's library, or python:MODULE:CLASS (default: built-in). For "
                     "queries: its query function answers. For a log: a plug-in with the recorded "
                     "detector's code, to shrink the kept steps");
  add_threads(verb, question.threads);
  add(verb, "--answers FILE", question.answers,
      "Judge the answers of this table (step,answer,time) in place of a detector");
  add_choice(verb, "--adjacency", question.adjacency, all_names<properties::Adjacency>(),
             from_name<properties::Adjacency>,
             "Which pairs of neighbours the answers of --answers cover (default all)");
  auto& built_in = question.built_in;
  add_choice(verb, "--culling", built_in.culling, all_names<detector::Culling>(),
             from_name<detector::Culling>, "How the detector culls (default auto)");
  add_choice(verb, "--start", built_in.start, all_names<detector::Start>(),
             from_name<detector::Start>, "What is known of the first frame (default verified)");
  add_choice(verb, "--pairs", built_in.pairs, all_names<detector::Pairs>(),
             from_name<detector::Pairs>, "Pairs asked of the built-in (default all)");
  add_choice(verb, "--arithmetic", built_in.arithmetic, all_names<detector::Arithmetic>(),
             from_name<detector::Arithmetic>, "The detector's arithmetic (default exact)");
  verb.add_flag("--no-oracle", question.no_oracle, "Run only the detector; prints `not judged`");
  add(verb, "--second-opinion SHARE", question.second_opinion,
      "Check the oracle itself by other methods, on this share of its questions")
      ->check(share());
  add(verb, "--separation LENGTH", request.separation,
      "Ask only the oracle: which triangles without a common vertex come within this distance, "
      "when first, and how near any two come. For queries: ask for this distance in place of "
      "contact, unless the query's rows state a distance")
      ->check(length());
  add(verb, "--offset LENGTH", request.offsets,
      "Like --separation, with a length for each --body in order: the distance for two triangles "
      "is the sum of their bodies' lengths")
      ->check(length());
  add_jobs(verb, question.jobs);
  add_limits(verb, question.time_limit, question.memory_limit);
  verb.add_flag(
      "--fail-on-collision", request.fail_on_collision,
      "Exit code 5 if detector and oracle agree on a collision, or if a step comes within "
      "--separation; for a log, if a collision is recorded and no answer breaks a claim");
  add(verb, "--keep DIR", request.keeping.folder,
      "Keep failing steps here: the part of the mesh that shows the failure, as case, OBJ and C++; "
      "for a plug-in, shrunk")
      ->group(OptionGroup::output);
  add(verb, "--shrink-time SECONDS", request.keeping.shrink_seconds,
      "For a log: time limit in seconds for shrinking a step")
      ->check(positive())
      ->capture_default_str()
      ->group(OptionGroup::limits);
  add(verb, "--ply FILE", question.ply_file,
      "Write the mesh at its first contact here: triangles in contact are red; at rest those that "
      "only touch are amber")
      ->group(OptionGroup::output);
  verb.add_flag("--all-steps", request.all_steps,
                "Print every step of a log, not only those that break a claim")
      ->group(OptionGroup::output);
  add(verb, "--junit FILE", request.junit_file,
      "Write the result of each claim of a log here, as JUnit XML")
      ->group(OptionGroup::output);
  add(verb, "--json FILE", request.json_file,
      "Write the report here (assay-check/1; for queries assay-queries/1)")
      ->group(OptionGroup::output);
  request.option_texts = [&verb] { return given_options(verb); };
}

}  // namespace

VerbAction add_check(CLI::App& app) {
  return make_verb(app, "check",
                   "Detector against oracle on the steps of one mesh; recorded answers of a "
                   "simulator; labelled queries",
                   add_options, run_check);
}

}  // namespace assay::reports
