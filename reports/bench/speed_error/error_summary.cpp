#include "reports/bench/speed_error/error_summary.h"

#include <algorithm>
#include <functional>

#include "properties/campaign/gates/statistics.h"
#include "reports/bench/bootstrap.h"

namespace assay::reports {
namespace {

using Chosen = std::vector<const JudgedStep*>;

Chosen choose(std::span<const JudgedStep> steps,
              const std::function<bool(const JudgedStep&)>& wanted) {
  Chosen chosen;
  for (const auto& step : steps) {
    if (wanted(step)) chosen.push_back(&step);
  }
  return chosen;
}

TimeErrors time_errors(const Chosen& steps, double FirstTimeError::*ulps,
                       double FirstTimeError::*share) {
  std::vector<double> all_ulps, all_shares;
  for (const auto* step : steps) {
    if (!(step->first.*ulps > 0)) continue;
    all_ulps.push_back(step->first.*ulps);
    all_shares.push_back(step->first.*share);
  }
  if (all_ulps.empty()) return {};
  return {all_ulps.size(), quantile(all_ulps, 0.5), quantile(all_ulps, 1),
          quantile(all_shares, 0.5), quantile(all_shares, 1)};
}

ErrorCounts count(const Chosen& steps) {
  ErrorCounts counts;
  for (const auto* step : steps) {
    ++counts.steps;
    counts.judged += step->judged;
    counts.contact += step->contact;
    counts.unsafe += step->unsafe();
    counts.alarming += step->alarming();
    counts.missed += step->missed;
    counts.false_alarms += step->false_alarm;
    counts.missing += step->missing;
    counts.spurious += step->spurious;
  }
  counts.late = time_errors(steps, &FirstTimeError::late_ulps, &FirstTimeError::late_share);
  counts.early = time_errors(steps, &FirstTimeError::early_ulps, &FirstTimeError::early_share);
  return counts;
}

FamilySummary summary_of(const Chosen& steps) {
  FamilySummary out{steps.front()->family, steps.front()->kind, steps.front()->variant};
  std::vector<double> ns(steps.front()->ns.size()), reference(ns.size());
  out.hash = 0xcbf29ce484222325u;
  for (const auto* step : steps) {
    out.triangles += static_cast<double>(step->triangles);
    out.box_tests += static_cast<double>(step->box_tests);
    out.candidates += static_cast<double>(step->candidates);
    out.elementary_tests += static_cast<double>(step->elementary_tests);
    out.hash = (out.hash ^ step->hash) * 0x100000001b3u;
    for (std::size_t r = 0; r < ns.size(); ++r) {
      ns[r] += step->ns[r];
      reference[r] += step->reference_ns[r];
    }
  }
  out.over_reference = bootstrap_ratio(ns, reference);
  const Estimate total = bootstrap_median(std::move(ns));
  out.ns_a_step = scaled(total, 1 / static_cast<double>(steps.size()));
  out.ns_a_triangle = scaled(total, 1 / out.triangles);
  out.errors = count(steps);
  return out;
}

bool same_place(const FamilySummary& s, const std::string& family, const Variant& variant) {
  return s.family == family && s.variant == variant;
}

}  // namespace

ShareOfSteps share_of(std::size_t part, std::size_t all) {
  constexpr double risk_of_a_side = 0.025;
  ShareOfSteps out;
  if (all > 0) out.share = static_cast<double>(part) / static_cast<double>(all);
  out.hi = properties::upper_bound(part, all, risk_of_a_side);
  out.lo = 1 - properties::upper_bound(all - part, all, risk_of_a_side);
  return out;
}

std::vector<FamilySummary> by_family(std::span<const JudgedStep> steps) {
  std::vector<std::string> names;
  for (const auto& step : steps) {
    if (names.empty() || names.back() != step.family) names.push_back(step.family);
  }
  std::vector<FamilySummary> out;
  for (const auto& name : names) {
    for (const auto& variant : all_variants(true)) {
      const auto chosen = choose(steps, [&](const JudgedStep& step) {
        return step.variant == variant && step.family == name;
      });
      if (!chosen.empty()) out.push_back(summary_of(chosen));
    }
  }
  return out;
}

std::vector<VariantSummary> by_variant(std::span<const JudgedStep> steps,
                                       std::span<const FamilySummary> families) {
  std::vector<VariantSummary> out;
  for (const auto& variant : all_variants(true)) {
    std::vector<double> ratios;
    for (const auto& family : families) {
      if (family.variant == variant) ratios.push_back(family.over_reference.value);
    }
    if (ratios.empty()) continue;
    VariantSummary summary;
    summary.variant = variant;
    summary.over_reference = bootstrap_median(std::move(ratios));
    summary.errors =
        count(choose(steps, [&](const JudgedStep& step) { return step.variant == variant; }));
    summary.unsafe = share_of(summary.errors.unsafe, summary.errors.judged);
    summary.alarming = share_of(summary.errors.alarming, summary.errors.judged);
    out.push_back(std::move(summary));
  }
  for (const auto pairs : {detector::Pairs::all, detector::Pairs::first}) {
    for (const auto error : {&VariantSummary::unsafe, &VariantSummary::alarming}) {
      for (const auto& best : pareto_line(out, pairs, error)) {
        for (auto& summary : out) {
          if (summary.variant == best.variant) (summary.*error).on_pareto_line = true;
        }
      }
    }
  }
  return out;
}

std::vector<VariantSummary> pareto_line(std::span<const VariantSummary> summaries,
                                        detector::Pairs pairs,
                                        ShareOfSteps VariantSummary::*error) {
  std::vector<VariantSummary> sorted, line;
  for (const auto& summary : summaries) {
    if (summary.variant.pairs == pairs && summary.variant.culling != detector::Culling::none) {
      sorted.push_back(summary);
    }
  }
  std::sort(sorted.begin(), sorted.end(), [error](const auto& a, const auto& b) {
    return std::pair(a.over_reference.value, (a.*error).share) <
           std::pair(b.over_reference.value, (b.*error).share);
  });
  for (const auto& summary : sorted) {
    if (line.empty() || (summary.*error).share < (line.back().*error).share) {
      line.push_back(summary);
    }
  }
  return line;
}

Estimate time_over(std::span<const FamilySummary> families, const std::string& family,
                   const Variant& of, const Variant& over) {
  const auto find = [&](const Variant& variant) {
    return std::find_if(families.begin(), families.end(),
                        [&](const auto& s) { return same_place(s, family, variant); });
  };
  return bootstrap_ratio(find(of)->ns_a_step.samples, find(over)->ns_a_step.samples);
}

}  // namespace assay::reports
