// `assay bench`: one suite, its rows, its figures as JSON, its scatter as a picture.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "reports/bench/scatter_svg.h"
#include "reports/bench/suites.h"
#include "reports/commands.h"
#include "reports/complaint.h"
#include "reports/json_output.h"

namespace assay::reports {
namespace {

struct Suite {
  std::string_view name;
  BenchReport (*run)(const BenchSettings&, Progress&);
};
constexpr Suite suites[] = {{"elementary", elementary_suite}, {"view", view_suite},
                            {"growth", growth_suite},         {"claims", claims_suite},
                            {"stability", stability_suite},   {"speed-error", speed_error_suite}};

}  // namespace

bool is_bench_suite(std::string_view name) {
  for (const auto& suite : suites) {
    if (suite.name == name) return true;
  }
  return false;
}

int run_bench(const BenchRequest& request) try {
  for (const auto* file : {&request.json_file, &request.csv_file, &request.svg_file}) {
    if (auto problem = cannot_write(*file, {})) return refuse(*problem);
  }
  if (!request.svg_file.empty() && request.suite != "claims") {
    return refuse("--svg shows the scatter of suite claims; suite " + request.suite + " has none");
  }
  BenchReport report;
  {
    Progress progress("bench " + request.suite);
    for (const auto& [name, run] : suites) {
      if (name == request.suite) report = run({request.data}, progress);
    }
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
    if (auto problem = write(request.svg_file, scatter_svg(report.scatter))) {
      return refuse(*problem);
    }
  }
  return report.wrong_answers.empty() ? exit_holds : exit_defect;
} catch (const UnusableData& problem) {
  return refuse(problem.what());
}

}  // namespace assay::reports
