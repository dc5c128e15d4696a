// `assay shrink` looks for the smallest case that fails like a given case.
#include <fmt/format.h>

#include "properties/campaign/phases/phases.h"
#include "properties/campaign/trials/trials.h"
#include "properties/judging/case_options.h"
#include "properties/judging/exam.h"
#include "properties/reducer/reducer.h"
#include "properties/worker/plugin/query_case.h"
#include "reports/check/step_answers.h"
#include "reports/pictures/case_scene.h"
#include "reports/terminal/words.h"
#include "reports/terminal/work.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

struct ShrinkRequest {
  std::vector<std::string> files;  // a case file, frames, or LOG#N
  std::string out;
  double seconds = 60;
  DetectorWords detector;
};

// Tells how the case fails.
struct Failing {
  std::string signature;
  properties::Configuration configuration;
  const properties::Law* law = nullptr;  // the law that it breaks; null if it breaks a claim
};

// Finds the first configuration in which the case breaks a claim, or else a law. Returns nothing
// if it holds.
std::optional<Failing> find_failure(const corpus::Case& c,
                                    const properties::DetectorUnderTest& detector,
                                    properties::WorkerProcess& worker) {
  for (const auto& configuration : detector.configurations) {
    const auto finding = properties::judge_of_detector(detector, configuration, worker)(c);
    if (finding) return Failing{finding->signature, configuration, nullptr};
  }
  if (!detector.built_in) return std::nullopt;
  const auto results = properties::examine({detector, detector.configurations, &worker}, c);
  const properties::TallyInput one{results, detector.configurations};
  const auto tally = properties::tally_cases({&one, 1}).front();
  if (tally.failures.empty()) return std::nullopt;
  const auto& failure = tally.failures.front();
  for (const auto& configuration : detector.configurations) {
    if (configuration.name == failure.configuration)
      return Failing{"law " + failure.law, configuration, properties::law_named(failure.law)};
  }
  return std::nullopt;
}

Expected<int> run_shrink(const ShrinkRequest& request) {
  end_when_interrupted("interrupted: smallest case so far: " + request.out, exit_undecided);
  BOOST_OUTCOME_TRY(may_write({request.out, picture_file(request.out)}, request.files));
  BOOST_OUTCOME_TRY(input, read_case_of(request.files));
  const auto& file = request.files.front();
  const corpus::Case& c = input;
  auto words = request.detector;
  const bool is_query = properties::says_query(c);
  if (is_query && words.library.empty())
    return Problem{fmt::format("{}: a query of a plug-in: name its library by --detector", file)};
  words.part = is_query ? DetectorPart::query : DetectorPart::steps;
  BOOST_OUTCOME_TRY(subject, choose_detector(words));
  const auto own = properties::read_configuration(is_query ? corpus::Case() : c, "the case's own");
  if (!own) return Problem{fmt::format("{}: {}", file, own.error().message)};
  if (subject.detector.built_in && !c.options.empty())
    subject.detector = subject.detector.in(own.value());
  auto worker = subject.process();
  const auto failing = find_failure(c, subject.detector, worker);
  if (!failing) {
    fmt::print("{}: holds in every configuration; there is nothing to shrink\n", file);
    return exit_holds;
  }
  fmt::print("{} ({}); at most {} s; writes {}\n", failing->signature, failing->configuration.name,
             request.seconds, request.out);
  std::fflush(stdout);
  PlainProgress progress("shrinking");
  Expected<void> status = outcome::success();
  const properties::ReduceLimits limits{request.seconds, 10'000'000};
  const properties::OnBetter keep = [&](const corpus::Case& better) {
    progress.show(properties::size_text(better));
    status = write_text_file(request.out, corpus::case_text(better));
  };
  keep(c);
  const auto reduction =
      failing->law
          ? properties::reduce(c, properties::judge_of_law(*failing->law, failing->configuration),
                               limits, keep)
          : properties::shrink_case(c, subject.detector, failing->configuration, worker, limits,
                                    keep);
  progress.finish();
  if (status) status = write_text_file(request.out, corpus::case_text(reduction.smallest));
  if (status) {
    SceneMaker scenes(words);
    status = scenes.write_picture(request.out, reduction.smallest, failing->configuration.name,
                                  failing->signature);
  }
  if (!status) return status.error();
  fmt::print("{}; {} runs, {:.1f} s{}\npicture {}\nreplay: {}\n",
             properties::size_text(c, reduction.smallest), reduction.calls, reduction.seconds,
             !reduction.fixed_point     ? "; the time was over"
             : reduction.fails_from > 0 ? "; " + properties::fails_from_text(reduction.fails_from)
                                        : "",
             picture_file(request.out),
             line_to_paste("replay " + shell_word(absolute_path(request.out)) +
                           detector_words(request.detector)));
  return exit_defect;
}

void add_options(CLI::App& verb, ShrinkRequest& request) {
  add(verb, "FILE", request.files,
      "A case file (.json), frames of one mesh, or LOG#N: step N of a log")
      ->required();
  add(verb, "--out FILE", request.out, "File for the smallest case")
      ->required()
      ->group(OptionGroup::output);
  add(verb, "--time SECONDS", request.seconds, "Time limit in seconds")
      ->check(positive())
      ->capture_default_str()
      ->group(OptionGroup::limits);
  add_detector(verb, request.detector);
}

}  // namespace

VerbAction add_shrink(CLI::App& app) {
  return make_verb(app, "shrink", "The smallest case that fails like a given case", add_options,
                   run_shrink);
}

}  // namespace assay::reports
