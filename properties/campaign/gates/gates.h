// Decides whether a run holds. A gate is one demand on a run. judge() takes the findings of a run
// and a request, and returns the result of each gate. Only this header states the order of the
// gates, and the exit codes follow this order: a doubt about the harness goes before a defect, and
// a defect goes before work that is incomplete. Further functions list the claims that were not
// judged, and group failures.
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
// - harness: the run found every canary, and at least the share of the planted faults that the
//   plan's policy asks for. It found no equivalent fault, and the self-test found no contradiction.
//   If all trials of a whole campaign took place, the premise of every law held in as many steps as
//   the plan wants, and was close in a quarter of the steps in which it held. Every defect of a
//   trial was stored as a failure. If no canary was tried, the gate is not judged.
// - corpus: the shipped cases, scenes and the owner's cases hold.
// - claims: no claim and no law is broken in any trial or in any case of the search, and no world
//   has a counterexample.
// - complete: all planned work was done: shares, trials, the search, and planted faults with all of
//   their cases; for a certificate also the self-test and the corpus. Every case of the corpus has
//   an answer. At most 1 % of the trials were disturbed from outside. Enough contacts were judged
//   (lacks_of_contacts).
// - bounds: every wanted bound is met. In a stratum without a wanted bound every trial has a
//   verdict. Strata of large sizes may have trials without a verdict, because their bounds count
//   such trials.
// - speed: every figure that has a limit was measured, and no figure is above its limit. A figure
//   above its limit is no defect, because it shows no wrong answer. The gate is not judged for a
//   plug-in, or if no limit is set.
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
  // Why the gate fails or was not judged, one line for each reason. Empty if the gate holds.
  std::vector<std::string> reasons;
  // Only for a gate `complete` that fails: a sentence that says which reasons vanish if the run is
  // continued, and which do not.
  std::string remedy = {};
};

// Return the gates that a verb asks for. `assay run`: harness, claims, complete and bounds, and
// also corpus if the run had cases of its owner. `assay certify`: all gates.
VerbRequest asked_of_a_run();
VerbRequest asked_of_a_run(const RunFindings& findings);
VerbRequest asked_of_a_certificate();

struct Judgement {
  std::vector<GateResult> gates;  // in the order of gate_rules
  // If a gate fails, the verdict of the first gate that fails. Otherwise "not judged" if no gate
  // was judged, "certified" if a certificate was asked for, and "holds" for a run.
  std::string verdict;
  int exit_code = 0;
  std::optional<Gate> failed_gate;  // the first gate that fails

  const GateResult& of(Gate gate) const { return gates[static_cast<std::size_t>(gate)]; }
};

Judgement judge(const RunFindings& findings, const VerbRequest& request);
// Judges the gates of the request that the stores hold; if they hold no request, the gates that
// `assay run` asks for.
Judgement judge(const RunFindings& findings);

// The functions below tell which claims a run has not judged, and why. The verdict says nothing
// about these claims.

struct NotJudged {
  std::string claim, reason;
};
ASSAY_FIELDS(NotJudged, claim, reason)

// Returns the claims of a plug-in that were not judged, in the order of Claim. A claim is not
// judged if the contract makes it void, or if it was never tested: no step had a contact, or, for
// a claim about stated times, the interval of the first time was wider than 1e-3 in more than 1 %
// of the collisions. For a detector that is judged by steps and by queries, the steps decide. Empty
// for the built-in detector, whose contract is the default and whose times are enclosures.
std::vector<NotJudged> not_judged(const Claims& claims, const Contract& contract,
                                  const StepMeasures& measures, bool of_queries = false);
std::vector<NotJudged> not_judged(const BoundDetector& detector, const StepMeasures& measures,
                                  bool of_queries = false);
std::vector<NotJudged> not_judged(const RunFindings& findings);

// Returns the claims that are not among `gaps`.
Claims without(Claims claims, const std::vector<NotJudged>& gaps);

// Returns the names of the claims of a plug-in that were judged.
std::vector<std::string> judged_claims(const RunFindings& findings);

// Returns the families of the strata that are left out (RunFindings::is_left_out).
std::vector<std::string> left_out_families(const RunFindings& findings);

// The size of the largest mesh on which a claim was tried and judged.
struct JudgedSize {
  std::string claim;
  std::uint64_t triangles = 0;
};
ASSAY_FIELDS(JudgedSize, claim, triangles)
// Returns the sizes for the claims of all configurations, in the order of Claim. A claim about
// contacts is tried by steps with a contact that the contract does not leave out; the claim
// `deterministic` is tried by cases that were run twice. A claim that was tried on no mesh is not
// in the list, such as `progress` if no stratum asks for limits. Empty for a run that judges only
// queries, because queries have no size.
std::vector<JudgedSize> judged_sizes(const RunFindings& findings);

// Returns the extremes over all judged meshes of trials and of other sources.
Extremes largest_tried(const RunFindings& findings);

// Returns why too few contacts were judged for a verdict; empty if there were enough. In each
// family a tenth of the planned cases must have a contact; families of large sizes, and families
// that are left out, need none. At least three families must have a case with a contact; if no
// certificate is asked for and the campaign has fewer families, each of them must. Contacts that
// the contract leaves out do not count. Nothing is demanded if no claim speaks of contacts, or if
// the contract makes all such claims void. The result also names each claim that was not judged
// because no step had a contact, or no step with a contact had an answer to judge.
std::vector<std::string> lacks_of_contacts(const RunFindings& findings, bool for_certificate);

// A group of kinds of failure that one change of the detector would probably repair. A single
// mistake can appear as several kinds, because a signature names the contact that happened to be
// lost.

struct FailureGroup {
  std::string does;                // "lose a contact", "end without an answer"
  std::vector<std::string> kinds;  // signatures, in the order of RunFindings::kinds()
  // The traits that all contacts lost by the group have in common; empty if there are none.
  std::vector<std::string> shared;
  std::string smallest;  // the kind whose stored mesh is the smallest
  // all_holds: the number of cases that hold and were compared with the group. holds_with: how many
  // of these cases have a contact with all `shared` traits.
  std::size_t holds_with = 0, all_holds = 0;
};

// Returns the groups; the group with the most kinds comes first. If there is only one kind of
// failure, there is no group.
//
// Failures of different deeds (claims.h) are in different groups. Failures that lose a contact are
// grouped by the traits of the contact: its features and cause (cause.h), whether both triangles
// move, how small the smaller triangle is, whether the contact lies within one component or between
// two, whether the mesh is closed, and a lower bound of its number of triangles. The traits of a
// group distinguish its contacts from the contacts of a hundred cases that hold, drawn from the
// whole run. If p is the share of these cases that have the traits, and the group has n failing
// cases, the traits are named only if p^n, the probability of a coincidence, is at most 1e-4.
//
// Deterministic. The oracle judges each case that holds once more, which takes seconds. If the
// folder of the findings has no stores, no traits are named.
std::vector<FailureGroup> failure_groups(const RunFindings& findings);

// Returns "34 of 51 kinds of failure lose a contact: edge-edge (of 100 colliding cases without
// a failure, 2 have such a contact)". `kinds` is the number of all kinds of failure.
std::string text_of(const FailureGroup& group, std::size_t kinds);

}  // namespace assay::properties
