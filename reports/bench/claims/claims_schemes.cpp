#include <fmt/format.h>

#include "properties/as_printed.h"
#include "reports/bench/claims/claims_parts.h"
#include "reports/bench/interleave.h"
#include "reports/bench/same_answers.h"
#include "reports/bench/timed_step.h"

namespace assay::reports {
namespace {

using namespace detector;

void compare(const NamedStep& named, int rounds, BenchReport& report) {
  const auto& [name, step] = named;
  TimedStep bvh(name, step.triangles, step.frames, bench_options(Culling::bvh), report);
  TimedStep views(name, step.triangles, step.frames, bench_options(Culling::view_point), report);
  TimedStep cones(name, step.triangles, step.frames, bench_options(Culling::normal_cone), report);
  const auto samples = interleave(rounds, {[&] { return bvh.time(); }, [&] { return views.time(); },
                                           [&] { return cones.time(); }});
  const SearchCounts &of_bvh = bvh.result().counts.search, &of_cones = cones.result().counts.search;
  const auto share = [](std::uint64_t part, std::uint64_t whole) {
    return exactly(static_cast<double>(part) / static_cast<double>(whole));
  };
  report.add(fmt::format("normal-cone: box tests over bvh's, {}", name), "times",
             share(of_cones.box_tests, of_bvh.box_tests), {},
             fmt::format("{} over {}, {} contour tests", of_cones.box_tests, of_bvh.box_tests,
                         of_cones.contour_tests));
  report.add(fmt::format("normal-cone: candidates over bvh's, {}", name), "times",
             share(of_cones.candidate_pairs, of_bvh.candidate_pairs), {},
             fmt::format("{} over {}", of_cones.candidate_pairs, of_bvh.candidate_pairs));
  report.add(fmt::format("normal-cone: time over bvh's, {}", name), "times",
             ratio_of(samples[2], samples[0]));
  report.add(fmt::format("normal-cone: time over view-point's, {}", name), "times",
             ratio_of(samples[2], samples[1]));
  check_same_pairs(name, cones.result(), bvh.result(), report);
}

}  // namespace

void compare_with_traditional(const std::vector<NamedStep>& steps, const BenchSettings& settings,
                              BenchReport& report) {
  for (const auto& step : steps) compare(step, settings.rounds(7), report);
}

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

}  // namespace assay::reports
