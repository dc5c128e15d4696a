// `assay bench`: one suite, its rows, its figures as JSON and CSV, its picture.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "reports/bench/suites.h"
#include "reports/pictures/gnuplot.h"
#include "reports/pictures/pictures.h"
#include "reports/steps/json_output.h"
#include "reports/terminal/complaint.h"
#include "reports/verbs/commands.h"

namespace assay::reports {
namespace {

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

}  // namespace

bool is_bench_suite(std::string_view name) { return suite_named(name) != nullptr; }

int run_bench(const BenchRequest& request) try {
  const Suite& suite = *suite_named(request.suite);
  for (const auto* file : {&request.json_file, &request.csv_file, &request.svg_file}) {
    if (auto problem = cannot_write(*file, {})) return refuse(*problem);
  }
  if (const auto problem = no_picture(request, suite); !problem.empty()) return refuse(problem);
  BenchReport report;
  {
    Progress progress("bench " + request.suite);
    report = suite.run({request.data}, progress);
  }
  fmt::print("suite {}, data {}\n{}", report.suite, request.data, text_of(report));
  const auto write = [](const std::string& file, const std::string& text) {
    const auto problem = write_text_file(file, text);
    if (!problem) fmt::print("wrote {}\n", file);
    return problem;
  };
  if (!request.json_file.empty()) {
    const auto text = to_json(report).dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
    if (auto problem = write(request.json_file, text + "\n")) return refuse(*problem);
  }
  if (!request.csv_file.empty()) {
    if (auto problem = write(request.csv_file, csv_of(report))) return refuse(*problem);
  }
  if (!request.svg_file.empty()) {
    const auto drawing = draw(suite.picture(report));
    if (!drawing.problem.empty()) return refuse(drawing.problem);
    if (auto problem = write(request.svg_file, drawing.svg)) return refuse(*problem);
  }
  return report.wrong_answers.empty() ? exit_holds : exit_defect;
} catch (const UnusableData& problem) {
  return refuse(problem.what());
}

}  // namespace assay::reports
