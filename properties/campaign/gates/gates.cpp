#include "properties/campaign/gates/gates.h"

#include <algorithm>

#include "properties/campaign/gates/gate_checks.h"

namespace assay::properties {
namespace {

// These are in the order of gate_rules.
constexpr std::array<GateFindings (*)(const RunFindings&, const Asked&), gate_rules.size()> checks =
    {check_harness, check_corpus, check_claims, check_complete, check_bounds, check_speed};

bool is_asked(const GateRule& rule, const Asked& asked) {
  return asked.certificate ||
         std::find(asked.gates.begin(), asked.gates.end(), rule.name) != asked.gates.end();
}

GateResult result_of(Gate gate, const RunFindings& findings, const Asked& asked) {
  if (!is_asked(rule_of(gate), asked))
    return {gate, GateState::not_judged, {"it was not asked for"}};
  auto found = checks[static_cast<std::size_t>(gate)](findings, asked);
  if (!found.against.empty()) return {gate, GateState::fails, std::move(found.against)};
  if (found.not_judged.empty()) return {gate, GateState::holds, {}};
  return {gate, GateState::not_judged, {std::move(found.not_judged)}};
}

}  // namespace

const GateRule& rule_of(Gate gate) { return gate_rules[static_cast<std::size_t>(gate)]; }

const char* name_of(GateState state) {
  constexpr std::array names = {"holds", "fails", "not judged"};
  return names[static_cast<std::size_t>(state)];
}

Asked asked_of_a_run() { return {{"harness", "claims", "complete", "bounds"}, false}; }

Asked asked_of_a_run(const RunFindings& findings) {
  Asked asked = asked_of_a_run();
  const auto& rows = findings.evidence.corpus;
  if (std::any_of(rows.begin(), rows.end(),
                  [](const CorpusRow& row) { return row.input == own_cases_input; }))
    asked.gates.emplace_back(rule_of(Gate::corpus).name);
  return asked;
}

Asked asked_of_a_certificate() {
  Asked asked{{}, true};
  for (const auto& rule : gate_rules) asked.gates.emplace_back(rule.name);
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

Judgement judge(const RunFindings& findings) {
  return judge(findings, findings.evidence.asked.value_or(asked_of_a_run(findings)));
}

}  // namespace assay::properties
