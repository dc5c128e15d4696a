// `assay answer-vectors` lets a plug-in, or the built-in detector, answer a conformance set.
#include <fmt/format.h>

#include "properties/vectors/answers.h"
#include "reports/check/detector_choice.h"
#include "reports/terminal/text_file.h"
#include "reports/terminal/words.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

struct AnswerVectorsRequest {
  std::string folder, out;
  DetectorWords detector;
  detector::Arithmetic arithmetic = detector::Arithmetic::exact;
  int jobs = 1;
};

Expected<int> answer_vectors(const AnswerVectorsRequest& request) {
  BOOST_OUTCOME_TRY(may_write({request.out}));
  BOOST_OUTCOME_TRY(read, properties::read_set(request.folder));
  properties::VectorResults results;
  if (request.detector.library.empty()) {
    results = properties::answers_of_built_in(read.set, request.arithmetic, request.jobs);
    results.version = ASSAY_VERSION;
  } else {
    BOOST_OUTCOME_TRY(subject, choose_detector(request.detector));
    BOOST_OUTCOME_TRY(answered, properties::answers_of_plugin(read.set, subject, request.jobs));
    results = std::move(answered);
  }
  BOOST_OUTCOME_TRY(write_text_file(request.out, results_text(results, read)));
  fmt::print("{} {}: {} cases answered in {:.1f} s\n", results.product, results.settings,
             results.answers.size(), results.seconds);
  fmt::print("next: {}\n",
             line_to_paste(fmt::format("score --set {} {}", shell_word(request.folder),
                                       shell_word(request.out)),
                           PastedIn::this_folder));
  return exit_holds;
}

void add_options(Verb& verb, AnswerVectorsRequest& request) {
  verb.add("DIR", request.folder, "The folder that holds set.json").required();
  verb.add("--out FILE", request.out, "Where the results file goes")
      .required()
      .in(OptionGroup::output);
  add_choice(verb, "--arithmetic", request.arithmetic, all_names<detector::Arithmetic>(),
             from_name<detector::Arithmetic>, "What the built-in detector computes in")
      .excludes(add_detector(verb, request.detector));
  add_jobs(verb, request.jobs);
}

}  // namespace

AddedVerb add_answer_vectors(CLI::App& app) {
  return make_verb(app, "answer-vectors",
                   "Let a plug-in, or the built-in detector, answer a conformance set", add_options,
                   answer_vectors);
}

}  // namespace assay::reports
