// Metamorphic laws: a case that is changed in a way that must not matter gives the same answers,
// changed likewise. Of the built-in detector every bit is compared, in pinned runs. Laws that need
// nothing of the inside of a detector are judged of plug-ins too: these are put the case in its
// other form.
#pragma once

#include <string>
#include <string_view>

#include "detector/step_result.h"
#include "properties/changes/changes.h"
#include "properties/laws/law.h"

namespace assay::properties {

// Whether the law is judged of a plug-in: if it is about a change of the case that any detector can
// be put, or says that threads do not show, which the second runs of trials tell. No state is saved
// and restored, because the interface of plug-ins has no such call.
inline constexpr std::string_view threads_law = "Change_ThreadsDoNotShow";
bool is_of_plugins(const Law& law);

// Whether the case is in the share of cases that a plug-in is given in the form of this law.
bool is_given_in_form(const Law& law, std::string_view case_id);

// How the answer to a step of the form differs from that to the step of the case, both given by one
// detector; empty if it does not. `pairs`: whether all pairs were asked for.
std::string difference_in_form(const detector::StepResult& of_case, const Form& form,
                               const detector::StepResult& of_form, bool pairs = true);

// Compares the pinned run of the case with that of its form, or, if the change is made on a grid,
// that of the rounded case.
void check_change(CaseFacts& facts, LawTally& tally, const CaseChange& change);
template <const CaseChange& change>
void check_change(CaseFacts& facts, LawTally& tally) {
  check_change(facts, tally, change);
}

// Plays the form through the built-in detector, which chooses for itself, and compares answers,
// pairs and times.
void check_form(CaseFacts& facts, LawTally& tally, const CaseChange& change);
template <const CaseChange& change>
void check_form(CaseFacts& facts, LawTally& tally) {
  check_form(facts, tally, change);
}

}  // namespace assay::properties
