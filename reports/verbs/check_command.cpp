// `assay check` takes consecutive frames as the steps of one mesh. Each step goes through the
// detector and, unless it is left out, the oracle, and the two are compared.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "properties/judging/case_options.h"
#include "properties/worker/worker_process.h"
#include "reports/check/separation_check.h"
#include "reports/judge/kept_failures.h"
#include "reports/terminal/option_words.h"
#include "reports/terminal/text_file.h"
#include "reports/terminal/words.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

struct CheckRequest {
  std::vector<std::string> files;  // the frames of one mesh, or one case file
  std::vector<std::string> apart;  // words "A,B"
  std::uint64_t rings = 0;
  double rest_distance = 0;
  bool weld = false;
  CheckQuestion question;
  std::optional<double> separation;
  std::vector<double> offsets;
  bool fail_on_collision = false;
  std::string json_file;  // empty: not written
  std::string keep;       // where failing steps are kept; empty: nowhere
};

bool counts_all(const CheckRequest& request) {
  return request.rings == 0 && request.rest_distance == 0 && !request.weld;
}

// The input in words as they were typed.
std::string words_of(const CheckRequest& request) {
  std::string words = joined(request.files, " ");
  for (const auto& files : request.question.bodies)
    words += fmt::format("{}--body {}", words.empty() ? "" : " ", joined(files, " "));
  for (const auto& apart : request.apart) words += " --apart " + apart;
  if (request.rings > 0) words += fmt::format(" --rings {}", request.rings);
  if (request.rest_distance > 0) words += fmt::format(" --rest-distance {}", request.rest_distance);
  if (request.weld) words += " --weld";
  const auto& answers = request.question.answers;
  return answers.empty() ? words : words + " --answers " + answers;
}

// Keeps what fails where the user wants that; a plug-in shrinks it.
Expected<std::unique_ptr<KeptFailures>> kept_failures(const CheckRequest& request) {
  if (request.keep.empty()) return std::unique_ptr<KeptFailures>();
  std::optional<properties::Subject> plugin;
  if (!request.question.detector.library.empty()) {
    auto words = request.question.detector;
    words.threads = std::max<std::uint64_t>(request.question.threads, 1);
    BOOST_OUTCOME_TRY(subject, choose_detector(words));
    plugin = std::move(subject);
  }
  // What failed may need all of the input.
  const auto again = [](std::uint64_t) { return this_command(PastedIn::any_folder); };
  return std::make_unique<KeptFailures>(request.keep, words_of(request), again, std::move(plugin));
}

Expected<int> run_check(const CheckRequest& request) {
  CheckQuestion question = request.question;
  question.files = request.files;
  for (const auto& files : question.bodies)
    question.files.insert(question.files.end(), files.begin(), files.end());
  if (question.files.empty())
    return Problem{
        "FRAME is required: frames of a mesh, or one case file; or --body for each mesh"};
  for (const auto& word : request.apart) question.apart.push_back(*two_numbers(word));
  if (!question.apart.empty() && question.bodies.empty())
    return Problem{"--apart is of bodies, which --body names"};
  if (!request.offsets.empty() && request.offsets.size() != question.bodies.size())
    return Problem{
        fmt::format("{} offsets for {} bodies: give one for each --body, in the same order",
                    request.offsets.size(), question.bodies.size())};
  // This is asked before the work, not after it.
  auto inputs = question.files;
  if (!question.answers.empty()) inputs.push_back(question.answers);
  BOOST_OUTCOME_TRY(may_fill(request.keep, {"page.html"}));
  BOOST_OUTCOME_TRY(may_write({request.json_file, request.question.ply_file}, inputs));
  const std::filesystem::path ply(request.question.ply_file);
  if (!ply.empty() && ply.extension() != ".ply")
    return Problem{ply.string() + ": --ply writes PLY, and a name ends with .ply"};
  if (!counts_all(request) && request.files.size() == 1 && request.files[0].ends_with(".json"))
    return Problem{
        "--rings, --rest-distance and --weld are of frames: a case file states what counts"};
  const auto read = [&]() -> corpus::Expected<CheckInput> {
    if (question.bodies.empty() && counts_all(request)) return read_check_input(request.files);
    return read_bodies(question.bodies.empty() ? BodyWords{request.files} : question.bodies,
                       {{},
                        question.apart,
                        static_cast<std::int32_t>(request.rings),
                        request.rest_distance,
                        request.weld});
  };
  BOOST_OUTCOME_TRY(input, read());
  question.wants_report = !request.json_file.empty();
  question.announced_file = request.json_file;
  question.again = this_command(PastedIn::any_folder);
  CheckListener terminal{[](const std::string& text) {
    fmt::print("{}", text);
    std::fflush(stdout);
  }};
  BOOST_OUTCOME_TRY(kept, kept_failures(request));
  bool has_failed = false;
  terminal.failed = [&](const FailedStep& failed) {
    has_failed = true;
    return kept ? kept->keep(failed) : "";
  };
  if (request.separation || !request.offsets.empty()) {
    const AskedDistance d = {request.separation.value_or(0), request.offsets};
    BOOST_OUTCOME_TRY(near,
                      check_separation(question, d, request.fail_on_collision, input, terminal));
    if (question.wants_report) {
      BOOST_OUTCOME_TRY(write_json_file(request.json_file, near.report));
    }
    return near.exit_code;
  }
  BOOST_OUTCOME_TRY(answer, check_mesh(question, input, properties::worker_program(), terminal));
  if (kept) {
    kept->end(answer);
  } else if (has_failed) {
    fmt::print("next: {} --keep kept\n", this_command(PastedIn::this_folder));
  }
  if (question.wants_report) {
    BOOST_OUTCOME_TRY(write_json_file(request.json_file, answer.report));
  }
  return answer.outcome.end(request.fail_on_collision);
}

void add_options(Verb& verb, CheckRequest& request) {
  const auto frames =
      verb.add("FRAME", request.files,
               "Frames (OBJ, PLY, OFF; .gz too), whose steps are judged; one alone: a mesh at "
               "rest. Or one case file (.json)");
  verb.add("--body FRAME", request.question.bodies,
           "The frames of one of several meshes, which become bodies of one; numbered from 0. One "
           "frame: it stands still")
      .excludes(frames);
  verb.add("--apart A,B", request.apart,
           "A,B: bodies that do not meet; A,A: one that meets not itself")
      .with(one_of("A,B: two bodies by number", two_numbers));
  verb.add("--rings K", request.rings,
           "Pairs of triangles that fewer than K edges join do not count (1: those that share a "
           "vertex)")
      .in_range(0, std::numeric_limits<std::int32_t>::max());
  verb.add("--rest-distance LENGTH", request.rest_distance,
           "Pairs of triangles that are nearer than this in the first frame do not count")
      .with(length());
  verb.add_flag("--weld", request.weld,
                "Vertices of a body that stand at one place in every frame count as one");
  auto plugin =
      add_detector_alone(verb, request.question.detector,
                         "A plug-in's library, or python:MODULE:CLASS (default: the built-in)");
  add_threads(verb, request.question.threads);
  auto answers =
      verb.add("--answers FILE", request.question.answers,
               "Judge the answers of this table (step,answer,time) in place of a detector")
          .excludes(plugin);
  add_choice(verb, "--adjacency", request.question.adjacency, all_names<properties::Adjacency>(),
             from_name<properties::Adjacency>,
             "Which neighbours --answers are about (default all)");
  auto& built_in = request.question.built_in;
  const std::array of_built_in = {
      add_choice(verb, "--culling", built_in.culling, all_names<detector::Culling>(),
                 from_name<detector::Culling>, "How the detector culls (default auto)"),
      add_choice(verb, "--start", built_in.start, all_names<detector::Start>(),
                 from_name<detector::Start>, "What is known of the first frame (default verified)"),
      add_choice(verb, "--pairs", built_in.pairs, all_names<detector::Pairs>(),
                 from_name<detector::Pairs>, "Which pairs are asked for (default all)"),
      add_choice(verb, "--arithmetic", built_in.arithmetic, all_names<detector::Arithmetic>(),
                 from_name<detector::Arithmetic>, "What the detector computes in (default exact)")};
  const auto no_oracle = verb.add_flag("--no-oracle", request.question.no_oracle,
                                       "Detector only; prints `not judged`");
  const auto second_opinion =
      verb.add("--second-opinion SHARE", request.question.second_opinion,
               "Check the oracle itself by other methods, on this share of its questions")
          .with(share())
          .excludes(no_oracle);
  auto separation =
      verb.add("--separation LENGTH", request.separation,
               "Ask the oracle alone which triangles that share no vertex come within this "
               "distance, when first, and how near any two come")
          .with(length())
          .excludes(plugin)
          .excludes(answers)
          .excludes(no_oracle)
          .excludes(second_opinion);
  auto offset = verb.add("--offset LENGTH", request.offsets,
                         "The same with a length for each --body, in their order: the distance of "
                         "two triangles is the sum of their bodies' lengths")
                    .with(length())
                    .excludes(plugin)
                    .excludes(answers)
                    .excludes(no_oracle)
                    .excludes(second_opinion)
                    .excludes(separation);
  for (const auto& option : of_built_in) {
    plugin.excludes(option);
    answers.excludes(option);
    separation.excludes(option);
    offset.excludes(option);
  }
  add_jobs(verb, request.question.jobs);
  add_limits(verb, request.question.time_limit, request.question.memory_limit);
  verb.add_flag("--fail-on-collision", request.fail_on_collision,
                "Exit code 5 when they agree on a collision, or a step comes within --separation");
  verb.add(
          "--keep DIR", request.keep,
          "Keep failing steps here: the part of the mesh that shows each, as case, OBJ and C++; of "
          "a plug-in shrunk")
      .excludes(separation)
      .excludes(offset)
      .in(OptionGroup::output);
  verb.add("--ply FILE", request.question.ply_file,
           "Write the mesh at its first contact here, with the triangles in contact in red, at "
           "rest those "
           "that only touch in amber")
      .excludes(separation)
      .excludes(offset)
      .in(OptionGroup::output);
  verb.add("--json FILE", request.json_file, "Write the report here (assay-check/1)")
      .in(OptionGroup::output);
}

}  // namespace

AddedVerb add_check(CLI::App& app) {
  return make_verb(app, "check", "Detector against oracle on the steps of one mesh", add_options,
                   run_check);
}

}  // namespace assay::reports
