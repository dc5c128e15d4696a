// Metamorphic laws: if a case is changed in a way that must not matter, its answers stay the same,
// or change as the case does. For the built-in detector every bit is compared, in pinned runs
// (pinned_run.h). Laws that need nothing from the inside of a detector are judged for plug-ins,
// too; a plug-in runs the changed case.
#pragma once

#include <string>
#include <string_view>

#include "properties/changes/changes.h"
#include "properties/laws/law.h"

namespace assay::properties {

// The law about threads.
inline constexpr std::string_view threads_law = "Change_ThreadsDoNotShow";
// Returns whether the law is judged for plug-ins. A law is judged if it is about a change after
// which any detector can run the case. The law about threads is judged too: the second runs of
// trials test it. Laws about saved states are not judged, because the interface of plug-ins has no
// call that saves or restores a state.
bool is_of_plugins(const Law& law);

// Returns whether the case is in the share of cases that a plug-in gets in the form of this law.
bool is_given_in_form(const Law& law, std::string_view case_id);

// Returns how one detector's answer to a step of the form differs from its answer to the step of
// the case; empty if it does not differ. `pairs` says whether all pairs were asked for.
std::string difference_in_form(const StepResult& of_case, const Form& form,
                               const StepResult& of_form, bool pairs = true);

// Compares the pinned run of the case with the pinned run of its form. If the change is made on a
// grid, the case is rounded first.
void check_change(CaseFacts& facts, LawTally& tally, const CaseChange& change);
template <const CaseChange& change>
void check_change(CaseFacts& facts, LawTally& tally) {
  check_change(facts, tally, change);
}

// Plays the form through the built-in detector, unpinned, and compares answers, pairs and times.
void check_form(CaseFacts& facts, LawTally& tally, const CaseChange& change);
template <const CaseChange& change>
void check_form(CaseFacts& facts, LawTally& tally) {
  check_form(facts, tally, change);
}

}  // namespace assay::properties
