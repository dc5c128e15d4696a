// `assay bench` runs one suite. It prints the rows, and writes the figures as JSON and CSV.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "corpus/problem.h"
#include "reports/bench/compared/comparison.h"
#include "reports/terminal/words.h"
#include "reports/terminal/work.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

struct BenchRequest {
  std::string suite;       // one of `suites`; if it is empty, a plug-in is timed
  DetectorWords detector;  // the plug-in; not asked for if there is a suite
  BenchSettings settings;
  bool is_quick = false;
  std::string json_file, csv_file;  // an empty name: not written
};

struct Suite {
  std::string_view name;
  RunSuite* run;
};
constexpr Suite suites[] = {{"stability", stability_suite},
                            {"speed-error", speed_error_suite},
                            {"sequences", sequences_suite},
                            {"peers", peers_suite}};

const Suite* suite_named(std::string_view name) {
  const auto* place = std::find_if(std::begin(suites), std::end(suites),
                                   [&](const Suite& suite) { return suite.name == name; });
  return place == std::end(suites) ? nullptr : place;
}

constexpr double quick_scale = .1;

Expected<BenchReport> measure(const BenchRequest& request) {
  auto settings = request.settings;
  if (request.is_quick) settings.scale = quick_scale;
  Progress line("bench " + (request.suite.empty() ? "--detector" : request.suite));
  const BenchProgress progress = {[&](const std::string& name) { line.phase(name); },
                                  [&] { line.tick(); }};
  if (!request.suite.empty()) return suite_named(request.suite)->run(settings, progress);
  // The plug-in is loaded once here, so that its faults are known before any work.
  BOOST_OUTCOME_TRY(plugin, choose_detector(request.detector, {.seconds = settings.case_seconds}));
  if (!plugin.description.parts.steps)
    return Problem{
        fmt::format("{}: it answers no steps, and only steps are timed", request.detector.library)};
  return detector_suite(settings, plugin, progress);
}

Expected<int> run_bench(const BenchRequest& request) try {
  if (request.suite.empty() && request.detector.library.empty())
    return Problem{"bench: say what to measure: --suite NAME or --detector LIB.so"};
  BOOST_OUTCOME_TRY(may_write({request.json_file, request.csv_file}));
  BOOST_OUTCOME_TRY(report, measure(request));
  fmt::print("suite {}, data {}\n", report.suite, request.settings.data);
  fmt::print("{}", text_of(report));
  const auto json =
      to_json(report, version_text()).dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
  for (const auto& [file, text] :
       {std::pair(request.json_file, json + "\n"), std::pair(request.csv_file, csv_of(report))}) {
    if (file.empty()) continue;
    BOOST_OUTCOME_TRY(write_text_file(file, text));
    fmt::print("wrote {}\n", file);
  }
  return report.wrong_answers.empty() ? exit_holds : exit_defect;
} catch (const UnusableData& problem) {
  return Problem{problem.what()};
}

void add_options(CLI::App& verb, BenchRequest& request) {
  const char* data = std::getenv("ASSAY_DATA");
  request.settings.data = data && *data ? data : "../shared/data";
  const auto names = join(corpus::names_among(suites), ", ");
  auto* suite = add(verb, "--suite NAME", request.suite, "What to measure: " + names)
                    ->check(one_of(names, suite_named));
  add_detector(
      verb, request.detector,
      "In place of a suite: a plug-in's library, or python:MODULE:CLASS. It is timed beside "
      "the built-in detector on scenes and public sequences, and judged by its claims")
      ->excludes(suite);
  add(verb, "--case-seconds SECONDS", request.settings.case_seconds,
      "Processor seconds that a plug-in may take for a sequence")
      ->check(positive())
      ->capture_default_str()
      ->group(OptionGroup::limits);
  add_jobs(verb, request.settings.jobs);
  verb.add_flag("--quick", request.is_quick,
                "A tenth of sizes and rounds: a first look, in a tenth of the time or so");
  add(verb, "--data DIR", request.settings.data,
      "Folder of the public data (default $ASSAY_DATA, else ../shared/data); rows without data say "
      "so");
  request.settings.peers = (properties::worker_program().parent_path() / "peers").string();
  add(verb, "--peers DIR", request.settings.peers,
      "For --suite peers: the folder of the plug-ins (default: the folder peers beside the "
      "program, where target `peers` builds them)");
  add(verb, "--json FILE", request.json_file, "Write all figures here (assay-bench/2)")
      ->group(OptionGroup::output);
  add(verb, "--csv FILE", request.csv_file, "Write the raw samples here")
      ->group(OptionGroup::output);
}

}  // namespace

VerbAction add_bench(CLI::App& app) {
  return make_verb(app, "bench", "Speeds and memory, beside their goals", add_options, run_bench);
}

}  // namespace assay::reports
