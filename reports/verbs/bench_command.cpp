// `assay bench`: one suite, its rows, its figures as JSON and CSV, its picture.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "reports/bench/suites.h"
#include "reports/pictures/gnuplot.h"
#include "reports/pictures/pictures.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/option_words.h"
#include "reports/terminal/text_file.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

struct BenchRequest {
  std::string suite;                          // one of `suites`
  std::string data;                           // folder of the public data
  std::string json_file, csv_file, svg_file;  // empty: none
};

struct Suite {
  std::string_view name;
  BenchReport (*run)(const BenchSettings&, Progress&);
  std::string (*picture)(const BenchReport&);  // a script for gnuplot, or null
};
constexpr Suite suites[] = {{"elementary", elementary_suite, nullptr},
                            {"view", view_suite, nullptr},
                            {"growth", growth_suite, growth_picture},
                            {"claims", claims_suite, share_picture},
                            {"stability", stability_suite, heat_picture},
                            {"speed-error", speed_error_suite, speed_error_picture},
                            {"harness", harness_suite, nullptr}};

const Suite* suite_named(std::string_view name) {
  for (const auto& suite : suites) {
    if (suite.name == name) return &suite;
  }
  return nullptr;
}

// Before the suite runs: a picture that cannot be drawn would be known minutes later.
std::string no_picture(const BenchRequest& request, const Suite& suite) {
  if (request.svg_file.empty()) return {};
  if (!suite.picture) {
    return "suite " + request.suite +
           " has no picture; growth, claims, stability and speed-error have one";
  }
  return cannot_draw();
}

int run_bench(const BenchRequest& request) try {
  const Suite& suite = *suite_named(request.suite);
  for (const auto* file : {&request.json_file, &request.csv_file, &request.svg_file}) {
    if (auto may = may_write(*file, {}); !may) return refuse(may.error());
  }
  if (const auto problem = no_picture(request, suite); !problem.empty()) return refuse(problem);
  BenchReport report;
  {
    Progress progress("bench " + request.suite);
    report = suite.run({request.data}, progress);
  }
  fmt::print("suite {}, data {}\n{}", report.suite, request.data, text_of(report));
  const auto write = [](const std::string& file, const std::string& text) {
    auto written = write_text_file(file, text);
    if (written) fmt::print("wrote {}\n", file);
    return written;
  };
  if (!request.json_file.empty()) {
    const auto text = to_json(report).dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
    if (auto done = write(request.json_file, text + "\n"); !done) return refuse(done.error());
  }
  if (!request.csv_file.empty()) {
    if (auto done = write(request.csv_file, csv_of(report)); !done) return refuse(done.error());
  }
  if (!request.svg_file.empty()) {
    const auto drawing = draw(suite.picture(report));
    if (!drawing.problem.empty()) return refuse(drawing.problem);
    if (auto done = write(request.svg_file, drawing.svg); !done) return refuse(done.error());
  }
  return report.wrong_answers.empty() ? exit_holds : exit_defect;
} catch (const UnusableData& problem) {
  return refuse(problem.what());
}

void add_options(Verb& verb, BenchRequest& request) {
  const char* data = std::getenv("ASSAY_DATA");
  request.data = data && *data ? data : "../shared/data";
  verb.add("--suite", request.suite, "What to measure")
      .with(
          one_of("elementary, view, growth, claims, stability, speed-error, harness", suite_named))
      .required();
  verb.add("--data", request.data,
           "Folder of the public data (default $ASSAY_DATA, else ../shared/data); rows of "
           "what is not there say so");
  verb.add("--json", request.json_file, "Write all figures here (assay-bench/1)");
  verb.add("--csv", request.csv_file, "Write the raw samples here");
  verb.add("--svg", request.svg_file,
           "Draw the suite's picture here (growth, claims, stability, speed-error; needs gnuplot)");
}

}  // namespace

Action add_bench(CLI::App& app) {
  return make_verb(app, "bench", "Speeds and memory beside what is wanted", add_options, run_bench);
}

}  // namespace assay::reports
