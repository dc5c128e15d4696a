// Suite `claims` checks what the thesis says of costs, and measures what whole steps take.
#include <fmt/format.h>

#include <algorithm>

#include "properties/as_printed.h"
#include "reports/bench/cases.h"
#include "reports/bench/parts/claims_parts.h"
#include "reports/bench/sweep.h"

namespace assay::reports {
namespace {

using namespace detector;

Estimate share(std::uint64_t part, std::uint64_t whole) {
  return exactly(static_cast<double>(part) / static_cast<double>(whole));
}

// Sweeps the one step of the case. The results in exact arithmetic have to agree with the
// first one's.
std::vector<SweptStep> swept(const corpus::Case& step, const std::vector<Options>& subjects,
                             int rounds, BenchReport& report) {
  std::vector<SweptStep> out;
  sweep_steps(step, subjects, rounds, [&](std::size_t, std::span<const SweptStep> done) {
    out.assign(done.begin(), done.end());
  });
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    if (out[i].differs)
      report.wrong_answers.push_back(step.id + ": two evaluations of one step differ");
    if (subjects[i].arithmetic == Arithmetic::exact)
      check_same_pairs(step.id, out[i].result, out[0].result, report);
  }
  return out;
}

// Compares the traditional scheme with bvh and view-point: box tests, candidates, time.
void compare_with_traditional(const corpus::Case& step, int rounds, BenchReport& report) {
  const auto done = swept(step,
                          {bench_options(Culling::bvh), bench_options(Culling::view_point),
                           bench_options(Culling::normal_cone)},
                          rounds, report);
  const auto &of_bvh = done[0].result.counts.search, &of_cones = done[2].result.counts.search;
  const auto& name = step.id;
  report.add(fmt::format("normal-cone: box tests over bvh's, {}", name), "times",
             share(of_cones.box_tests, of_bvh.box_tests), {},
             fmt::format("{} over {}, {} contour tests", of_cones.box_tests, of_bvh.box_tests,
                         of_cones.contour_tests));
  report.add(fmt::format("normal-cone: candidates over bvh's, {}", name), "times",
             share(of_cones.candidate_pairs, of_bvh.candidate_pairs), {},
             fmt::format("{} over {}", of_cones.candidate_pairs, of_bvh.candidate_pairs));
  report.add(fmt::format("normal-cone: time over bvh's, {}", name), "times",
             ratio_of(done[2].ns, done[0].ns));
  report.add(fmt::format("normal-cone: time over view-point's, {}", name), "times",
             ratio_of(done[2].ns, done[1].ns));
}

// Measures what the thesis as printed misses and saves, as a whole and deviation by deviation.
void measure_as_printed(const BenchSettings& settings, BenchReport& report) {
  const auto cases = static_cast<std::uint64_t>(settings.rounds(60));
  const auto table = properties::measure_toll("bench:as-printed", cases);
  const auto& right = table.rows.front();
  for (const auto& row : table.rows) {
    report.add(
        fmt::format("thesis as printed: steps missed, {}", row.name), "%",
        exactly(100. * static_cast<double>(row.silent + row.late + row.incomplete) /
                static_cast<double>(table.colliding)),
        {},
        fmt::format("of {} that collide: {} silent, {} late, {} incomplete; {} of {} pairs; "
                    "candidates {:.2f}, time without view test {:.2f} of the right ones",
                    table.colliding, row.silent, row.late, row.incomplete, row.pairs_missing,
                    table.pairs,
                    static_cast<double>(row.candidates) / static_cast<double>(right.candidates),
                    row.ms / right.ms));
  }
}

// Times the whole step: view cullings over bvh, and exact over double. What is wanted of rod-twist
// (bench_report.h) is asked of it alone.
void time_whole_step(const corpus::Case& step, int rounds, BenchReport& report) {
  const auto& name = step.id;
  const auto only_rods = [&](Wanted bound) { return wanted_if(name == "rod-twist", bound); };
  const auto done = swept(step,
                          {bench_options(Culling::bvh), bench_options(Culling::view_point),
                           bench_options(Culling::view_line), bench_options(Culling::view_auto),
                           bench_options(Culling::view_point, Arithmetic::double_precision)},
                          rounds, report);
  const auto &bvh = done[0], &point = done[1], &in_doubles = done[4];
  report.add(fmt::format("whole step, {}, bvh", name), "s", scaled(median_of(bvh.ns), 1e-9),
             only_rods(wanted::rod_twist_bvh_step_s),
             fmt::format("{} pairs", bvh.result.pairs.size()));
  report.add(fmt::format("broad phase, {}, bvh", name), "s",
             scaled(median_of(bvh.broad_phase_ns), 1e-9),
             only_rods(wanted::rod_twist_bvh_broad_phase_s), "of the same steps");
  constexpr const char* cullings[] = {"view-point", "view-line", "view-auto"};
  for (std::size_t i = 0; i < std::size(cullings); ++i) {
    const auto& [ns, broad_phase_ns, result, hash, differs] = done[i + 1];
    const double positive =
        static_cast<double>(result.view_positive) / static_cast<double>(step.triangles.rows());
    report.add(fmt::format("whole step, {}, {}", name, cullings[i]), "s",
               scaled(median_of(ns), 1e-9), only_rods(wanted::rod_twist_step_s),
               fmt::format("all pairs, exact, clean start; V+ {:.1f} %", 100 * positive));
    const auto of_views = result.counts.search.candidate_pairs,
               of_bvh = bvh.result.counts.search.candidate_pairs;
    report.add(fmt::format("K and closure: candidates over bvh's, {}, {}", name, cullings[i]),
               "times", share(of_views, of_bvh), only_rods(wanted::rod_twist_candidates_over_bvh),
               fmt::format("{} over {}", of_views, of_bvh));
    report.add(fmt::format("K and closure: time over bvh's, {}, {}", name, cullings[i]), "times",
               ratio_of(ns, bvh.ns), only_rods(wanted::rod_twist_step_over_bvh));
  }
  const auto& narrow = point.result.counts.narrow;
  report.add(fmt::format("exact over double, whole step, {}", name), "times",
             ratio_of(point.ns, in_doubles.ns), wanted::exact_over_double,
             fmt::format("view-point; integers decide {} of {} tests", narrow.rungs.by_integers(),
                         narrow.elementary_tests));
}

// Compares view-auto with bvh on a public sequence of an unclosed mesh, with default options, as
// `assay check` does: the start is verified, all pairs are asked for, arithmetic is exact.
void compare_unclosed(const std::string& name, const corpus::Sequence& sequence, int rounds,
                      BenchReport& report) {
  Options with_views, without;
  with_views.culling = Culling::view_auto;
  without.culling = Culling::bvh;
  const Options subjects[] = {with_views, without};
  const auto runs = sweep_runs(name, sequence, subjects, rounds, ns_of, report);
  const auto &of_auto = runs[0], &of_bvh = runs[1];
  const auto steps = of_bvh.results.size();
  const double per_step = 1e-6 / static_cast<double>(steps);
  const auto candidates = [](const SweptRun& run) {
    std::uint64_t sum = 0;
    for (const auto& result : run.results) sum += result.counts.search.candidate_pairs;
    return sum;
  };
  std::size_t steps_with_views = 0, most_against_all = 0;
  for (const auto& result : of_auto.results) {
    steps_with_views += result.doubts.empty() ? 0 : 1;
    most_against_all = std::max(most_against_all, result.against_all);
  }
  report.add(fmt::format("unclosed, {}, bvh", name), "ms a step",
             scaled(median_of(of_bvh.sums()), per_step), {},
             fmt::format("{} triangles, {} steps", sequence.triangles.rows(), steps));
  report.add(fmt::format("unclosed, {}, view-auto", name), "ms a step",
             scaled(median_of(of_auto.sums()), per_step), {},
             fmt::format("{} of {} steps use views; Vv {} at most", steps_with_views, steps,
                         most_against_all));
  report.add(fmt::format("unclosed, {}: candidates over bvh's, view-auto", name), "times",
             share(candidates(of_auto), candidates(of_bvh)), {},
             fmt::format("{} over {}", candidates(of_auto), candidates(of_bvh)));
  // If views do not pay, they may cost no more than a look at whether they do.
  report.add(fmt::format("unclosed, {}: time over bvh's, view-auto", name), "times",
             ratio_in_common(of_auto.sums(), of_bvh.sums()), wanted::view_auto_over_bvh);
}

// Steps that start clean. rod-twist, if it is there, is the last.
std::vector<corpus::Case> clean_steps(const BenchSettings& settings, BenchReport& report) {
  std::vector<corpus::Case> steps;
  const auto add = [&](const std::string& name, std::optional<corpus::Sequence> step,
                       const std::string& missing) {
    if (!step) return report.add_no_data(name, missing);
    step->frames.resize(2);
    steps.push_back(timed_case(name, std::move(*step), Start::clean).c);
  };
  for (const std::string scene : {"dented-sphere", "crumpling-sphere", "bend"}) {
    if (auto step = step_at_first_contact(scene, settings.triangles(20'000)))
      add(scene, std::move(step), "");
  }
  add("bunny", bent_bunny(settings), bunny_file(settings));
  add("rod-twist", rod_twist_step(settings), settings.file("scalable-ccd/rod-twist/frames"));
  return steps;
}

}  // namespace

BenchReport claims_suite(const BenchSettings& settings, const BenchProgress& progress) {
  BenchReport report("claims");
  progress.phase("steps");
  const auto steps = clean_steps(settings, report);
  progress.phase("box tests");
  measure_search(steps, settings, report);
  progress.phase("traditional scheme");
  for (const auto& step : steps) compare_with_traditional(step, settings.rounds(7), report);
  progress.phase("thesis as printed");
  measure_as_printed(settings, report);
  progress.phase("marking");
  measure_marking(settings, report);
  progress.phase("unclosed meshes");
  for (const auto& [name, label] :
       {std::pair("thick-cloth", "thick-cloth"), std::pair("kick", "codim-ipc-kick")}) {
    std::vector<std::string> missing;
    if (const auto real = real_sequence(settings, name, missing)) {
      compare_unclosed(label, real->frames, settings.rounds(9), report);
    } else {
      report.add_no_data(fmt::format("unclosed, {}", label), missing.front());
    }
  }
  progress.phase("free steps");
  count_traversals_of_free_steps(settings, report);
  progress.phase("whole steps");
  for (const auto& step : steps)
    time_whole_step(step, settings.rounds(step.id == "rod-twist" ? 7 : 11), report);
  measure_break_even(settings, progress, report);
  return report;
}

}  // namespace assay::reports
