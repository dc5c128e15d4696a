#include "reports/bench/speed_error/error_output.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "properties/judging/case_check.h"
#include "reports/terminal/words.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const TimeErrors& errors) {
  return {{"steps", errors.steps},
          {"median_ulps", errors.median_ulps},
          {"largest_ulps", errors.largest_ulps},
          {"median_share", errors.median_share},
          {"largest_share", errors.largest_share}};
}

Json to_json(const ErrorCounts& counts) {
  return {{"steps", counts.steps},
          {"judged", counts.judged},
          {"contact", counts.contact},
          {"unsafe", counts.unsafe},
          {"alarming", counts.alarming},
          {"missed", counts.missed},
          {"false_alarms", counts.false_alarms},
          {"missing", counts.missing},
          {"spurious", counts.spurious},
          {"late", to_json(counts.late)},
          {"early", to_json(counts.early)}};
}

Json head_of(const Variant& variant) {
  return {{"arithmetic", properties::name_of(variant.arithmetic)},
          {"culling", properties::name_of(variant.culling)},
          {"pairs", properties::name_of(variant.pairs)}};
}

std::string time_text(const TimeErrors& errors) {
  if (errors.steps == 0) return "0";
  return fmt::format("{}: {:.2g}, {:.2g} ({:.1g})", errors.steps, errors.median_ulps,
                     errors.largest_ulps, errors.largest_share);
}

Json to_json(const ShareOfSteps& share) {
  return {{"share", share.share},
          {"interval", {share.lo, share.hi}},
          {"on_pareto_line", share.on_pareto_line}};
}

}  // namespace

Json to_json(const Estimate& estimate) {
  return {{"median", estimate.value},
          {"interval", {estimate.lo, estimate.hi}},
          {"samples", estimate.samples}};
}

std::string families_text(std::span<const FamilySummary> families) {
  std::vector<std::pair<std::string, int>> kinds;
  std::size_t count = 0, steps = 0;
  for (const auto& family : families) {
    if (family.variant != reference_variant) continue;
    ++count;
    steps += family.errors.steps;
    if (kinds.empty() || kinds.back().first != family.kind) kinds.emplace_back(family.kind, 0);
    ++kinds.back().second;
  }
  std::string list;
  for (const auto& [kind, number] : kinds) {
    list += fmt::format("{}{} {}", list.empty() ? "" : ", ", number, kind);
  }
  return fmt::format("{} families ({}), {} steps", count, list, steps);
}

std::string text_of(std::span<const VariantSummary> variants) {
  constexpr const char* line = "{:<11}{:<12}{:<6}{:<18} {:>9}{:>9}{:>7}{:>7}{:>8}{:>9}  {:<25}{}\n";
  std::string text =
      fmt::format(fmt::runtime(line), "arithmetic", "culling", "pairs", "time", "unsafe",
                  "alarming", "missed", "alarms", "missing", "spurious", "late", "early");
  const auto steps = [](std::size_t count, const ShareOfSteps& share) {
    return fmt::format("{}{}", count, share.on_pareto_line ? " *" : "  ");
  };
  for (const auto& v : variants) {
    const auto& e = v.errors;
    text +=
        fmt::format(fmt::runtime(line), properties::name_of(v.variant.arithmetic),
                    properties::name_of(v.variant.culling), properties::name_of(v.variant.pairs),
                    fmt::format("{:.2f} [{:.2f}, {:.2f}]", v.over_reference.value,
                                v.over_reference.lo, v.over_reference.hi),
                    steps(e.unsafe, v.unsafe), steps(e.alarming, v.alarming), e.missed,
                    e.false_alarms, e.missing, e.spurious, time_text(e.late), time_text(e.early));
  }
  return text;
}

Json to_json(std::span<const FamilySummary> families) {
  Json list = Json::array();
  for (const auto& f : families) {
    Json entry = {{"family", f.family}, {"kind", f.kind}};
    entry.update(head_of(f.variant));
    entry.update({{"hash", fmt::format("{:016x}", f.hash)},
                  {"ns_a_step", to_json(f.ns_a_step)},
                  {"ns_a_triangle", to_json(f.ns_a_triangle)},
                  {"time_over_reference", to_json(f.over_reference)},
                  {"box_tests", f.box_tests},
                  {"candidates", f.candidates},
                  {"elementary_tests", f.elementary_tests},
                  {"errors", to_json(f.errors)}});
    list.push_back(std::move(entry));
  }
  return list;
}

Json to_json(std::span<const VariantSummary> variants) {
  Json list = Json::array();
  for (const auto& v : variants) {
    Json entry = head_of(v.variant);
    entry.update({{"time_over_reference", to_json(v.over_reference)},
                  {"unsafe", to_json(v.unsafe)},
                  {"alarming", to_json(v.alarming)},
                  {"errors", to_json(v.errors)}});
    list.push_back(std::move(entry));
  }
  return list;
}

std::string csv_of(std::span<const JudgedStep> steps) {
  std::string text =
      "family,kind,case,step,triangles,arithmetic,culling,pairs,hash,box_tests,candidates,"
      "elementary_tests,judged,contact,missed,false_alarm,missing,spurious,late_ulps,early_ulps,"
      "late_share,early_share,ns\n";
  for (const auto& s : steps) {
    text +=
        fmt::format("{},{},{},{},{},{},{},{},", s.family, s.kind, s.case_id, s.step + 1,
                    s.triangles, properties::name_of(s.variant.arithmetic),
                    properties::name_of(s.variant.culling), properties::name_of(s.variant.pairs));
    text += fmt::format("{:016x},{},{},{},", s.hash, s.box_tests, s.candidates, s.elementary_tests);
    text += fmt::format("{:d},{:d},{:d},{:d},{},{},", s.judged, s.contact, s.missed, s.false_alarm,
                        s.missing, s.spurious);
    text += fmt::format("{},{},{},{},{}\n", s.first.late_ulps, s.first.early_ulps,
                        s.first.late_share, s.first.early_share, joined(s.ns, " "));
  }
  return text;
}

}  // namespace assay::reports
