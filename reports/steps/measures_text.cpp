#include "reports/steps/measures_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "properties/judging/step_measures.h"
#include "properties/queries/query_families.h"
#include "reports/terminal/words.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

std::string percent(double share) { return fmt::format("{:.3g} %", 100 * share); }

// Gives "12 of 120, 10 % [5.3, 17]", for example.
std::string rate_text(const properties::Rate& rate) {
  if (rate.in == 0) return "-";
  return fmt::format("{} of {}, {} [{:.2g}, {:.2g}]", rate.of, rate.in, percent(rate.share()),
                     100 * rate.interval.lo, 100 * rate.interval.hi);
}

// Returns "3 by 0.002 (99 %: 0.01) to 0.5": the number of steps that are off, then of these steps
// the median, the value that 99 of 100 do not exceed, and the worst.
std::string off_text(const properties::TimesOff& off) {
  if (off.steps == 0) return "none";
  return fmt::format("{} by {:.2g} (99 %: {:.2g}) to {:.2g}", off.steps, off.quantile(0.5),
                     off.quantile(0.99), off.quantile(1));
}

std::string off_sentence(const char* word, const properties::TimesOff& off) {
  return fmt::format("{} in {} step{}, by {:.2g} at worst", word, off.steps,
                     off.steps == 1 ? "" : "s", off.quantile(1));
}

constexpr const char* row_format = "{:>32} {:>14} {:>10} {:>34} {:>34} {:>14} {:>26}";

// Returns the members of a contract that leave pairs out, in words.
std::vector<std::string> pairs_left_out(const properties::Contract& contract) {
  properties::Contract of_pairs;
  of_pairs.adjacency = contract.adjacency;
  of_pairs.features = contract.features;
  of_pairs.counts = contract.counts;
  of_pairs.rings = contract.rings;
  of_pairs.rest_distance = contract.rest_distance;
  of_pairs.separation = contract.separation;
  return properties::phrases_of(of_pairs);
}

// Tells on which meshes the claim `deterministic` was tried besides the trials.
std::string repeated_text(const properties::EvidenceFacts& evidence) {
  const auto repeated = evidence.rows_of(properties::Source::repeated);
  const auto sum = evidence.sum_of(properties::Source::repeated);
  if (repeated.empty()) return "";
  std::string lines;
  for (const auto& one : repeated) {
    if (!one.what.empty())
      lines += fmt::format("  {} {}: {}\n", one.broken ? "DIFFERS" : "not compared", one.input,
                           one.what);
  }
  return fmt::format(
      "on larger meshes: {} sequences of up to {} triangles, {} steps; {} sequences differ from "
      "run to run; {} steps judged, {} wrong\n{}",
      repeated.size(), sum.triangles, sum.steps,
      std::ranges::count(repeated, true, &properties::JudgedSource::broken), sum.cases, sum.defects,
      lines);
}

// Returns how much of the possible way a limiter used; empty if there is none.
std::string limits_text(const properties::LimitUse& use) {
  if (use.free + use.contact == 0) return "";
  std::string text = fmt::format("limits: {} of {} free steps cut", use.cut, use.free);
  if (use.contact == 0) return text + "\n";
  text += fmt::format(
      "; {} steps with a contact used this share of the time until the contact: median {:.3g}, in "
      "99 of 100 at least {:.3g}, worst {:.3g}; {} stalls{}\n",
      use.contact, use.share(0.5), use.share(0.01), use.share(0), use.stalled(),
      use.excused > 0
          ? fmt::format("; {} used less than claimed, perhaps because of rounding", use.excused)
          : "");
  for (const auto& [cause, count] : use.stalls)
    text += fmt::format("  stalled {} time{}: {}\n", count, count == 1 ? "" : "s", cause);
  return text;
}

Json rate_json(const properties::Rate& rate) {
  return {{"of", rate.of},
          {"in", rate.in},
          {"share", rate.share()},
          {"interval", {rate.interval.lo, rate.interval.hi}}};
}

Json times_off_json(const properties::TimesOff& off) {
  return {{"steps", off.steps},
          {"median", off.quantile(0.5)},
          {"p99", off.quantile(0.99)},
          {"worst", off.quantile(1)}};
}

Json limits_json(const properties::LimitUse& use) {
  Json stalls = Json::array(), shares = nullptr;
  for (const auto& [cause, steps] : use.stalls)
    stalls.push_back({{"cause", cause}, {"steps", steps}});
  if (use.contact > 0)
    shares = {{"median", use.share(0.5)}, {"p1", use.share(0.01)}, {"worst", use.share(0)}};
  return {{"free", use.free},       {"cut", use.cut}, {"contact", use.contact},
          {"excused", use.excused}, {"used", shares}, {"stalls", stalls}};
}

}  // namespace

std::string sizes_text(const Json& judged_up_to) {
  std::vector<std::pair<std::uint64_t, std::vector<std::string>>> sizes;
  for (const auto& claim : judged_up_to) {
    const auto size = claim["triangles"].get<std::uint64_t>();
    const auto entry = std::find_if(sizes.begin(), sizes.end(),
                                    [&](const auto& one) { return one.first == size; });
    auto& claims = entry == sizes.end() ? sizes.emplace_back(size, 0).second : entry->second;
    claims.push_back(claim["claim"].get<std::string>());
  }
  std::string text;
  for (const auto& [triangles, claims] : sizes) {
    text += fmt::format("{}of up to {}{}{}", text.empty() ? "meshes " : ", ", triangles,
                        text.empty() ? " triangles" : "",
                        sizes.size() == 1 ? "" : fmt::format(" ({})", join(claims, ", ")));
  }
  return text;
}

std::string extremes_text(const Json& extremes) {
  const auto count = [](const Json& number, const char* one, const char* many) {
    return fmt::format("{} {}", number.get<std::uint64_t>(), number == 1 ? one : many);
  };
  const auto& largest = extremes["largest"];
  return fmt::format(
      "largest tried: {} between two starts, {} at a vertex, {}, {}, {} in a step, "
      "{}; relations: {}",
      count(largest["steps_in_a_row"], "step", "steps"),
      count(largest["valence"], "triangle", "triangles"),
      count(largest["bodies"], "body", "bodies"),
      count(largest["components"], "component", "components"),
      count(largest["pairs"], "pair", "pairs"),
      count(largest["triangles"], "triangle", "triangles"),
      count(extremes["relations"], "case", "cases"));
}

std::string found_text(const Json& power) {
  return fmt::format("{} by random cases, {} by their curated case alone",
                     power["found_at_random"].get<std::uint64_t>(),
                     power["found_by_curated_case_alone"].get<std::uint64_t>());
}

std::string measures_head(bool of_queries) {
  const char* noun = of_queries ? "queries" : "steps";
  return fmt::format(row_format, fmt::format("free {} answered collision", noun), "answered free",
                     "spurious", fmt::format("late: {} by median (99 %) to worst", noun),
                     fmt::format("early: {} by median (99 %) to worst", noun), "left out",
                     "candidates / least");
}

std::string measures_row(const properties::StepMeasures& m, bool of_queries) {
  const auto misses = miss_rate(m);
  return fmt::format(
      row_format, rate_text(false_alarm_rate(m)),
      misses.in ? fmt::format("{} of {}", misses.of, misses.in) : "-",
      m.errors.answers() && !of_queries ? fmt::format("{:.3g}/step", spurious_pairs_a_step(m))
                                        : "-",
      off_text(m.errors.late), off_text(m.errors.early),
      m.redrawn + m.steps_left_out ? fmt::format("{} + {}", m.redrawn, m.steps_left_out) : "-",
      m.candidate_steps ? fmt::format("{} / {}, {:.3g}", m.candidates, m.least_candidates,
                                      candidates_over_least(m))
                        : "-");
}

std::string measures_sentence(const properties::StepMeasures& m) {
  std::vector<std::string> parts;
  const auto& e = m.errors;
  if (e.false_alarms > 0)
    parts.push_back(fmt::format("{} of {} free steps answered collision", e.false_alarms, e.free));
  if (e.missed > 0)
    parts.push_back(
        fmt::format("{} of {} steps with a contact answered free", e.missed, e.contact));
  if (e.spurious > 0) parts.push_back(fmt::format("{} spurious pairs", e.spurious));
  if (e.late.steps > 0) parts.push_back(off_sentence("late", e.late));
  if (e.early.steps > 0) parts.push_back(off_sentence("early", e.early));
  if (m.starts_near > 0)
    parts.push_back(fmt::format("{} step{} near or in contact at t = 0, not counted in n",
                                m.starts_near, m.starts_near == 1 ? "" : "s"));
  if (m.steps_left_out > 0)
    parts.push_back(fmt::format("{} steps left out by the contract", m.steps_left_out));
  if (m.refused > 0)
    parts.push_back(
        fmt::format("{} step{} refused: capacity", m.refused, m.refused == 1 ? "" : "s"));
  if (m.left_out_misses > 0)
    parts.push_back(fmt::format("{} step{} would be a miss if the contract left nothing out",
                                m.left_out_misses, m.left_out_misses == 1 ? "" : "s"));
  return (parts.empty() ? "" : fmt::format("whatever it claims: {}\n", join(parts, "; "))) +
         limits_text(e.limits);
}

std::string measures_text(const properties::RunFindings& findings) {
  if (findings.run.detector.built_in) return "";
  const bool alone = properties::asks_queries_alone(findings.run.plan);
  std::string out = fmt::format(
      "whatever is claimed (rates in %, with intervals of 95 %; late, early: how many first times "
      "are after or before the oracle's time, and by which share of the step: median, 99 %, worst; "
      "left out: cases + steps)\n{:24} {}\n",
      "stratum", measures_head(alone));
  for (const auto& stratum : findings.run.plan.strata)
    out += fmt::format("{:24} {}\n", stratum.family,
                       measures_row(findings.tally_of(stratum).measures,
                                    properties::is_query_family(stratum.family)));
  const auto all = findings.tally.counts.measures;
  out += fmt::format("{:24} {}\n", "all", measures_row(all, alone));
  if (all.refused > 0) out += fmt::format("`refused: capacity` in {} steps\n", all.refused);
  if (all.left_out_misses > 0)
    out += fmt::format(
        "in {} steps the detector does not report a contact, as its contract allows ({}): without "
        "this contract these steps would be misses\n",
        all.left_out_misses, join(pairs_left_out(findings.run.detector.contract), ", "));
  out += limits_text(all.errors.limits) + repeated_text(findings.evidence);
  for (const auto& [claim, reason] : properties::not_judged(findings))
    out += fmt::format("not judged: {}, because {}\n", claim, reason);
  return out;
}

Json measures_json(const properties::StepMeasures& m) {
  return {{"steps", m.errors.answers()},
          {"false_alarms", rate_json(false_alarm_rate(m))},
          {"answered_free", rate_json(miss_rate(m))},
          {"spurious_pairs", m.errors.spurious},
          {"spurious_pairs_a_step", spurious_pairs_a_step(m)},
          {"collisions", m.errors.collisions()},
          {"without_time", m.without_time},
          {"late", times_off_json(m.errors.late)},
          {"early", times_off_json(m.errors.early)},
          {"candidates",
           {{"steps", m.candidate_steps},
            {"given", m.candidates},
            {"least", m.least_candidates},
            {"over_least", candidates_over_least(m)}}},
          {"limits", limits_json(m.errors.limits)},
          {"near_at_start", m.starts_near},
          {"left_out",
           {{"cases_redrawn", m.redrawn},
            {"steps", m.steps_left_out},
            {"refused", m.refused},
            {"would_be_misses", m.left_out_misses}}}};
}

}  // namespace assay::reports
