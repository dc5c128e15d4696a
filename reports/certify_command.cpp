// `assay certify`: the shipped corpus and scenes through detector and oracle, with every culling.
//
// No certificate is issued yet: that takes the statistics of a random campaign, which this version
// does not have. What is printed is what was compared, and whether it holds.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "corpus/scenes.h"
#include "detector/detector.h"
#include "properties/case_check.h"
#include "reports/commands.h"
#include "reports/complaint.h"
#include "reports/json_output.h"

namespace assay::reports {
namespace {

using detector::Culling;
using properties::Outcome;

struct Row {
  std::string what;
  Culling culling = Culling::bvh;
  std::size_t cases = 0, steps = 0, collisions = 0, pairs = 0, defects = 0;
  double view_positive_share = 0;  // of triangles, mean over steps
  double detector_ms = 0, oracle_ms = 0;
  std::vector<std::string> failed;
};

double milliseconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
      .count();
}

corpus::Expected<Row> run_corpus(Culling culling, int jobs) {
  Row row;
  row.what = "curated cases";
  row.culling = culling;
  auto files = corpus::case_files(ASSAY_CORPUS_DIR);
  if (!files) return files.error();
  double positive = 0;
  for (const auto& file : files.value()) {
    auto c = corpus::read_case(file);
    if (!c) return c.error();
    const auto begin = std::chrono::steady_clock::now();
    const auto report = properties::check_case(c.value(), culling, jobs);
    row.oracle_ms += milliseconds_since(begin);
    ++row.cases;
    for (const auto& step : report.steps) {
      ++row.steps;
      row.collisions += step.result.answer == detector::Answer::collision ? 1 : 0;
      row.pairs += step.judgement.pairs.size();
      row.detector_ms += step.result.times.total;
      row.oracle_ms -= step.result.times.total;
      positive += static_cast<double>(step.result.view_positive) /
                  static_cast<double>(c.value().triangles.rows());
    }
    row.defects += report.outcome == Outcome::holds ? 0 : 1;
    for (const auto& line : report.failed) row.failed.push_back(c.value().id + ": " + line);
  }
  if (row.steps) row.view_positive_share = positive / static_cast<double>(row.steps);
  return row;
}

corpus::Expected<Row> run_scene_row(std::string_view name, Culling culling, int jobs) {
  Row row;
  row.what = name;
  row.culling = culling;
  row.cases = 1;
  // Small enough to judge every scene with every culling in a minute or two.
  corpus::SceneOptions options;
  options.size = 600;
  options.frames = 6;
  auto made = corpus::make_scene(name, options);
  if (!made) return made.error();
  const auto& sequence = made.value();
  auto detector =
      detector::Detector::create(sequence.triangles, sequence.frames[0],
                                 {culling, detector::Start::verified, detector::Pairs::all});
  if (!detector) {
    row.failed.push_back(row.what + ": " + detector.error().message);
    row.defects = 1;
    return row;
  }
  for (std::size_t s = 0; s + 1 < sequence.frames.size(); ++s) {
    const auto &x_t0 = sequence.frames[s], &x_t1 = sequence.frames[s + 1];
    const auto result = detector.value().step(x_t0, x_t1);
    const auto begin = std::chrono::steady_clock::now();
    const auto judgement = oracle::judge_step(x_t0, x_t1, sequence.triangles, {jobs, {}});
    row.oracle_ms += milliseconds_since(begin);
    row.detector_ms += result.times.total;
    const auto diff = properties::compare(result, judgement, detector::Pairs::all);
    ++row.steps;
    row.collisions += judgement.answer == detector::Answer::collision ? 1 : 0;
    row.pairs += judgement.pairs.size();
    row.view_positive_share += static_cast<double>(result.view_positive) /
                               static_cast<double>(sequence.triangles.rows()) /
                               static_cast<double>(sequence.frames.size() - 1);
    if (diff.outcome != Outcome::holds) {
      ++row.defects;
      row.failed.push_back(fmt::format(
          "{} step {}: {} missing, {} spurious, {} late, {} early pairs", name, s + 1,
          diff.missing.size(), diff.spurious.size(), diff.late.size(), diff.early.size()));
    }
  }
  return row;
}

void print_header() {
  fmt::print("{:<18} {:<11} {:>6} {:>6} {:>11} {:>7} {:>6} {:>12} {:>10} {:>8}\n", "input",
             "culling", "cases", "steps", "collisions", "pairs", "V+ %", "detector ms", "oracle ms",
             "defects");
}

void print(const Row& row) {
  fmt::print("{:<18} {:<11} {:>6} {:>6} {:>11} {:>7} {:>6} {:>12.1f} {:>10.1f} {:>8}\n", row.what,
             properties::name_of(row.culling), row.cases, row.steps, row.collisions, row.pairs,
             uses_views(row.culling) ? fmt::format("{:.0f}", 100 * row.view_positive_share) : "-",
             row.detector_ms, row.oracle_ms, row.defects);
  for (const auto& line : row.failed) fmt::print("  {}\n", line);
  std::fflush(stdout);
}

nlohmann::ordered_json json_of(const std::vector<Row>& rows, std::size_t defects) {
  nlohmann::ordered_json table = nlohmann::ordered_json::array();
  for (const auto& row : rows) {
    table.push_back(
        {{"input", row.what},
         {"culling", properties::name_of(row.culling)},
         {"cases", row.cases},
         {"steps", row.steps},
         {"collisions", row.collisions},
         {"pairs", row.pairs},
         {"view_positive_share",
          uses_views(row.culling) ? nlohmann::ordered_json(row.view_positive_share) : nullptr},
         {"detector_ms", row.detector_ms},
         {"oracle_ms", row.oracle_ms},
         {"defects", row.defects},
         {"failed", row.failed}});
  }
  return {{"schema", "assay-certify/1"}, {"version", version_text()},
          {"verdict", "incomplete"},     {"why", "no random campaign was run"},
          {"defects", defects},          {"rows", table}};
}

}  // namespace

int run_certify(const CertifyRequest& request) {
  std::error_code error;
  std::filesystem::create_directories(request.out, error);
  if (error) return refuse(fmt::format("{}: cannot be made: {}", request.out, error.message()));
  const std::string json_file = request.out + "/certify.json";
  fmt::print(
      "the shipped corpus and {} scenes through detector and oracle; a minute or two; writes {}\n",
      corpus::scenes().size(), json_file);
  print_header();
  std::vector<Row> rows;
  std::size_t defects = 0, steps = 0;
  const auto take = [&](corpus::Expected<Row> row) -> std::optional<std::string> {
    if (!row) return row.error().message;
    print(row.value());
    defects += row.value().defects;
    steps += row.value().steps;
    rows.push_back(std::move(row.value()));
    return std::nullopt;
  };
  for (const auto culling : {Culling::view_auto, Culling::view_point, Culling::view_line,
                             Culling::normal_cone, Culling::bvh}) {
    if (auto problem = take(run_corpus(culling, request.jobs))) return refuse(*problem);
    for (const auto& scene : corpus::scenes()) {
      if (auto problem = take(run_scene_row(scene.name, culling, request.jobs)))
        return refuse(*problem);
    }
  }
  if (auto problem = write_text_file(json_file, json_of(rows, defects).dump(1) + "\n"))
    return refuse(*problem);
  fmt::print("{} steps, {} defects. No certificate: this version runs no random campaign.\n", steps,
             defects);
  return defects ? exit_defect : exit_holds;
}

}  // namespace assay::reports
