// Decides whether a run holds: one function takes its findings, and what was asked for, to the
// outcome of each gate. The order of the gates is stated here alone, and the exit codes follow it:
// a doubt about the harness goes before a defect, and a defect before anything that is not
// complete.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "properties/campaign/gates/findings.h"

namespace assay::properties {

enum class Gate : std::uint8_t { harness, corpus, claims, complete, bounds, speed };

// What a gate asks, and the verdict and exit code of a run in which it is the first gate that
// fails.
struct GateRule {
  Gate gate;
  std::string_view name;
  std::string_view asks;
  std::string_view verdict;
  int exit_code;
};

// When each gate holds:
//
// - harness: every canary was found, and of the planted faults the share that the plan's policy
//   asks for; no equivalent fault was found. The self-test met no contradiction. If all trials
//   took place, every law's premise held as often as asked, and was close in a quarter of these
//   steps. Every defect of a trial was stored as a failure. Without a canary nothing is judged.
// - corpus: the shipped cases, scenes and the owner's cases hold.
// - claims: no claim and no law is broken in any trial or in any case that the search asked, and no
//   world has a counterexample.
// - complete: all that was planned is there: shares, trials, the search, and planted faults with
//   all of their cases. For a certificate the corpus is there too, with an answer in every case,
//   and so is the self-test. At most 1 % of the trials were disturbed from outside. Enough
//   contacts were judged (not_judged.h).
// - bounds: every bound that is wanted is met. If none is wanted, every trial has a verdict,
//   but for the strata of sizes, whose bounds say it.
// - speed: every figure that has a limit was measured, and none is above its limit. A failure is
//   no defect, because a time proves nothing wrong. The gate is not judged if no limit is set, nor
//   for a plug-in.
inline constexpr std::array<GateRule, 6> gate_rules = {{
    {Gate::harness, "harness", "the harness is sound", "unsound-harness", 4},
    {Gate::corpus, "corpus", "the corpus passes", "defect", 1},
    {Gate::claims, "claims", "the claims hold", "defect", 1},
    {Gate::complete, "complete", "all that was planned is there", "incomplete", 3},
    {Gate::bounds, "bounds", "the bounds are met", "undecided", 3},
    {Gate::speed, "speed", "no time is above its limit", "undecided", 3},
}};

const GateRule& rule_of(Gate gate);

enum class GateState : std::uint8_t { holds, fails, not_judged };
const char* name_of(GateState state);  // "holds", "fails", "not judged"

struct GateResult {
  Gate gate = Gate::harness;
  GateState state = GateState::holds;
  // Why the gate fails or was not judged, one line for each reason. Empty if it holds.
  std::vector<std::string> reasons;
  // Of the gate complete: which of its reasons end when the same run goes on, and which do not, in
  // a sentence. Empty for other gates, and if it holds.
  std::string remedy = {};
};

// What each verb asks for. `assay run`: harness, claims, complete and bounds, and also corpus if
// the run had cases of its owner. `assay certify`: all gates.
Asked asked_of_a_run();
Asked asked_of_a_run(const RunFindings& findings);
Asked asked_of_a_certificate();

struct Judgement {
  std::vector<GateResult> gates;  // in the order of gate_rules
  // "certified" if a certificate was asked for and no gate fails; "holds" if none was asked for
  // and no gate fails; "not judged" if no gate was judged; else the verdict of the first gate that
  // fails.
  std::string verdict;
  int exit_code = 0;
  std::optional<Gate> failed;  // the first gate that fails

  const GateResult& of(Gate gate) const { return gates[static_cast<std::size_t>(gate)]; }
};

Judgement judge(const RunFindings& findings, const Asked& asked);
// Judges by what the stores say was asked for; if they do not say it, as `assay run` does.
Judgement judge(const RunFindings& findings);

}  // namespace assay::properties
