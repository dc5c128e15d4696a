// Decides whether a run holds: one function takes its findings, and what was asked for, to the
// outcome of each gate. The order of the gates is stated here alone, and the exit codes follow it:
// a doubt about the harness goes before a defect, and a defect before anything that is not
// complete. Which claims were not judged, and how failures are grouped, stands below.
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
//   contacts were judged (lacks_of_contacts).
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
VerbRequest asked_of_a_run();
VerbRequest asked_of_a_run(const RunFindings& findings);
VerbRequest asked_of_a_certificate();

struct Judgement {
  std::vector<GateResult> gates;  // in the order of gate_rules
  // "certified" if a certificate was asked for and no gate fails; "holds" if none was asked for
  // and no gate fails; "not judged" if no gate was judged; else the verdict of the first gate that
  // fails.
  std::string verdict;
  int exit_code = 0;
  std::optional<Gate> failed_gate;  // the first gate that fails

  const GateResult& of(Gate gate) const { return gates[static_cast<std::size_t>(gate)]; }
};

Judgement judge(const RunFindings& findings, const VerbRequest& request);
// Judges by what the stores say was asked for; if they do not say it, as `assay run` does.
Judgement judge(const RunFindings& findings);

// Claims that a run has not judged, and why. The verdict says nothing about them.

struct NotJudged {
  std::string claim, reason;
};
ASSAY_FIELDS(NotJudged, claim, reason)

// Those claims of a plug-in that were not judged, in their order. Its contract makes some void: a
// margin, no pairs. Others were never put to the test: no step had a contact; or its intervals of
// the first time were wider than 1e-3 in more than one of a hundred collisions, and so state no
// time. Of a detector that is judged by steps and queries, the steps decide. Empty for the built-in
// detector, whose contract is the default and whose times are enclosures.
std::vector<NotJudged> not_judged(const Claims& claims, const Contract& contract,
                                  const StepMeasures& measures, bool of_queries = false);
std::vector<NotJudged> not_judged(const BoundDetector& detector, const StepMeasures& measures,
                                  bool of_queries = false);
std::vector<NotJudged> not_judged(const RunFindings& findings);

// Those of the claims that are not among these.
Claims without(Claims claims, const std::vector<NotJudged>& gaps);

// The names of the claims of a plug-in that were judged.
std::vector<std::string> judged_claims(const RunFindings& findings);

// The families of which the contract took no case at all.
std::vector<std::string> left_out_families(const RunFindings& findings);

// The size of the largest mesh on which a claim was tried and judged: in a trial, in the corpus, or
// in a scene that was repeated. Claims about contacts are tried by steps with a contact that the
// contract does not leave out, `deterministic` by cases that were run twice. The claims of all
// configurations, in their order, but for those that were tried on no mesh, as `progress` is where
// no stratum asks for limits. Empty for a run of queries alone, which have no size.
struct JudgedSize {
  std::string claim;
  std::uint64_t triangles = 0;
};
ASSAY_FIELDS(JudgedSize, claim, triangles)
std::vector<JudgedSize> judged_sizes(const RunFindings& findings);

// How far the judged meshes went that judged_sizes looks at, each of these by itself.
Extremes largest_tried(const RunFindings& findings);

// Why too little was judged for a verdict; empty if enough was. Wherever a claim speaks of contacts
// and the contract does not make it void, a tenth of the planned cases of each family has to have
// a contact that the contract does not leave out, and so have some cases of at least three
// families, or, unless a certificate is asked for, of all families if the campaign names fewer.
// Families that the contract leaves out wholly are left aside. Of a claim that no step put to the
// test nothing is known.
std::vector<std::string> lacks_of_contacts(const RunFindings& findings, bool for_certificate);

// The kinds of failure of a run, grouped by what one change of the detector would mend: one mistake
// shows as many kinds, because a signature names the contact that happened to be lost.

struct FailureGroup {
  std::string does;                // "lose a contact", "report what is not there"
  std::vector<std::string> kinds;  // signatures, in the order of RunFindings::kinds()
  // What all contacts that it lost have in common; perhaps nothing.
  std::vector<std::string> shared;
  std::string smallest;  // the kind whose stored mesh is the smallest
  // In so many of those cases that hold and were looked at, some contact has all of that, too.
  std::size_t holds_with = 0, all_holds = 0;
};

// The group with the most kinds comes first. A single kind is in no group.
//
// Failures that do different things are in different groups. Those that lose a contact (answered
// free, late, left out a pair or a candidate, let a limiter through) are grouped by its traits: its
// features and its cause (cause.h), whether both triangles move, how small they are, whether it
// lies within a component or between two, whether the mesh is closed, and at least how many
// triangles it has. The traits of a group are those that set its contacts apart from contacts of a
// hundred cases that hold, over the whole run, with which the detector was right. They are not told
// if as many failing cases might have them by chance: if their share among cases that hold, to that
// power, is above 1e-4.
//
// Deterministic. The oracle judges the cases that hold again, which takes seconds. Without stores
// in the folder of the findings no traits are told.
std::vector<FailureGroup> failure_groups(const RunFindings& findings);

// "34 of 51 kinds of failure lose a contact: edge-edge (2 of 100 colliding cases that hold
// have such a contact)"; `kinds` is the number of all.
std::string text_of(const FailureGroup& group, std::size_t kinds);

}  // namespace assay::properties
