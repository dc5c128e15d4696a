#include "properties/campaign/gates.h"

#include <fmt/format.h>

#include <algorithm>

#include "properties/campaign/bounds.h"
#include "properties/campaign/count_names.h"

namespace assay::properties {
namespace {

using Lines = std::vector<std::string>;

// What one gate finds: lines that speak against it, else why it could not be judged, if so.
struct Found {
  Lines against;
  std::string not_judged;
};

bool has_all_trials(const RunFindings& f) {
  return std::all_of(f.run.plan.strata.begin(), f.run.plan.strata.end(), [&](const auto& stratum) {
    return f.tally_of(stratum).trials == f.planned(stratum);
  });
}

void check_power(const RunFindings& f, Lines& lines) {
  for (const auto& canary : f.evidence.canaries) {
    if (!canary.found_after)
      lines.push_back(fmt::format("shard {} did not find its canary", canary.shard));
  }
  Lines hidden;
  for (const auto& proof : f.evidence.faults) {
    if (proof.status == FaultStatus::planted && !proof.found() && !proof.time_over)
      hidden.push_back(fmt::format("planted fault {} was not found", proof.fault));
    if (proof.status == FaultStatus::equivalent && proof.found())
      lines.push_back(fmt::format("{}, registered as equivalent, was found", proof.fault));
  }
  const auto planted = static_cast<double>(f.planted());
  if (planted - static_cast<double>(hidden.size()) < f.run.plan.policy.power * planted)
    lines.insert(lines.end(), hidden.begin(), hidden.end());
}

// Every defect of a trial was stored as a failure.
void check_tallies(const RunFindings& f, Lines& lines) {
  std::uint64_t defects = 0, met = 0;
  for (const auto& [family, stratum] : f.tally.strata) {
    for (const auto& outcomes : stratum.by_configuration) defects += outcomes.defects;
  }
  for (const auto& [signature, count] : f.met)
    met += signature.starts_with(law_in_signature) ? 0 : count;
  if (defects != met)
    lines.push_back(fmt::format("{} defects in the trials, {} failures are stored", defects, met));
}

Found harness(const RunFindings& f, const Asked&) {
  Found found;
  auto& lines = found.against;
  for (const auto& problem : f.evidence.problems) lines.push_back(problem.what);
  check_power(f, lines);
  // A shard by itself, and a run that is not complete, may well have met a law too seldom.
  const bool laws_ran = f.run.built_in && f.run.plan.laws_every > 0 && !f.run.plan.strata.empty();
  if (laws_ran && has_all_trials(f) && !f.alone) {
    for (auto& line : starved_laws(f.tally.counts, f.run.plan.law_premises))
      lines.push_back(std::move(line));
  }
  check_tallies(f, lines);
  std::uint64_t contradictions = 0;
  for (const auto& row : f.evidence.self_test) contradictions += row.contradictions;
  if (contradictions > 0)
    lines.push_back(fmt::format("the self-test met {} contradictions", contradictions));
  if (f.evidence.canaries.empty()) found.not_judged = "no canary was met";
  return found;
}

Found corpus(const RunFindings& f, const Asked&) {
  Found found;
  for (const auto& row : f.evidence.corpus) {
    for (const auto& failed : row.failed) {
      if (!f.is_waived(failed.signature))
        found.against.push_back(
            fmt::format("{} ({}): {}", failed.id, row.configuration, failed.what));
    }
  }
  for (const auto& waiver : f.evidence.waivers) {
    if (waiver.expired)
      found.against.push_back(
          fmt::format("the waiver of \"{}\" expired on {}", waiver.signature, waiver.expires));
  }
  if (f.evidence.corpus.empty()) found.not_judged = "the corpus was not run";
  return found;
}

Found claims(const RunFindings& f, const Asked&) {
  Found found;
  for (const auto* failure : f.kinds()) {
    // What the corpus alone shows is that gate's.
    if (f.is_waived(failure->signature) || failure->id.starts_with(corpus_in_id)) continue;
    found.against.push_back(fmt::format("{} ({}), met {} times; {}", failure->signature,
                                        failure->configuration, f.met_count(*failure),
                                        failure->id));
  }
  for (const auto& [signature, count] : f.met) {
    const bool has_mesh = std::any_of(f.failures.begin(), f.failures.end(),
                                      [&](const auto& one) { return one.signature == signature; });
    if (!has_mesh && !f.is_waived(signature))
      found.against.push_back(
          fmt::format("{}, met {} times; no mesh of it is stored", signature, count));
  }
  for (const auto& world : f.evidence.worlds) {
    if (world.counterexample)
      found.against.push_back(fmt::format("{}: {}", world.world, *world.counterexample));
  }
  if (f.tally.trials() == 0) found.not_judged = "no trial was judged";
  return found;
}

void check_faults(const RunFindings& f, Lines& lines) {
  if (f.run.plan.fault_cases == 0) return;
  for (const auto& source : f.evidence.power) {
    if (source.program != f.run.program || source.worker != f.run.worker ||
        source.generator != f.run.generator)
      lines.push_back("the planted faults were proved by another build");
  }
  if (!f.alone && f.planted() != f.run.planted_faults)
    lines.push_back(
        fmt::format("{} of {} planted faults were tried", f.planted(), f.run.planted_faults));
  for (const auto& proof : f.evidence.faults) {
    if (proof.status == FaultStatus::planted && !proof.found() && proof.time_over)
      lines.push_back(fmt::format("the time was over before {} was found", proof.fault));
  }
}

Found complete(const RunFindings& f, const Asked& asked) {
  Found found;
  auto& lines = found.against;
  if (!f.alone) {
    for (const auto& shard : f.missing)
      lines.push_back(fmt::format("shard {} is absent", text_of(shard)));
  }
  for (const auto& stratum : f.run.plan.strata) {
    const auto trials = f.tally_of(stratum).trials, planned = f.planned(stratum);
    if (trials != planned)
      lines.push_back(fmt::format("{}: {} of {} trials", stratum.family, trials, planned));
  }
  if (f.evidence.canaries.empty()) lines.push_back("no canary was met");
  check_faults(f, lines);
  // Of all shards together: one of them may have stood on a machine that was short of memory.
  constexpr std::uint64_t most_disturbed = 100;  // one trial in so many
  const auto disturbed = f.tally.disturbed(), trials = f.tally.trials();
  if (!f.alone && most_disturbed * disturbed > trials)
    lines.push_back(
        fmt::format("{} of {} trials were disturbed from outside, 1 % may be", disturbed, trials));
  if (!asked.certificate) return found;
  if (f.planned() == 0) lines.push_back("the campaign plans no trial");
  if (f.evidence.corpus.empty()) lines.push_back("the corpus was not run");
  const auto& self_test = f.evidence.self_test;
  if (f.run.plan.policy.self_test_queries > 0 &&
      (self_test.empty() || std::any_of(self_test.begin(), self_test.end(),
                                        [](const auto& row) { return !row.complete; })))
    lines.push_back("the self-test was not run to its end");
  return found;
}

Found bounds(const RunFindings& f, const Asked&) {
  Found found;
  bool judged = false;
  for (const auto& stratum : f.run.plan.strata) {
    const bool is_wanted = stratum.wanted_bound > 0;
    if (is_wanted && f.alone) continue;
    judged = true;
    const auto& tally = f.tally_of(stratum);
    for (std::size_t c = 0; c < f.run.configurations.size(); ++c) {
      const auto outcomes =
          c < tally.by_configuration.size() ? tally.by_configuration[c] : StratumTally::Outcomes{};
      const std::string where = fmt::format("{}, {}", stratum.family, f.run.configurations[c].name);
      const double bound = bound_of(outcomes, f.run);
      if (!is_wanted && outcomes.open() > 0) {
        found.against.push_back(fmt::format("{}: {} without a verdict", where, outcomes.open()));
      } else if (is_wanted && bound > stratum.wanted_bound) {
        found.against.push_back(
            fmt::format("{}: bound {:.2e}, {:.0e} is wanted", where, bound, stratum.wanted_bound));
      }
    }
  }
  if (!judged)
    found.not_judged =
        f.alone ? "bounds are wanted of all shards together" : "the campaign has no trials";
  return found;
}

// The figures themselves stand among the times: these lines are the same from run to run.
Found speed(const RunFindings& f, const Asked&) {
  Found found;
  const auto& limits = f.run.plan.policy.speed_limits;
  if (!f.run.built_in) {
    found.not_judged = "limits are set for the built-in detector alone";
  } else if (limits.empty()) {
    found.not_judged = "the campaign sets no limit";
  } else {
    for (const auto& [what, limit] : limits) {
      const auto& figures = f.evidence.speed;
      const auto figure = std::find_if(figures.begin(), figures.end(),
                                       [&](const SpeedFigure& one) { return one.what == what; });
      if (figure == figures.end()) {
        found.against.push_back(fmt::format("{} was not measured", what));
      } else if (figure->median > limit) {
        found.against.push_back(fmt::format("{} is above its limit of {}", what, limit));
      }
    }
  }
  return found;
}

Found find(Gate gate, const RunFindings& f, const Asked& asked) {
  switch (gate) {
    case Gate::harness:
      return harness(f, asked);
    case Gate::corpus:
      return corpus(f, asked);
    case Gate::claims:
      return claims(f, asked);
    case Gate::complete:
      return complete(f, asked);
    case Gate::bounds:
      return bounds(f, asked);
    case Gate::speed:
      return speed(f, asked);
  }
  return {};
}

GateResult result_of(Gate gate, const RunFindings& f, const Asked& asked) {
  if (!asked.has(gate)) return {gate, GateState::not_judged, {"it was not asked for"}};
  Found found = find(gate, f, asked);
  if (!found.against.empty()) return {gate, GateState::fails, std::move(found.against)};
  if (!found.not_judged.empty())
    return {gate, GateState::not_judged, {std::move(found.not_judged)}};
  return {gate, GateState::holds, {}};
}

}  // namespace

const GateRule& rule_of(Gate gate) { return gate_rules[static_cast<std::size_t>(gate)]; }

const char* name_of(GateState state) {
  switch (state) {
    case GateState::holds:
      return "holds";
    case GateState::fails:
      return "fails";
    case GateState::not_judged:
      return "not judged";
  }
  return "unknown";
}

Asked asked_of_a_run() {
  Asked asked;
  for (const auto gate : {Gate::harness, Gate::claims, Gate::complete, Gate::bounds})
    asked.gates[static_cast<std::size_t>(gate)] = true;
  return asked;
}

Asked asked_of_a_certificate() {
  Asked asked;
  asked.gates.fill(true);
  asked.certificate = true;
  return asked;
}

AskedGates to_words(const Asked& asked) {
  AskedGates words{{}, asked.certificate};
  for (const auto& rule : gate_rules) {
    if (asked.has(rule.gate)) words.gates.emplace_back(rule.name);
  }
  return words;
}

Asked asked_in(const AskedGates& words) {
  // No store can have a certificate issued with a gate left out.
  if (words.certificate) return asked_of_a_certificate();
  Asked asked;
  for (const auto& rule : gate_rules)
    asked.gates[static_cast<std::size_t>(rule.gate)] =
        std::find(words.gates.begin(), words.gates.end(), rule.name) != words.gates.end();
  return asked;
}

Judgement judge(const RunFindings& findings, const Asked& asked) {
  Judgement judgement;
  bool any_judged = false;
  for (const auto& rule : gate_rules) {
    judgement.gates.push_back(result_of(rule.gate, findings, asked));
    const auto state = judgement.gates.back().state;
    any_judged |= state != GateState::not_judged;
    if (state == GateState::fails && !judgement.failed) judgement.failed = rule.gate;
  }
  if (judgement.failed) {
    judgement.verdict = rule_of(*judgement.failed).verdict;
    judgement.exit_code = rule_of(*judgement.failed).exit_code;
  } else {
    judgement.verdict = !any_judged ? "not judged" : asked.certificate ? "certified" : "holds";
  }
  return judgement;
}

bool has_more_to_do(const RunFindings& f) {
  const auto was_cut = [](const FaultProof& proof) { return proof.time_over && !proof.found(); };
  return !has_all_trials(f) ||
         std::any_of(f.evidence.faults.begin(), f.evidence.faults.end(), was_cut);
}

Judgement judge(const RunFindings& findings) {
  const auto& stored = findings.evidence.asked;
  return judge(findings, stored ? asked_in(*stored) : asked_of_a_run());
}

}  // namespace assay::properties
