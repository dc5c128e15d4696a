// Suite `harness` measures what judging costs, for the oracle by itself and for campaigns.
#include <fmt/format.h>

#include "oracle/mesh/step.h"
#include "properties/generators/families.h"
#include "properties/judging/trial.h"
#include "properties/queries/query_methods.h"
#include "properties/worker/case_run.h"
#include "reports/bench/cases.h"
#include "reports/bench/interleave.h"
#include "reports/bench/query_sets.h"
#include "reports/estimate.h"

namespace assay::reports {
namespace {

void judge_rod_twist(const corpus::Sequence& step, const BenchSettings& settings,
                     BenchReport& report) {
  constexpr int jobs = 2;
  std::size_t pairs = 0;
  const auto judge = [&] {
    const auto judgement =
        oracle::judge_step({step.frames[0], step.frames[1]}, step.triangles, {jobs, {}});
    pairs = judgement.pairs.size();
  };
  // The memory is measured first, because what is freed then goes back to the system, and none is
  // kept for reuse.
  const auto bytes = peak_memory_of(judge);
  const auto samples = interleave(settings.rounds(5), {[&] { return 1e-9 * wall_ns_of(judge); }});
  report.add("oracle, rod-twist step", "s", bootstrap_median(samples[0]),
             wanted::oracle_rod_twist_s,
             fmt::format("wall time, {} threads, {} pairs; bootstrap", jobs, pairs));
  if (!bytes) {
    report.add_no_data("oracle, rod-twist step, memory", "/proc/self");
    return;
  }
  constexpr double gigabyte = 1 << 30;
  report.add("oracle, rod-twist step, memory", "GB", exactly(*bytes / gigabyte),
             wanted::oracle_rod_twist_gb, "highest over what the mesh itself takes");
}

void ask_simulation_queries(const BenchSettings& settings, BenchReport& report) {
  const auto set = simulation_queries(settings);
  if (!set) {
    report.add_no_data("oracle, a simulation query, yes/no",
                       settings.file("scalable-ccd/rod-twist"));
    return;
  }
  const auto samples = interleave(settings.rounds(5), {[&] {
                                    return ns_of([&] {
                                      for (const auto& query : set->queries) {
                                        keep(oracle::contact_of(query, detector::Want::yes_no));
                                      }
                                    });
                                  }});
  const auto count = static_cast<double>(set->queries.size());
  report.add("oracle, a simulation query, yes/no", "us",
             scaled(bootstrap_median(samples[0]), 1e-3 / count), wanted::oracle_simulation_query_us,
             fmt::format("mean of {} queries; bootstrap over rounds", count));
}

// In the last steps of scene bend the mirrored ends of a tube meet, so many queries stay in one
// plane or meet on the border of a feature. The row is of the dearest step of any size.
void judge_bends(const BenchSettings& settings, BenchReport& report) {
  constexpr int frames = 21;
  Estimate dearest;
  std::string where;
  for (const int triangles : {180, settings.triangles(1'000), settings.triangles(10'000)}) {
    const auto scene = bench_scene("bend", triangles, frames);
    for (std::size_t step = 0; step + 1 < scene.frames.size(); ++step) {
      oracle::StepJudgement judged;
      const auto judge = [&] {
        judged =
            oracle::judge_step({scene.frames[step], scene.frames[step + 1]}, scene.triangles, {});
      };
      const auto samples = interleave(settings.rounds(5), {[&] { return ns_of(judge); }});
      const auto candidates = static_cast<double>(judged.feature_candidates);
      if (candidates == 0) continue;
      const Estimate each = scaled(bootstrap_median(samples[0]), 1e-3 / candidates);
      if (each.value <= dearest.value) continue;
      dearest = each;
      where = fmt::format(
          "dearest step: {} triangles, step {}, {} of {} queries by rung quadratic; bootstrap",
          scene.triangles.rows(), step, judged.rungs.quadratic, judged.feature_candidates);
    }
  }
  report.add("oracle, a feature candidate of the bend scene", "us", dearest,
             wanted::oracle_planar_candidate_us, where);
}

struct Trials {
  std::vector<double> steps, seconds;  // an entry for each case
  std::size_t defects = 0, most_triangles = 0;
};

// Judges cases as a campaign judges its trials, but without the pipe to the process in which its
// detector runs.
Trials judge_cases(const properties::Family& family, int cases) {
  const auto detector = properties::built_in_detector();
  Trials out;
  for (int i = 0; i < cases; ++i) {
    const auto id = fmt::format("harness:1:{}:{}", family.name, i);
    out.seconds.push_back(1e-9 * ns_of([&] {
                            const auto c = properties::make_case(family, id).c;
                            const auto truth = properties::judge_case(c);
                            for (const auto& configuration : detector.configurations) {
                              const auto run = properties::run_case(c, configuration);
                              const auto verdict =
                                  properties::judge_trial(c, truth, run, configuration, detector);
                              out.defects += verdict.outcome == properties::Outcome::defect;
                            }
                            out.steps.push_back(static_cast<double>(truth.size()));
                            out.most_triangles = std::max(
                                out.most_triangles, static_cast<std::size_t>(c.triangles.rows()));
                          }));
  }
  return out;
}

std::optional<Wanted> wanted_of(const properties::Family& family) {
  if (family.degenerate) return wanted::judged_degenerate_steps_a_second;
  if (family.name.find("generic") != std::string_view::npos)
    return wanted::judged_generic_steps_a_second;
  return std::nullopt;
}

void judge_family(const properties::Family& family, const BenchSettings& settings,
                  BenchReport& report) {
  const Trials trials = judge_cases(family, settings.rounds(400));
  report.add(fmt::format("judged steps a second and core, {}", family.name), "",
             bootstrap_ratio_of_sums(trials.steps, trials.seconds), wanted_of(family),
             fmt::format("oracle, and detector in {} configurations; {} cases up to {} triangles; "
                         "bootstrap over cases",
                         properties::built_in_detector().configurations.size(), trials.steps.size(),
                         trials.most_triangles));
  if (trials.defects > 0) {
    report.wrong_answers.push_back(
        fmt::format("{}: {} trials with a defect", family.name, trials.defects));
  }
}

}  // namespace

BenchReport harness_suite(const BenchSettings& settings, const BenchProgress& progress) {
  BenchReport report("harness");
  progress.phase("oracle, rod-twist");
  if (const auto step = rod_twist_step(settings)) {
    judge_rod_twist(*step, settings, report);
  } else {
    report.add_no_data("oracle, rod-twist step", settings.file("scalable-ccd/rod-twist/frames"));
  }
  progress.phase("oracle, queries");
  ask_simulation_queries(settings, report);
  progress.phase("oracle, scene bend");
  judge_bends(settings, report);
  for (const auto& family : properties::families()) {
    progress.phase(std::string(family.name));
    judge_family(family, settings, report);
  }
  return report;
}

}  // namespace assay::reports
