// `assay bench` runs one suite. It prints the rows, and writes the figures as JSON and CSV and the
// picture.
#include <fmt/format.h>

#include <boost/outcome/try.hpp>
#include <nlohmann/json.hpp>

#include "reports/bench/gnuplot.h"
#include "reports/bench/suites.h"
#include "reports/bench/workers/detector_suite.h"
#include "reports/check/detector_choice.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/option_words.h"
#include "reports/terminal/progress.h"
#include "reports/terminal/text_file.h"
#include "reports/terminal/version.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

struct BenchRequest {
  std::string suite;         // one of `suites`; if it is empty, a plug-in is timed
  DetectorWords detector;    // the plug-in; not asked for if there is a suite
  double case_seconds = 60;  // the limit of one run of a sequence by the plug-in
  int jobs = 1;
  bool is_quick = false;
  std::string data;                           // the folder of the public data
  std::string peers;                          // the folder of the plug-ins of suite peers
  std::string json_file, csv_file, svg_file;  // an empty name: not written
};

struct Suite {
  std::string_view name;
  RunSuite* run;
  bool has_picture = false;
};
constexpr Suite suites[] = {
    {"elementary", elementary_suite},     {"view", view_suite},
    {"growth", growth_suite, true},       {"claims", claims_suite, true},
    {"stability", stability_suite, true}, {"speed-error", speed_error_suite, true},
    {"sequences", sequences_suite},       {"threads", threads_suite},
    {"peers", peers_suite, true},         {"harness", harness_suite}};

const Suite* suite_named(std::string_view name) {
  for (const auto& suite : suites) {
    if (suite.name == name) return &suite;
  }
  return nullptr;
}

// Says why no picture can be drawn. This is asked before the suite runs, because otherwise it
// would be known only minutes later.
std::string no_picture(const BenchRequest& request, const Suite* suite) {
  if (request.svg_file.empty()) return {};
  if (!suite || !suite->has_picture) {
    return (suite ? "suite " + request.suite : std::string("bench --detector")) +
           " has no picture; growth, claims, stability, speed-error and peers have one";
  }
  return cannot_draw();
}

// The plug-in. It is loaded once here, so that what is wrong with it is known before any work.
Expected<BenchedPlugin> plugin_of(const BenchRequest& request) {
  const auto& words = request.detector;
  BenchedPlugin plugin;
  plugin.library = words.library;
  plugin.jobs = request.jobs;
  plugin.limits.seconds = request.case_seconds;
  plugin.limits.isolation = words.isolation;
  plugin.limits.threads = words.threads;
  properties::WorkerProcess worker(properties::worker_program(), words.library, plugin.limits);
  BOOST_OUTCOME_TRY(description, worker.describe());
  plugin.description = std::move(description);
  plugin.limits.least = worker.isolation();
  if (!plugin.description.parts.steps)
    return Problem{fmt::format("{}: it holds no steps, which are what is timed", words.library)};
  return plugin;
}

constexpr double quick_scale = .1;

Expected<BenchReport> measure(const BenchRequest& request) {
  const BenchSettings settings{.data = request.data,
                               .scale = request.is_quick ? quick_scale : 1,
                               .peers = request.peers,
                               .case_seconds = request.case_seconds,
                               .jobs = request.jobs};
  Progress line("bench " + (request.suite.empty() ? "--detector" : request.suite));
  const BenchProgress progress = {[&](const std::string& name) { line.phase(name); },
                                  [&] { line.tick(); }};
  if (!request.suite.empty()) return suite_named(request.suite)->run(settings, progress);
  BOOST_OUTCOME_TRY(plugin, plugin_of(request));
  return detector_suite(settings, plugin, progress);
}

Expected<int> run_bench(const BenchRequest& request) try {
  if (request.suite.empty() && request.detector.library.empty())
    return Problem{"bench: --suite NAME, or --detector LIB.so, says what to measure"};
  const auto* suite = suite_named(request.suite);
  for (const auto* file : {&request.json_file, &request.csv_file, &request.svg_file}) {
    BOOST_OUTCOME_TRY(may_write(*file, {}));
  }
  if (const auto problem = no_picture(request, suite); !problem.empty()) return Problem{problem};
  BOOST_OUTCOME_TRY(measured, measure(request));
  const auto& report = measured;
  fmt::print("suite {}, data {}\n", report.suite, request.data);
  fmt::print("{}", text_of(report));
  const auto write = [](const std::string& file, const std::string& text) {
    auto written = write_text_file(file, text);
    if (written) fmt::print("wrote {}\n", file);
    return written;
  };
  if (!request.json_file.empty()) {
    const auto text = to_json(report, version_text())
                          .dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
    BOOST_OUTCOME_TRY(write(request.json_file, text + "\n"));
  }
  if (!request.csv_file.empty()) {
    BOOST_OUTCOME_TRY(write(request.csv_file, csv_of(report)));
  }
  if (!request.svg_file.empty()) {
    const auto drawing = draw(report.picture);
    if (!drawing.problem.empty()) return Problem{drawing.problem};
    BOOST_OUTCOME_TRY(write(request.svg_file, drawing.svg));
  }
  return report.wrong_answers.empty() ? exit_holds : exit_defect;
} catch (const UnusableData& problem) {
  return Problem{problem.what()};
}

void add_options(Verb& verb, BenchRequest& request) {
  const char* data = std::getenv("ASSAY_DATA");
  request.data = data && *data ? data : "../shared/data";
  auto suite =
      verb.add("--suite", request.suite, "What to measure")
          .with(one_of("elementary, view, growth, claims, stability, speed-error, sequences, "
                       "threads, peers, harness",
                       suite_named));
  add_detector(verb, request.detector,
               "In place of a suite: a plug-in's library, timed beside the built-in detector on "
               "scenes and public sequences, its answers judged by its claims")
      .excludes(suite);
  verb.add("--case-seconds", request.case_seconds,
           "Processor seconds that a plug-in may take for a sequence")
      .with(positive())
      .shows_default();
  add_jobs(verb, request.jobs);
  verb.add_flag("--quick", request.is_quick,
                "A tenth of sizes and rounds: a first look, in a tenth of the time or so");
  verb.add("--data", request.data,
           "Folder of the public data (default $ASSAY_DATA, else ../shared/data); rows of "
           "what is not there say so");
  request.peers = (properties::worker_program().parent_path() / "peers").string();
  verb.add("--peers", request.peers,
           "Suite peers: folder of the plug-ins (default: peers beside the program, where target "
           "`peers` builds them)");
  verb.add("--json", request.json_file, "Write all figures here (assay-bench/1)");
  verb.add("--csv", request.csv_file, "Write the raw samples here");
  verb.add("--svg", request.svg_file,
           "Draw the suite's picture here (growth, claims, stability, speed-error, peers; needs "
           "gnuplot)");
}

}  // namespace

Action add_bench(CLI::App& app) {
  return make_verb(app, "bench", "Speeds and memory beside what is wanted", add_options, run_bench);
}

}  // namespace assay::reports
