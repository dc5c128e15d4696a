// Suite `peers`, and `--detector` for one plug-in, compare the detectors of others with the
// built-in detector.
#include <fmt/format.h>

#include <algorithm>

#include "properties/campaign/ledger/binding.h"
#include "properties/judging/exam.h"
#include "reports/bench/compared/comparison.h"
#include "reports/terminal/option_words.h"

namespace assay::reports {
namespace {

Eigen::Index triangles_of(const CaseFamily& family) {
  return family.cases().front().c.triangles.rows();
}

// Keeps, with --quick, only the two public sequences with the fewest triangles.
void keep_smallest_sequences(std::vector<CaseFamily>& families, BenchReport& report) {
  std::vector<std::pair<Eigen::Index, std::string>> sizes;
  for (const auto& family : families) {
    if (family.kind == "real") sizes.emplace_back(triangles_of(family), family.name);
  }
  std::sort(sizes.begin(), sizes.end());
  constexpr std::size_t most_built_in = 2;
  for (std::size_t i = most_built_in; i < sizes.size(); ++i) {
    const auto& name = sizes[i].second;
    std::erase_if(families, [&](const auto& family) { return family.name == name; });
    report.add_left_out(name, "left out: --quick takes only the two smallest sequences");
  }
}

// Returns the bytes for each triangle of a mesh of 20,480 triangles, for preprocessing and one
// step: the resident memory of a new process, less that for a mesh of 20 triangles. Nothing if a
// run does not complete.
std::optional<double> bytes_a_triangle(const BenchSubject& subject) {
  auto worker = subject.make_worker(60);
  const properties::Configuration configuration = {subject.name, subject.options, {}, true};
  constexpr int small = 20, large = 20'480, frames = 101;  // so many that a step moves little
  double peaks[2] = {}, triangles = 0;
  for (const int size : {small, large}) {
    auto scene = bench_scene("bend", size, frames);
    scene.frames.resize(2);
    const auto c = timed_case("", std::move(scene), subject.options.start).c;
    const auto run = run_alone(worker, c, configuration);
    if (!run.times || run.times->peak_bytes == 0) return std::nullopt;
    peaks[size == large ? 1 : 0] = static_cast<double>(run.times->peak_bytes);
    triangles = static_cast<double>(c.triangles.rows());
  }
  return (peaks[1] - peaks[0]) / triangles;
}

// Returns the plug-in and the built-in detector, which is asked for what the plug-in claims. If the
// plug-in takes any start, it has to verify each start, and the built-in detector does so too.
std::vector<BenchSubject> beside_built_in(const properties::Subject& plugin) {
  const auto& contract = plugin.detector.contract;
  const auto& claims = plugin.detector.claims;
  using detector::Culling, detector::Pairs;
  const detector::Options options = {
      .culling = contract.separation > 0 ? Culling::bvh : Culling::automatic,
      .pairs = claims.has(properties::Claim::all_pairs) ? Pairs::all : Pairs::first,
      .separation = contract.separation};
  std::vector<BenchSubject> subjects = {built_in_in_worker(options)};
  subjects[0].name = "built-in";
  subjects[0].error_claims = subjects[0].detector.claims;
  subjects[0].contract_of_input = contract;
  subjects[0].is_vouched_for = contract.start != properties::StartRule::any;
  BenchSubject subject{plugin};
  subject.name = plugin.description.name;
  if (subject.name == subjects[0].name) subject.name += " (plug-in)";
  subject.error_claims = claims;
  subjects.push_back(std::move(subject));
  return subjects;
}

// Returns a line for each sequence: the times of both, their ratio with its interval, the same for
// preprocessing, and errors.
std::string sequences_text(const std::vector<FamilyRow>& rows, const BenchSubject& plugin) {
  const auto text = [](std::uint64_t count) { return std::to_string(count); };
  const auto ms = [](const std::vector<double>& sums, std::uint64_t of) {
    if (sums.empty()) return std::string("-");
    return fmt::format("{:.3g}", median_of(sums).value / static_cast<double>(of));
  };
  const auto over = [](const std::vector<double>& sums, const std::vector<double>& built_in) {
    if (sums.empty()) return std::string("-");
    const auto ratio = ratio_of(sums, built_in);
    return fmt::format("{:.3g} [{:.3g}, {:.3g}]", ratio.value, ratio.lo, ratio.hi);
  };
  std::vector<std::vector<Column>> table;
  bool has_left_out = false;
  for (const auto& row : rows) {
    if (row.subject != plugin.name) continue;
    const auto& e = row.counts.errors;
    const auto left_out = row.counts.left_out;
    has_left_out |= left_out > 0;
    const auto steps =
        left_out ? fmt::format("{}-{}", e.steps + left_out, left_out) : text(e.steps);
    const auto remark = e.steps == 0           ? " no step within the contract"
                        : row.counts.ended > 0 ? " " + row.first_end
                                               : "";
    table.push_back({{"sequence", -20, row.family},
                     {"triangles", 9, text(row.triangles_of_case)},
                     {"steps", 5, steps},
                     {"a step", 9, ms(row.ms, row.steps_timed)},
                     {"built-in", 9, ms(row.reference_ms, row.steps_timed)},
                     {"over built-in", 22, over(row.ms, row.reference_ms)},
                     {"create", 9, ms(row.create_ms, row.cases_timed)},
                     {"built-in", 9, ms(row.reference_create_ms, row.cases_timed)},
                     {"over built-in", 22, over(row.create_ms, row.reference_create_ms)},
                     {"unsafe", 6, text(e.unsafe)},
                     {"alarms", 6, text(e.false_alarms)},
                     {"late", 9, text_of(e.late)},
                     {"early", 9, text_of(e.early)},
                     {"missing", 7, text(e.missing)},
                     {"spurious", 8, text(e.spurious)},
                     {"undecided", 9, text(e.undecided)},
                     {"", 0, remark}});
  }
  return table_text(table) +
         (has_left_out ? "steps 5-2: of 5 steps, 2 are left out by the contract\n" : "");
}

}  // namespace

BenchReport peers_suite(const BenchSettings& settings, const BenchProgress& progress) {
  BenchReport report{"peers"};
  progress.phase("peers");
  const auto peers = find_peers(settings.peers);
  std::vector<std::string> missing;
  auto families = all_families(settings, missing);
  for (const auto& file : missing) report.add_no_data("public sequence", file);
  if (settings.is_quick()) keep_smallest_sequences(families, report);
  constexpr double longest_repeated = 5;
  Comparison comparison(peers.subjects,
                        {.sweep = {.longest_repeated = longest_repeated},
                         .large_seconds = settings.case_seconds,
                         .jobs = settings.jobs},
                        report, progress);
  comparison.run(families);
  progress.phase("memory");
  auto rows = comparison.subjects();
  for (auto& row : rows) row.bytes_a_triangle = bytes_a_triangle(*row.subject);
  report.below = subjects_text(rows, "detector") + remarks_text(comparison, peers.absent);
  add_figures(rows, comparison, report);
  for (const auto& [name, why] : peers.absent)
    report.figures["absent_peers"].push_back(json_object("name", name, "why", why));
  return report;
}

BenchReport detector_suite(const BenchSettings& settings, const properties::Subject& plugin,
                           const BenchProgress& progress) {
  BenchReport report{"detector"};
  const auto subjects = beside_built_in(plugin);
  std::vector<std::string> missing;
  auto families = scene_families(settings);
  for (auto& real : real_families(settings, missing)) {
    constexpr Eigen::Index most_triangles_when_quick = 10'000;
    if (settings.is_quick() && triangles_of(real) > most_triangles_when_quick)
      report.add_left_out(real.name, "left out: it has more triangles than --quick takes");
    else
      families.push_back(std::move(real));
  }
  Comparison comparison(subjects, {.large_seconds = plugin.limits.seconds, .jobs = settings.jobs},
                        report, progress);
  comparison.run(families);
  for (const auto& file : missing) report.add_no_data("public sequence", file);
  report.above = plugin_text(plugin) +
                 fmt::format(
                     "\nbeside the built-in detector ({}, exact, {} pairs): medians of processor "
                     "time in ms, of all threads\n",
                     name_of(subjects[0].options.culling), name_of(subjects[0].options.pairs)) +
                 sequences_text(comparison.rows(), subjects[1]);
  add_figures(comparison.subjects(), comparison, report);
  report.figures["detector"] = json_object(
      "library", plugin.plugin->string(), "isolation", text_of(plugin.isolation), "threads",
      plugin.limits.threads, "contract", properties::json_of(plugin.description.contract));
  return report;
}

}  // namespace assay::reports
