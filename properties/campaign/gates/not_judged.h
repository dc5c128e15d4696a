// Claims that a run has not judged, and why. The verdict says nothing about them.
#pragma once

#include <string>
#include <vector>

#include "properties/campaign/gates/findings.h"

namespace assay::properties {

struct NotJudged {
  std::string claim, reason;
};

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
Claims without(Claims claims, const std::vector<NotJudged>& left);

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

}  // namespace assay::properties
