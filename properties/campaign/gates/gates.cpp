#include "properties/campaign/gates/gates.h"

#include <fmt/format.h>

#include <algorithm>

#include "corpus/scenes/scenes.h"
#include "properties/campaign/ledger/tally.h"
#include "properties/campaign/phases/phases.h"
#include "properties/judging/cause.h"
#include "properties/words.h"

namespace assay::properties {

// First the checks of each gate (gates.h says when it holds), then the requests of verbs, and the
// verdict.

namespace {

using Lines = std::vector<std::string>;

// The lines that speak against a gate. If there are none, `not_judged` may say why the gate could
// not be judged.
struct GateFindings {
  Lines against;
  std::string not_judged;
  Lines lasting = {};  // of gate `complete`: those that stay when the run goes on

  void add_to_do(std::string line) { against.push_back(std::move(line)); }
  void add_lasting(const std::string& line) {
    against.push_back(line);
    lasting.push_back(line);
  }
};

// Returns the remedy for the reasons of gate `complete`.
std::string remedy_of(const GateFindings& gate) {
  const auto all = gate.against.size(), lasting = gate.lasting.size();
  if (lasting == 0) return "the same command, run again, goes on with what is missing";
  constexpr std::string_view other = "other seeds, a larger campaign or another contract may";
  if (lasting == all)
    return fmt::format("the same command, run again, cannot mend this; {}", other);
  return fmt::format(
      "the same command, run again, goes on with what is missing, but cannot mend: {}{}; {}",
      gate.lasting.front(), lasting == 1 ? "" : fmt::format(" (and {} more)", lasting - 1), other);
}

void check_power(const RunFindings& f, Lines& lines) {
  for (const auto& canary : f.evidence.canaries) {
    if (!canary.found_after)
      lines.push_back(fmt::format("the canary {} was not found", canary.fault));
  }
  Lines hidden;
  for (const auto& proof : f.evidence.faults) {
    const bool was_tried = proof.is_whole(f.run.plan);
    if (proof.status == FaultStatus::planted && !proof.is_found() && was_tried)
      hidden.push_back(fmt::format("planted fault {} was not found", proof.fault));
    if (proof.status == FaultStatus::equivalent && proof.is_found())
      lines.push_back(fmt::format("fault {} is registered equivalent, but was found", proof.fault));
  }
  const auto faults = static_cast<double>(f.faults());
  if (faults - static_cast<double>(hidden.size()) < f.run.plan.policy.power * faults)
    lines.insert(lines.end(), hidden.begin(), hidden.end());
}

// Checks that every defect of a trial was stored as a failure.
void check_tallies(const RunFindings& f, Lines& lines) {
  std::uint64_t defects = 0;
  for (const auto& [family, stratum] : f.tally.strata) {
    for (const auto& outcomes : stratum.by_configuration) defects += outcomes.defects;
  }
  if (defects != f.claims_broken)
    lines.push_back(
        fmt::format("trials have {} defects, but {} are stored", defects, f.claims_broken));
}

void check_faults(const RunFindings& f, GateFindings& gate) {
  const auto& plan = f.run.plan;
  if (plan.fault_cases == 0) return;
  const auto& build = f.run.digests;
  for (const auto& source : f.evidence.power) {
    if (source.program != build.program || source.worker != build.worker ||
        source.generator != build.generator)
      gate.add_lasting("the proof that planted faults are found is of another build");
  }
  if (f.faults() != f.run.planted_faults)
    gate.add_to_do(
        fmt::format("{} of {} planted faults were tried", f.faults(), f.run.planted_faults));
  for (const auto& proof : f.evidence.faults) {
    if (f.is_whole() ? !proof.is_whole(plan) : proof.time_over)
      gate.add_to_do(fmt::format("time ended before all cases for fault {} were run", proof.fault));
  }
}

void check_trials(const RunFindings& f, const VerbRequest& request, GateFindings& gate) {
  for (const auto& stratum : f.run.plan.strata) {
    const auto& tally = f.tally_of(stratum);
    const auto cases = f.quota(stratum);
    if (tally.trials != cases) {
      gate.add_to_do(fmt::format("{}: {} of {} trials", stratum.family, tally.trials, cases));
    } else if (tally.discards > 0 && !f.is_left_out(stratum)) {
      gate.add_lasting(
          fmt::format("{}: for {} of {} trials no case was drawn that the contract takes",
                      stratum.family, tally.discards, cases));
    }
  }
  if (request.certificate && f.quota() == 0) gate.add_lasting("the campaign plans no trial");
  if (f.quota() > 0 && f.tally.judged_trials() == 0 && f.tally.trials() == f.quota())
    gate.add_lasting(
        "no case was judged: the contract or the detector takes no case of any family");
  if (request.certificate && f.tally.judged_trials() > 0 && f.run.detector.query_claims.empty() &&
      judged_claims(f).empty())
    gate.add_lasting("no claim of the detector was judged");
  // A share of a campaign may have too few contacts.
  for (const auto& line : f.is_whole() ? lacks_of_contacts(f, request.certificate) : Lines()) {
    // The trials to come may have contacts.
    if (f.has_more_to_do()) {
      gate.add_to_do(line);
    } else {
      gate.add_lasting(line);
    }
  }
  // Asked only of a whole campaign, because one share may have run on a machine short of memory.
  constexpr std::uint64_t most_disturbed = 100;  // at most one trial in this many
  const auto disturbed = f.tally.disturbed(), trials = f.tally.trials();
  if (f.is_whole() && most_disturbed * disturbed > trials)
    gate.add_lasting(fmt::format("{} of {} trials were disturbed from outside: more than 1 %",
                                 disturbed, trials));
}

// Checks that a plug-in was given every scene at the plan's size, the long sequence, and the walks
// of a limiter.
void check_repetitions(const RunFindings& f, GateFindings& gate) {
  if (!is_repeated(f.run.plan, f.run.detector.built_in)) return;
  std::vector<std::string> names;
  for (const auto& scene : corpus::scenes()) names.emplace_back(scene.name);
  names.emplace_back(name_of_long_sequence);
  const auto& configurations = f.run.detector.configurations;
  if (!configurations.empty() && claims_named(configurations[0].claims).has_any(claims_on_limits)) {
    for (const auto kind : all_values<WalkKind>) names.emplace_back(name_of(kind));
  }
  const auto rows = f.evidence.rows_of(Source::repeated);
  const auto count = std::ranges::count_if(names, [&](const std::string& name) {
    return std::ranges::find(rows, name, &JudgedSource::input) != rows.end();
  });
  if (static_cast<std::size_t>(count) < names.size())
    gate.add_to_do(fmt::format("{} of {} sequences were run", count, names.size()));
}

// Checks that the search asked all of its cases.
void check_search(const RunFindings& f, GateFindings& gate) {
  const auto cases = f.shares_of(f.run.plan.search);
  const auto lanes = f.evidence.sum_of(Source::search);
  if (lanes.planned < cases)
    gate.add_to_do(fmt::format("the search has finished {} of its {} cases", lanes.planned, cases));
  if (cases > 0 && lanes.planned == cases && lanes.cases == 0)
    gate.add_lasting("the contract takes no case of the search");
  if (lanes.undecided > 0)
    gate.add_lasting(fmt::format("{} cases of the search have no verdict", lanes.undecided));
}

GateFindings check_harness(const RunFindings& f, const VerbRequest& request) {
  GateFindings gate;
  auto& lines = gate.against;
  for (const auto& problem : f.evidence.problems) {
    if (!problem.what.empty()) lines.push_back(problem.what);
  }
  check_power(f, lines);
  if (f.laws_are_judged()) {
    for (auto& line : starved_laws(f.tally.counts, f.run.plan.law_premises))
      lines.push_back(std::move(line));
  }
  check_tallies(f, lines);
  const auto contradictions = f.evidence.sum_of(Source::self_test).defects;
  if (request.certificate && contradictions > 0)
    lines.push_back(fmt::format("the self-test found {} contradictions", contradictions));
  if (f.evidence.canaries.empty()) gate.not_judged = "no canary was tried";
  return gate;
}

GateFindings check_corpus(const RunFindings& f, const VerbRequest&) {
  GateFindings gate;
  const auto rows = f.evidence.rows_of(Source::corpus);
  for (const auto& row : rows) {
    for (const auto& input : row.failed)
      gate.against.push_back(fmt::format("{} ({}): {}", input.id, row.configuration, input.what));
  }
  if (rows.empty()) gate.not_judged = "the corpus was not run";
  return gate;
}

GateFindings check_claims(const RunFindings& f, const VerbRequest&) {
  GateFindings gate;
  // A signature counts if trials met it, even without a stored mesh, and if a failure of a trial
  // is stored, even if no trial counted it. A failure that only the corpus shows belongs to the
  // gate corpus.
  std::set<std::string, LeastOddFirst> signatures;
  for (const auto& [signature, count] : f.times_met) signatures.insert(signature);
  for (const auto& failure : f.failures) {
    if (!failure.is_of_corpus()) signatures.insert(failure.signature());
  }
  for (const auto& signature : signatures) {
    const auto* first = f.example_of(signature);
    const auto entry = f.times_met.find(signature);
    const auto times = entry == f.times_met.end() ? 0 : entry->second;
    gate.against.push_back(fmt::format(
        "{}, {}; {}", signature, first ? first->met_text(times) : "met " + times_text(times),
        first ? first->id() + " (" + first->shown_configuration() + ")" : "no mesh is stored"));
  }
  for (const auto& world : f.evidence.worlds) {
    if (world.counterexample)
      gate.against.push_back(fmt::format("{}: {}", world.world, *world.counterexample));
  }
  if (f.tally.judged_trials() == 0) gate.not_judged = "no trial was judged";
  return gate;
}

GateFindings check_complete(const RunFindings& f, const VerbRequest& request) {
  GateFindings gate;
  if (!f.is_whole()) {
    std::vector<std::string> shares;
    for (const auto& part : f.parts)
      shares.push_back(fmt::format("1/{} under seed {}", part.shares, part.seed));
    gate.add_lasting(
        fmt::format("the shares make no whole campaign: {}; shares 1/N need N consecutive seeds",
                    fmt::join(shares, ", ")));
  }
  check_trials(f, request, gate);
  if (f.evidence.canaries.empty()) gate.add_to_do("no canary was tried");
  check_faults(f, gate);
  check_repetitions(f, gate);
  check_search(f, gate);
  const auto corpus = f.evidence.rows_of(Source::corpus);
  for (const auto& row : corpus) {
    for (const auto& open : row.open)
      gate.add_lasting(fmt::format("{} ({}): {}", open.id, row.configuration, open.what));
  }
  if (!request.certificate) return gate;
  if (corpus.empty()) gate.add_to_do("the corpus was not run");
  const bool was_run = !f.evidence.rows_of(Source::self_test).empty() &&
                       f.evidence.sum_of(Source::self_test).complete;
  if (f.run.plan.policy.self_test_queries > 0 && !was_run)
    gate.add_to_do("the self-test was not run to its end");
  return gate;
}

GateFindings check_bounds(const RunFindings& f, const VerbRequest&) {
  GateFindings gate;
  bool is_judged = false;
  for (const auto& stratum : f.run.plan.strata) {
    const bool is_wanted = stratum.wanted_bound > 0;
    if ((is_wanted && !f.is_whole()) || f.is_left_out(stratum)) continue;
    is_judged = true;
    const auto configurations = configurations_in(f.run.detector, stratum.family);
    for (std::size_t c = 0; c < configurations.size(); ++c) {
      if (is_met(f, stratum, c)) continue;
      const auto outcomes = f.outcomes_of(stratum, c);
      gate.against.push_back(
          fmt::format("{}, {}: ", stratum.family, configurations[c].name) +
          (is_wanted ? fmt::format("bound {:.2e}, {:.0e} is wanted",
                                   bound_of(outcomes, stratum, f.run), stratum.wanted_bound)
                     : fmt::format("{} without a verdict", outcomes.open())));
    }
  }
  if (!is_judged)
    gate.not_judged =
        f.is_whole() ? "the campaign has no trials" : "only a whole campaign needs bounds";
  return gate;
}

// Checks the figures. The lines leave the figures out, which stand among the times, so that the
// lines are the same from run to run. Of several runs the median counts.
GateFindings check_speed(const RunFindings& f, const VerbRequest&) {
  GateFindings gate;
  const auto& limits = f.run.plan.policy.speed_limits;
  if (!f.run.detector.built_in) {
    gate.not_judged = "limits are set only for the built-in detector";
  } else if (limits.empty()) {
    gate.not_judged = "the campaign sets no limit";
  } else {
    for (const auto& [figure, limit] : limits) {
      std::vector<double> medians;
      for (const auto& row : f.evidence.speed) {
        if (row.name == figure) medians.push_back(row.median);
      }
      std::ranges::sort(medians);
      if (medians.empty()) {
        gate.against.push_back(fmt::format("{} was not measured", figure));
      } else if (medians[medians.size() / 2] > limit) {
        gate.against.push_back(fmt::format("{} is above its limit of {}", figure, limit));
      }
    }
  }
  return gate;
}

// The checks of the gates, in the order of gate_rules.
constexpr std::array<GateFindings (*)(const RunFindings&, const VerbRequest&), gate_rules.size()>
    checks = {check_harness, check_corpus, check_claims, check_complete, check_bounds, check_speed};

bool is_asked(const GateRule& rule, const VerbRequest& request) {
  return request.certificate || std::ranges::find(request.gates, rule.name) != request.gates.end();
}

GateResult result_of(Gate gate, const RunFindings& findings, const VerbRequest& request) {
  if (!is_asked(rule_of(gate), request))
    return {gate, GateState::not_judged, {"it was not asked for"}};
  auto facts = checks[static_cast<std::size_t>(gate)](findings, request);
  if (!facts.against.empty())
    return {gate, GateState::fails, facts.against, gate == Gate::complete ? remedy_of(facts) : ""};
  if (facts.not_judged.empty()) return {gate, GateState::holds, {}};
  return {gate, GateState::not_judged, {std::move(facts.not_judged)}};
}

}  // namespace

const GateRule& rule_of(Gate gate) { return gate_rules[static_cast<std::size_t>(gate)]; }

const char* name_of(GateState state) {
  constexpr std::array names = {"holds", "fails", "not judged"};
  return names[static_cast<std::size_t>(state)];
}

VerbRequest asked_of_a_run() { return {{"harness", "claims", "complete", "bounds"}, false}; }

VerbRequest asked_of_a_run(const RunFindings& findings) {
  VerbRequest request = asked_of_a_run();
  if (!findings.evidence.rows_of(Source::own).empty())
    request.gates.emplace_back(rule_of(Gate::corpus).name);
  return request;
}

VerbRequest asked_of_a_certificate() {
  VerbRequest request{{}, true};
  for (const auto& rule : gate_rules) request.gates.emplace_back(rule.name);
  return request;
}

Judgement judge(const RunFindings& findings, const VerbRequest& request) {
  Judgement judgement;
  bool any_judged = false;
  for (const auto& rule : gate_rules) {
    judgement.gates.push_back(result_of(rule.gate, findings, request));
    const auto state = judgement.gates.back().state;
    any_judged |= state != GateState::not_judged;
    if (state == GateState::fails && !judgement.failed_gate) judgement.failed_gate = rule.gate;
  }
  if (judgement.failed_gate) {
    judgement.verdict = rule_of(*judgement.failed_gate).verdict;
    judgement.exit_code = rule_of(*judgement.failed_gate).exit_code;
  } else {
    judgement.verdict = !any_judged ? "not judged" : request.certificate ? "certified" : "holds";
  }
  return judgement;
}

Judgement judge(const RunFindings& findings) {
  return judge(findings, findings.evidence.request.value_or(asked_of_a_run(findings)));
}

}  // namespace assay::properties
