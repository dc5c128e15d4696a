#include "reports/campaign/campaign_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "properties/campaign/ledger/tally.h"
#include "reports/steps/measures_text.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;
using properties::FaultProof;
using properties::FaultStatus;
using properties::GateState;
using properties::JudgedSource;
using properties::RunFindings;
using properties::Source;

// Returns a row for each family and configuration. If all configurations agree, they share one row.
std::string strata_text(const RunFindings& findings) {
  constexpr const char* row = "{:24} {:{}} {:>7} {:>7} {:>7} {:>9} {:>9} {:>9} {:>13}\n";
  // The only configuration of a plug-in has the plug-in's name, which may be long.
  std::size_t width = 18;
  for (const auto& configuration : findings.run.detector.configurations)
    width = std::max(width, configuration.name.size());
  std::string out = fmt::format(row, "stratum", "configuration", width, "n", "holds", "defects",
                                "undecided", "bound", "wanted", "steps/s/core");
  for (const auto& stratum : findings.run.plan.strata) {
    const auto& tally = findings.tally_of(stratum);
    const auto& all = tally.by_configuration;
    const auto configurations = configurations_in(findings.run.detector, stratum.family);
    const bool all_same = configurations_agree(findings, stratum);
    const double seconds = 1e-6 * static_cast<double>(tally.oracle_us + tally.detector_us);
    for (std::size_t c = 0; c < (all_same ? std::min<std::size_t>(all.size(), 1) : all.size()); ++c)
      out += fmt::format(
          row, c == 0 ? stratum.family : "",
          all_same && configurations.size() > 1 ? fmt::format("each of {}", configurations.size())
                                                : configurations[c].name,
          width, all[c].trials(), all[c].holds, all[c].defects, all[c].open(),
          fmt::format("{:.2e}", bound_of(all[c], stratum, findings.run)),
          stratum.wanted_bound > 0 ? fmt::format("{:.0e}", stratum.wanted_bound) : "-",
          c == 0 && seconds > 0 ? fmt::format("{:.0f}", static_cast<double>(tally.steps) / seconds)
                                : "");
  }
  return out;
}

// Returns the trials that were killed from outside and ran again, and those near their limit.
std::string disturbance_text(const RunFindings& findings) {
  const auto& tally = findings.tally;
  std::string out;
  if (tally.disturbances > 0)
    out += fmt::format("{} trials ran again: their worker was killed from outside ({} times)\n",
                       tally.disturbed(), tally.disturbances);
  if (tally.near_limit.empty()) return out;
  out +=
      fmt::format("{} trials took more than a third of the limit of {} s:", tally.near_limit.size(),
                  findings.run.plan.case_seconds);
  constexpr std::size_t most = 5;
  for (std::size_t i = 0; i < std::min(most, tally.near_limit.size()); ++i)
    out += fmt::format("{} {} ({:.1f} s)", i ? "," : "", tally.near_limit[i].id,
                       1e-6 * static_cast<double>(tally.near_limit[i].slowest_us));
  return out + (tally.near_limit.size() > most ? ", ...\n" : "\n");
}

// Returns the table of laws. For a plug-in closeness is unknown; its claims allow some answers that
// differ in two forms of a case.
std::string laws_text(const RunFindings& findings) {
  const auto premises = findings.laws_are_judged() ? findings.run.plan.law_premises : 0;
  const bool built_in = findings.run.detector.built_in;
  const auto laws = properties::laws_in(findings.tally.counts, built_in);
  if (laws.empty()) return "";
  std::string out = fmt::format("\n{:52} {:>9} {:>7} {:>7}\n", "law", "premise",
                                built_in ? "close" : "broken", built_in ? "broken" : "differs");
  for (const auto& [law, tally] : laws) {
    if (!built_in) {
      out += fmt::format("{:52} {:>9} {:>7} {:>7}\n", law->name, tally.premise, tally.broken,
                         tally.differs);
      continue;
    }
    const double close = tally.premise ? 100.0 * static_cast<double>(tally.close) /
                                             static_cast<double>(tally.premise)
                                       : 0.0;
    out += fmt::format("{:52} {:>9} {:>6.0f}% {:>7}{}\n", law->name, tally.premise, close,
                       tally.broken,
                       properties::starved(*law, tally, premises).empty() ? "" : "  too few");
    std::string under;
    for (const auto& [culling, premise] : properties::premises_by_culling(tally, *law)) {
      under += fmt::format("{}{} {}", under.empty() ? "" : ", ", culling, premise);
    }
    if (!under.empty()) out += fmt::format("    premise by culling: {}\n", under);
  }
  return out;
}

const char* word_of(const FaultProof& proof) {
  switch (proof.status) {
    case FaultStatus::planted:
      return proof.is_found() ? "found" : proof.time_over ? "the time was over" : "NOT FOUND";
    case FaultStatus::open:
      return proof.is_found() ? "found: no longer open" : "open";
    case FaultStatus::equivalent:
      return proof.is_found() ? "FOUND, but registered as equivalent" : "survives, rightly";
  }
  return "";
}

std::string faults_text(const RunFindings& findings, const Json& power) {
  const auto count =
      fmt::format("{} of {} planted faults found: {}", power["found"].get<std::uint64_t>(),
                  power["planted"].get<std::uint64_t>(), found_text(power));
  if (const auto& hunt_power = findings.evidence.power; !hunt_power.empty())
    return fmt::format("{}; campaign {}, seed {}, of this build\n", count, hunt_power[0].campaign,
                       hunt_power[0].seed);
  std::string out = fmt::format("{:44} {:18} {:>10} {:>12} {:>9}  {}\n", "fault", "law", "cases",
                                "curated", "vertices", "verdict");
  for (const auto& proof : findings.evidence.faults) {
    const auto* fault = properties::find_fault(proof.fault);
    const auto median = proof.median();
    out += fmt::format("{:44} {:18} {:>10} {:>12} {:>9}  {}\n", proof.fault, proof.law,
                       median ? fmt::format("{}", *median) : "-",
                       fault && fault->curated.empty() ? "-" : (proof.curated ? "yes" : "no"),
                       proof.known_vertices ? fmt::format("{}", proof.known_vertices) : "-",
                       word_of(proof));
  }
  return out + count + "\n";
}

// Returns the results of the search; empty if none was asked for.
std::string search_text(const RunFindings& findings) {
  const auto sum = findings.evidence.sum_of(Source::search);
  if (sum.planned == 0) return "";
  return fmt::format("search: {} cases, {} with a defect, {} causes of contact archived\n",
                     sum.cases, sum.defects, sum.causes.size());
}

std::string worlds_text(const RunFindings& findings) {
  std::string out = "every motion of a tetrahedron on a grid, up to symmetry:\n";
  for (const auto& world : findings.evidence.worlds) {
    out += fmt::format("  {:18} {} classes proved, which are {} of {} motions{}; {} collide\n",
                       world.world, world.classes, world.motions, world.all,
                       world.counterexample ? "; COUNTEREXAMPLE: " + *world.counterexample
                       : world.complete     ? ", complete"
                                            : ", the time was over",
                       world.collisions);
  }
  return out;
}

// Returns on which sizes claims were tried, and which parts and families were not judged.
std::string judged_lines(const Json& p) {
  std::string out;
  const auto sizes = sizes_text(p["judged_up_to"]);
  if (!sizes.empty())
    out += fmt::format("claims were tried on {}\n{}\n", sizes, extremes_text(p["tried"]));
  for (const std::string part : p["detector"]["unjudged_parts"])
    out += fmt::format("not judged: the {} of this library\n", part);
  for (const std::string family : p["left_out_families"])
    out += fmt::format("not judged: family {}, which the contract leaves out\n", family);
  return out;
}

}  // namespace

std::string findings_text(const RunFindings& findings, const Json& predicate) {
  const auto& run = findings.run;
  std::string out;
  if (!run.plan.strata.empty()) {
    out += fmt::format("\n{}{}", strata_text(findings), disturbance_text(findings));
    if (!run.detector.built_in) out += fmt::format("\n{}", measures_text(findings));
    out += judged_lines(predicate);
    if (run.plan.laws_every > 0) out += laws_text(findings);
  }
  const auto search = search_text(findings);
  if (!search.empty()) out += fmt::format("\n{}", search);
  if (!findings.evidence.faults.empty())
    out += fmt::format("\n{}", faults_text(findings, predicate["power"]));
  if (!findings.evidence.worlds.empty()) out += fmt::format("\n{}", worlds_text(findings));
  return out;
}

std::string gates_text(const properties::Judgement& judgement) {
  std::string out = fmt::format("{:<10} {}\n", "gate", "outcome");
  constexpr std::size_t most = 5;
  for (const auto& [gate, state, reasons, remedy] : judgement.gates) {
    out += fmt::format("{:<10} {}\n", properties::rule_of(gate).name,
                       state == GateState::fails ? "FAILS" : name_of(state));
    for (std::size_t i = 0; i < std::min(most, reasons.size()); ++i)
      out += fmt::format("  {}\n", reasons[i]);
    if (reasons.size() > most) out += fmt::format("  and {} more reasons\n", reasons.size() - most);
    if (!remedy.empty()) out += fmt::format("  {}\n", remedy);
  }
  return out;
}

std::string verdict_text(const RunFindings& findings, const properties::Judgement& judgement) {
  std::string word = judgement.verdict;
  // A verdict that somebody has to look at stands out.
  if (judgement.exit_code == exit_defect || judgement.exit_code == exit_unsound)
    std::transform(word.begin(), word.end(), word.begin(),
                   [](char c) { return c == '-' ? ' ' : static_cast<char>(std::toupper(c)); });
  const auto& evidence = findings.evidence;
  const auto differing = std::ranges::count(evidence.sources, true, &JudgedSource::broken);
  std::string out = fmt::format("{}: {} trials with a defect, {} undecided, {} laws broken", word,
                                findings.tally.with_defect(), findings.tally.open(),
                                properties::broken_laws(findings.tally.counts));
  if (differing) out += fmt::format(", {} larger meshes on which runs differ", differing);
  for (const auto& source : properties::all_rows<Source>) {
    const auto defects = evidence.sum_of(source.value).defects;
    if (*source.defects && defects) out += fmt::format(", {} {}", defects, source.defects);
  }
  return out;
}

}  // namespace assay::reports
