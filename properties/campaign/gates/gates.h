// Whether a run holds: one function from its findings, and from what was asked for, to the outcome
// of each gate. The order of the gates stands here alone, and it is that of the exit codes: a doubt
// about the harness goes before a defect, and a defect before what is not complete.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "properties/campaign/gates/findings.h"

namespace assay::properties {

enum class Gate : std::uint8_t { harness, corpus, claims, complete, bounds, speed };

// What a gate asks, and what a run is called, and ends with, when it is the first that fails.
struct GateRule {
  Gate gate;
  std::string_view name;
  std::string_view asks;
  std::string_view verdict;
  int exit_code;
};

// When each gate holds:
//
// - harness: every canary was found, of the planted faults the share that the plan's policy asks
//   for, and no equivalent one. The self-test met no contradiction. Every law's premise held as
//   often as asked, and was close in a quarter of these steps, where all trials took place. Every
//   defect of a trial was stored as a failure. Without a canary nothing is judged.
// - corpus: the shipped cases, scenes and the owner's cases hold, and no waiver is expired.
// - claims: no claim and no law is broken in any trial, and no world has a counterexample. A
//   certificate leaves waived failures aside.
// - complete: all that was planned is there: shards, trials, and planted faults with all of their
//   cases. For a certificate the corpus is there too, with an answer in every case, and so is the
//   self-test. At most 1 % of the trials were disturbed from outside.
// - bounds: every bound that is wanted is met. Where none is wanted, no trial is without a verdict.
// - speed: no figure is above its limit, for a time proves nothing wrong. It is not judged where no
//   limit is set, nor for a plug-in.
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
  // Why it fails or was not judged, a line each. None where it holds.
  std::vector<std::string> reasons;
};

// Of `assay run`: harness, claims, complete and bounds, and corpus where it had cases of its owner.
// Of `assay certify`: all of them.
Asked asked_of_a_run();
Asked asked_of_a_run(const RunFindings& findings);
Asked asked_of_a_certificate();

struct Judgement {
  std::vector<GateResult> gates;  // in the order of gate_rules
  // "certified" where a certificate was asked for and no gate fails; "holds" where none was; "not
  // judged" where no gate was judged; else the verdict of the first gate that fails.
  std::string verdict;
  int exit_code = 0;
  std::optional<Gate> failed;  // the first

  const GateResult& of(Gate gate) const { return gates[static_cast<std::size_t>(gate)]; }
};

Judgement judge(const RunFindings& findings, const Asked& asked);
// By what its stores say was asked, where they do; else as this run.
Judgement judge(const RunFindings& findings);

}  // namespace assay::properties
