// Suite `peers` compares those detectors of others that are there with the built-in one, and
// `--detector` one plug-in.
#include <fmt/format.h>

#include <algorithm>

#include "properties/campaign/ledger/binding.h"
#include "reports/bench/compared/comparison.h"
#include "reports/terminal/option_words.h"

namespace assay::reports {
namespace {

// With --quick, keeps only the two public sequences of fewest triangles.
void keep_smallest_sequences(std::vector<CaseFamily>& families, BenchReport& report) {
  std::vector<std::pair<Eigen::Index, std::string>> sizes;
  for (const auto& family : families) {
    if (family.kind == "real")
      sizes.emplace_back(family.cases().front().c.triangles.rows(), family.name);
  }
  std::sort(sizes.begin(), sizes.end());
  constexpr std::size_t kept = 2;
  for (std::size_t i = kept; i < sizes.size(); ++i) {
    std::erase_if(families, [&](const auto& family) { return family.name == sizes[i].second; });
    report.add_left_out(sizes[i].second, "left out: --quick takes the two smallest sequences");
  }
}

// Bytes for each triangle of a mesh of 20,480 triangles, for preprocessing and one step: how far
// the resident memory of a new process rises above that with a mesh of 20 triangles. Nothing if a
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
    const auto run = worker.run(c, {&configuration, 1}).front();
    if (!run.times || run.times->peak_bytes == 0) return std::nullopt;
    peaks[size == large ? 1 : 0] = static_cast<double>(run.times->peak_bytes);
    triangles = static_cast<double>(c.triangles.rows());
  }
  return (peaks[1] - peaks[0]) / triangles;
}

// The plug-in beside the built-in detector, which answers what the plug-in claims. A plug-in that
// takes any start has to look at it, and then so does the built-in detector.
std::vector<BenchSubject> beside_built_in(const properties::Subject& plugin) {
  const auto& contract = plugin.detector.contract;
  const auto& claims = plugin.detector.claims;
  detector::Options options;
  options.pairs =
      claims.has(properties::Claim::all_pairs) ? detector::Pairs::all : detector::Pairs::first;
  if (contract.separation > 0) options.culling = detector::Culling::bvh;
  options.separation = contract.separation;
  std::vector<BenchSubject> subjects = {built_in_in_worker(options)};
  subjects[0].name = "built-in";
  subjects[0].counted = subjects[0].detector.claims;
  subjects[0].given = contract;
  subjects[0].is_vouched_for = contract.start != properties::StartRule::any;
  BenchSubject subject{plugin};
  subject.name = plugin.description.name;
  if (subject.name == subjects[0].name) subject.name += " (plug-in)";
  subject.counted = claims;
  subjects.push_back(std::move(subject));
  return subjects;
}

// A line for each sequence: the times of both, their ratio with its interval, the same for
// preprocessing, and errors.
std::string sequences_text(const std::vector<FamilyRow>& rows, const BenchSubject& plugin) {
  constexpr int widths[] = {-20, 9, 5, 9, 9, 22, 9, 9, 22, 6, 6, 9, 9, 7, 8, 9, -1};
  std::string text;
  const auto add_line = [&](const std::vector<std::string>& words) {
    text += table_line(std::span(widths).first(words.size()), words);
  };
  add_line({"sequence", "triangles", "steps", "a step", "built-in", "over built-in", "create",
            "built-in", "over built-in", "unsafe", "alarms", "late", "early", "missing", "spurious",
            "undecided"});
  bool has_left_out = false;
  for (const auto& row : rows) {
    if (row.subject != plugin.name) continue;
    const auto& e = row.counts.errors;
    const auto steps = e.steps, left_out = row.counts.left_out;
    has_left_out |= left_out > 0;
    const auto a_mesh = steps + left_out;
    std::vector<std::string> words = {
        row.family, std::to_string(row.triangles_of_case),
        left_out ? fmt::format("{}-{}", a_mesh, left_out) : std::to_string(steps)};
    const auto add_times = [&](const std::vector<double>& ms, const std::vector<double>& built_in,
                               std::uint64_t of) {
      if (ms.empty()) return words.insert(words.end(), 3, "-");
      const auto over = ratio_of(ms, built_in);
      for (const auto* one : {&ms, &built_in})
        words.push_back(fmt::format("{:.3g}", median_of(*one).value / static_cast<double>(of)));
      words.push_back(fmt::format("{:.3g} [{:.3g}, {:.3g}]", over.value, over.lo, over.hi));
      return words.end();
    };
    add_times(row.ms, row.reference_ms, row.steps_timed);
    add_times(row.create_ms, row.reference_create_ms, row.cases_timed);
    for (const auto& word : {std::to_string(e.unsafe), std::to_string(e.false_alarms),
                             text_of(e.late), text_of(e.early), std::to_string(e.missing),
                             std::to_string(e.spurious), std::to_string(e.undecided)})
      words.push_back(word);
    if (steps == 0) words.emplace_back(" beyond the contract");
    if (row.ended > 0) words.push_back(" " + row.first_end);
    add_line(words);
  }
  if (has_left_out) text += "steps 5-2: of 5, 2 are left out by the contract\n";
  return text;
}

}  // namespace

BenchReport peers_suite(const BenchSettings& settings, const BenchProgress& progress) {
  BenchReport report("peers");
  progress.phase("peers");
  const auto peers = find_peers(settings.peers);
  std::vector<std::string> missing;
  auto families = all_families(settings, missing);
  for (const auto& file : missing) report.add_no_data("public sequence", file);
  if (settings.scale < 1) keep_smallest_sequences(families, report);
  Comparison comparison(peers.subjects,
                        {.large_seconds = settings.case_seconds, .jobs = settings.jobs}, report,
                        progress.tick);
  for (const auto& family : families) {
    progress.phase(family.name);
    comparison.run(family);
  }
  progress.phase("memory");
  auto rows = by_subject(comparison.rows(), peers.subjects);
  for (auto& row : rows) row.bytes_a_triangle = bytes_a_triangle(*row.subject);
  report.below = subjects_text(rows, "detector") + remarks_text(comparison, peers.absent);
  add_figures(rows, comparison, report);
  for (const auto& [name, why] : peers.absent)
    report.add_figure("absent_peers", json_object("name", name, "why", why));
  return report;
}

BenchReport detector_suite(const BenchSettings& settings, const properties::Subject& plugin,
                           const BenchProgress& progress) {
  constexpr Eigen::Index most_triangles_when_quick = 10'000;
  BenchReport report("detector");
  const auto subjects = beside_built_in(plugin);
  Comparison comparison(
      subjects,
      {.large_seconds = plugin.limits.seconds, .longest_repeated = HUGE_VAL, .jobs = settings.jobs},
      report, progress.tick);
  std::vector<std::string> missing;
  auto families = scene_families(settings);
  for (auto& real : real_families(settings, missing)) families.push_back(std::move(real));
  for (const auto& family : families) {
    if (family.kind == "real" && settings.scale < 1 &&
        family.cases().front().c.triangles.rows() > most_triangles_when_quick) {
      report.add_left_out(family.name, "left out: of more triangles than --quick takes");
      continue;
    }
    progress.phase(family.name);
    comparison.run(family);
  }
  for (const auto& file : missing) report.add_no_data("public sequence", file);
  const auto& about = plugin.description;
  report.above = plugin_text(plugin) +
                 fmt::format(
                     "\nbeside the built-in detector, {}, exact, {} pairs; processor time in ms "
                     "with all threads, medians\n",
                     name_of(subjects[0].options.culling), name_of(subjects[0].options.pairs)) +
                 sequences_text(comparison.rows(), subjects[1]);
  add_figures(by_subject(comparison.rows(), subjects), comparison, report);
  report.figures["detector"] = json_object(
      "library", plugin.plugin->string(), "isolation", text_of(plugin.isolation), "threads",
      plugin.limits.threads, "contract", properties::json_of(about.contract));
  return report;
}

}  // namespace assay::reports
