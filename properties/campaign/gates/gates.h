// Decides whether a run holds: one function takes its findings and a request, and returns the
// outcome of each gate. The order of the gates is stated here alone, and the exit codes follow it:
// a doubt about the harness goes before a defect, and a defect before anything that is incomplete.
// Further functions list the claims that were not judged, and group failures.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "properties/campaign/gates/findings.h"

namespace assay::properties {

enum class Gate : std::uint8_t { harness, corpus, claims, complete, bounds, speed };

// The demand of a gate, and the verdict and exit code of a run in which this gate is the first that
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
// - harness: every canary was found, and the share of the planted faults that the plan's policy
//   asks for; no equivalent fault was found. The self-test met no contradiction. If all trials
//   took place, every law's premise held as often as asked, and was close in a quarter of these
//   steps. Every defect of a trial was stored as a failure. Without a canary nothing is judged.
// - corpus: the shipped cases, scenes and the owner's cases hold.
// - claims: no claim and no law is broken in any trial or in any case that the search asked, and no
//   world has a counterexample.
// - complete: all that was planned was done: shares, trials, the search, and planted faults with
//   all of their cases; for a certificate also the self-test, and the corpus with an answer in
//   every case. At most 1 % of the trials were disturbed from outside. Enough
//   contacts were judged (lacks_of_contacts).
// - bounds: every wanted bound is met. Where none is wanted, every trial has a verdict. The strata
//   of large sizes need none, because their bounds count trials without a verdict.
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
  // For a gate `complete` that fails: which reasons vanish if the same run goes on, and which do
  // not, in a sentence. Else empty.
  std::string remedy = {};
};

// Return the gates that a verb asks for. `assay run`: harness, claims, complete and bounds, and
// also corpus if the run had cases of its owner. `assay certify`: all gates.
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
// Judges the gates that the stores name as asked for; if they name none, those of `assay run`.
Judgement judge(const RunFindings& findings);

// Claims that a run has not judged, and why. The verdict says nothing about them.

struct NotJudged {
  std::string claim, reason;
};
ASSAY_FIELDS(NotJudged, claim, reason)

// Returns the claims of a plug-in that were not judged, in their order. The contract makes some
// void, by a margin or because it reports no pairs. Others were never tested: no step had a
// contact, or more than one collision in a hundred had an interval of the first time that is wider
// than 1e-3 and so states no time. If a detector is judged by steps and queries, the steps decide.
// Empty for the built-in detector, whose contract is the default and whose times are enclosures.
std::vector<NotJudged> not_judged(const Claims& claims, const Contract& contract,
                                  const StepMeasures& measures, bool of_queries = false);
std::vector<NotJudged> not_judged(const BoundDetector& detector, const StepMeasures& measures,
                                  bool of_queries = false);
std::vector<NotJudged> not_judged(const RunFindings& findings);

// Returns the claims that are not among `gaps`.
Claims without(Claims claims, const std::vector<NotJudged>& gaps);

// Returns the names of the claims of a plug-in that were judged.
std::vector<std::string> judged_claims(const RunFindings& findings);

// Returns the families from which the contract took no case at all.
std::vector<std::string> left_out_families(const RunFindings& findings);

// The size of the largest mesh on which a claim was tried and judged: in a trial, in the corpus, or
// in a scene that was repeated. Claims about contacts are tried by steps with a contact that the
// contract does not leave out, `deterministic` by cases that were run twice. The list has the
// claims of all configurations, in their order, without claims tried on no mesh, such as `progress`
// if no stratum asks for limits. Empty for a run of queries alone, because queries have no size.
struct JudgedSize {
  std::string claim;
  std::uint64_t triangles = 0;
};
ASSAY_FIELDS(JudgedSize, claim, triangles)
std::vector<JudgedSize> judged_sizes(const RunFindings& findings);

// Returns the extremes of the meshes that judged_sizes looks at, each extreme by itself.
Extremes largest_tried(const RunFindings& findings);

// Returns why too little was judged for a verdict; empty if enough was. Asked only where a claim
// speaks of contacts and the contract does not make it void. Contacts that the contract leaves out
// do not count. A tenth of the planned cases of each family must have a contact, and so must some
// cases of at least three families. If the campaign names fewer families and no certificate is
// asked for, some cases of each suffice. Families that the contract leaves out wholly do not count.
// Nothing is known about a claim that no step put to the test.
std::vector<std::string> lacks_of_contacts(const RunFindings& findings, bool for_certificate);

// Groups the kinds of failure of a run by the change of the detector that would mend them: one
// mistake shows as many kinds, because a signature names the contact that happened to be lost.

struct FailureGroup {
  std::string does;                // "lose a contact", "report what is not there"
  std::vector<std::string> kinds;  // signatures, in the order of RunFindings::kinds()
  // The traits that all contacts lost by the group share; possibly none.
  std::vector<std::string> shared;
  std::string smallest;  // the kind whose stored mesh is the smallest
  // Of `all_holds` cases that hold, `holds_with` have a contact with all `shared` traits too.
  std::size_t holds_with = 0, all_holds = 0;
};

// Returns the groups, the one with the most kinds first. A single kind is in no group.
//
// Failures that do different things are in different groups. Failures that lose a contact (answered
// free, late, left out a pair or a candidate, let a limiter through) are grouped by the traits of
// the contact: its features and cause (cause.h), whether both triangles move, how small they are,
// whether it lies within a component or between two, whether the mesh is closed, and at least how
// many triangles the mesh has. The traits of a group set its contacts apart from the contacts of a
// hundred cases that hold, drawn from the whole run. They are not named if n failing cases might
// have them by chance: if (their share among cases that hold)^n is above 1e-4.
//
// Deterministic. The oracle judges again the cases that hold, which takes seconds. Without stores
// in the folder of the findings no traits are named.
std::vector<FailureGroup> failure_groups(const RunFindings& findings);

// Returns "34 of 51 kinds of failure lose a contact: edge-edge (of 100 colliding cases without
// a failure, 2 have such a contact)"; `kinds` is the number of all kinds.
std::string text_of(const FailureGroup& group, std::size_t kinds);

}  // namespace assay::properties
