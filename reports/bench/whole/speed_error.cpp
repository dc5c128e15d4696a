#include "reports/bench/whole/speed_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "oracle/mesh/step.h"
#include "reports/bench/sweep.h"

namespace assay::reports {

using detector::Culling;
using detector::Options;
using detector::Pairs;

std::vector<Variant> all_variants(bool with_none) {
  std::vector<Variant> variants = {reference_variant};
  for (const auto arithmetic : all_values<detector::Arithmetic>) {
    for (const auto culling : all_values<Culling>) {
      if (culling == Culling::none && !with_none) continue;
      for (const auto pairs : all_values<Pairs>) {
        const Variant variant{arithmetic, culling, pairs};
        if (variant != reference_variant) variants.push_back(variant);
      }
    }
  }
  return variants;
}

std::string name_of(const Variant& variant) {
  return std::string(name_of(variant.arithmetic)) + " " + name_of(variant.culling) + " " +
         name_of(variant.pairs);
}

namespace {

// A step that takes the oracle longer than this is timed and not judged.
constexpr std::chrono::seconds oracle_limit{20};

oracle::StepJudgement judge(const corpus::Case& c, const corpus::CaseStep& step) {
  const auto end = std::chrono::steady_clock::now() + oracle_limit;
  return oracle::judge_step({start_of(c, step), end_of(c, step)}, c.triangles,
                            {1, [end] { return std::chrono::steady_clock::now() > end; }});
}

}  // namespace

std::vector<VariantStep> run_case(const CaseFamily& family, const TimedCase& timed,
                                  std::vector<std::string>& wrong,
                                  const std::function<void()>& tick) {
  constexpr Eigen::Index most_triangles_for_none = 64;
  const auto& c = timed.c;
  const auto variants = all_variants(c.triangles.rows() <= most_triangles_for_none);
  std::vector<Options> options;
  for (const auto& v : variants) options.push_back({v.culling, timed.start, v.pairs, v.arithmetic});
  std::vector<VariantStep> done;
  const auto judge_all = [&](std::size_t s, std::span<const SweptStep> swept) {
    const auto truth = judge(c, corpus::steps_of(c)[s]);
    for (std::size_t v = 0; v < variants.size(); ++v) {
      const auto& [ns, broad_phase_ns, result, hash, differs] = swept[v];
      const auto& counts = result.counts;
      const auto complain = [&](const char* complaint) {
        wrong.push_back(fmt::format("{}, case {}, step {}, {}: {}", family.name, c.id, s + 1,
                                    name_of(variants[v]), complaint));
      };
      if (differs) complain("two evaluations differ");
      VariantStep out = {family.name,
                         family.kind,
                         c.id,
                         s,
                         static_cast<std::size_t>(c.triangles.rows()),
                         variants[v],
                         ns,
                         swept[0].ns,
                         hash,
                         counts.search.box_tests,
                         counts.search.candidate_pairs,
                         counts.narrow.elementary_tests,
                         {}};
      if (truth.complete) {
        out.errors = errors_of(properties::compare(
            result, truth, properties::claims_of({.pairs = variants[v].pairs}), {}, c.triangles));
        if (properties::compare(result, truth, properties::claims_of(options[v])).outcome !=
            properties::Outcome::holds)
          complain("refuted by the oracle");
      }
      done.push_back(std::move(out));
    }
  };
  sweep_steps(c, options, family.rounds, judge_all, tick);
  return done;
}

namespace {

FamilySummary summary_of(const std::vector<const VariantStep*>& steps) {
  const auto& first = *steps.front();
  FamilySummary out{first.family, first.kind, first.variant};
  std::vector<double> ns(first.ns.size()), reference(ns.size());
  out.hash = 0xcbf29ce484222325u;
  for (const auto* step : steps) {
    ++out.steps;
    out.triangles += static_cast<double>(step->triangles);
    out.box_tests += step->box_tests;
    out.candidates += step->candidates;
    out.elementary_tests += step->elementary_tests;
    out.hash = (out.hash ^ step->hash) * 0x100000001b3u;
    out.errors += step->errors;
    for (std::size_t r = 0; r < ns.size(); ++r) {
      ns[r] += step->ns[r];
      reference[r] += step->reference_ns[r];
    }
  }
  out.over_reference = bootstrap_ratio(ns, reference);
  const Estimate total = bootstrap_median(std::move(ns));
  out.ns_a_step = scaled(total, 1 / static_cast<double>(steps.size()));
  out.ns_a_triangle = scaled(total, 1 / out.triangles);
  return out;
}

// Marks the variants with these pairs that no other one beats in speed and error at once: fastest
// first, each with a smaller share of errors than all that are faster.
void mark_pareto_line(std::vector<VariantSummary>& summaries, Pairs pairs,
                      ShareOfSteps VariantSummary::*error) {
  std::vector<VariantSummary*> sorted;
  for (auto& summary : summaries) {
    if (summary.variant.pairs == pairs && summary.variant.culling != Culling::none)
      sorted.push_back(&summary);
  }
  std::sort(sorted.begin(), sorted.end(), [error](const auto* a, const auto* b) {
    return std::pair(a->over_reference.value, (a->*error).share) <
           std::pair(b->over_reference.value, (b->*error).share);
  });
  double least = 2;
  for (auto* summary : sorted) {
    auto& share = summary->*error;
    share.on_pareto_line = share.share < least;
    least = std::min(least, share.share);
  }
}

}  // namespace

std::vector<FamilySummary> by_family(std::span<const VariantStep> steps) {
  std::vector<FamilySummary> out;
  for (std::size_t begin = 0, end = 0; begin < steps.size(); begin = end) {
    while (end < steps.size() && steps[end].family == steps[begin].family) ++end;
    for (const auto& variant : all_variants(true)) {
      std::vector<const VariantStep*> chosen;
      for (const auto& step : steps.subspan(begin, end - begin)) {
        if (step.variant == variant) chosen.push_back(&step);
      }
      if (!chosen.empty()) out.push_back(summary_of(chosen));
    }
  }
  return out;
}

std::vector<VariantSummary> by_variant(std::span<const FamilySummary> families) {
  std::vector<VariantSummary> out;
  for (const auto& variant : all_variants(true)) {
    std::vector<double> ratios;
    VariantSummary summary;
    summary.variant = variant;
    for (const auto& family : families) {
      if (family.variant != variant) continue;
      ratios.push_back(family.over_reference.value);
      summary.errors += family.errors;
    }
    if (ratios.empty()) continue;
    summary.over_reference = bootstrap_median(std::move(ratios));
    summary.unsafe = share_of(summary.errors.unsafe, summary.errors.steps);
    summary.alarming = share_of(summary.errors.alarming, summary.errors.steps);
    out.push_back(std::move(summary));
  }
  for (const auto pairs : {Pairs::all, Pairs::first}) {
    mark_pareto_line(out, pairs, &VariantSummary::unsafe);
    mark_pareto_line(out, pairs, &VariantSummary::alarming);
  }
  return out;
}

Estimate time_over(std::span<const FamilySummary> families, const std::string& family,
                   const Variant& of, const Variant& over) {
  const auto samples = [&](const Variant& variant) {
    return std::find_if(families.begin(), families.end(),
                        [&](const auto& s) { return s.family == family && s.variant == variant; })
        ->ns_a_step.samples;
  };
  return bootstrap_ratio(samples(of), samples(over));
}

}  // namespace assay::reports
