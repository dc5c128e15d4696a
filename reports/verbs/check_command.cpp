// `assay check` takes consecutive frames as the steps of one mesh. Each step goes through the
// detector and, unless it is left out, the oracle, and the two are compared.
#include <fmt/format.h>

#include <boost/outcome/try.hpp>

#include "properties/judging/case_options.h"
#include "properties/worker/worker_process.h"
#include "reports/check/check_run.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/text_file.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

struct CheckRequest {
  std::vector<std::string> files;  // the frames of one mesh, or one case file
  CheckQuestion question;
  bool fail_on_collision = false;
  std::string json_file;  // empty: not written
};

Expected<int> run_check(const CheckRequest& request) {
  // This is asked before the work, not after it.
  BOOST_OUTCOME_TRY(may_write(request.json_file, request.files));
  BOOST_OUTCOME_TRY(input, read_check_input(request.files));
  CheckQuestion question = request.question;
  question.files = request.files;
  question.wants_report = !request.json_file.empty();
  question.announced_file = request.json_file;
  const CheckListener terminal{[](const std::string& text) {
                                 fmt::print("{}", text);
                                 std::fflush(stdout);
                               },
                               {}};
  BOOST_OUTCOME_TRY(answer, check_mesh(question, input, properties::worker_program(), terminal));
  if (question.wants_report) {
    BOOST_OUTCOME_TRY(write_json_file(request.json_file, answer.report));
  }
  return answer.outcome.exit_code(request.fail_on_collision);
}

void add_options(Verb& verb, CheckRequest& request) {
  verb.add("frames", request.files,
           "Two or more frames (OBJ, PLY, OFF; .gz too), or one case file (.json)")
      .required();
  auto plugin =
      add_detector_alone(verb, request.question.detector,
                         "A plug-in's library, or python:MODULE:CLASS (default: the built-in)");
  add_threads(verb, request.question.threads);
  auto& built_in = request.question.built_in;
  plugin
      .excludes(add_choice(verb, "--culling", built_in.culling, all_names<detector::Culling>(),
                           from_name<detector::Culling>, "How the detector culls (default auto)"))
      .excludes(add_choice(verb, "--start", built_in.start, all_names<detector::Start>(),
                           from_name<detector::Start>,
                           "What is known of the first frame (default verified)"))
      .excludes(add_choice(verb, "--pairs", built_in.pairs, all_names<detector::Pairs>(),
                           from_name<detector::Pairs>, "Which pairs are asked for (default all)"))
      .excludes(add_choice(verb, "--arithmetic", built_in.arithmetic,
                           all_names<detector::Arithmetic>(), from_name<detector::Arithmetic>,
                           "What the detector computes in (default exact)"));
  const auto no_oracle = verb.add_flag("--no-oracle", request.question.no_oracle,
                                       "Detector only; prints `not judged`");
  verb.add("--second-opinion", request.question.second_opinion,
           "Check the oracle itself by other methods, on this share of its questions")
      .with(share())
      .excludes(no_oracle);
  add_jobs(verb, request.question.jobs);
  verb.add("--time", request.question.time_limit,
           "Limit in seconds of processor time, all threads together; what is left is "
           "undecided")
      .with(positive());
  add_choice(verb, "--memory", request.question.memory_limit,
             "a whole number above 0, alone or with K, M or G", memory_size,
             "Limit of resident memory, such as 6GB or 512MB (MB: 2^20 bytes)");
  verb.add_flag("--fail-on-collision", request.fail_on_collision,
                "Exit code 5 when they agree on a collision");
  verb.add("--json", request.json_file, "Write the report here (assay-check/1)");
}

}  // namespace

Action add_check(CLI::App& app) {
  return make_verb(app, "check", "Detector against oracle on the steps of one mesh", add_options,
                   run_check);
}

}  // namespace assay::reports
