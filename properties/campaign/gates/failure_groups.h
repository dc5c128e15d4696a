// The kinds of failure of a run, grouped by what one change of the detector would mend: one mistake
// shows as many kinds, because a signature names the contact that happened to be lost.
#pragma once

#include <string>
#include <vector>

#include "properties/campaign/gates/findings.h"

namespace assay::properties {

struct FailureGroup {
  std::string does;                // "lose a contact", "report what is not there"
  std::vector<std::string> kinds;  // signatures, in the order of RunFindings::kinds()
  // What all contacts that it lost have in common; perhaps nothing.
  std::vector<std::string> shared;
  std::string smallest;  // the kind whose stored mesh is the smallest
  // In so many of those cases that hold and were looked at, some contact has all of that, too.
  std::size_t held_with = 0, held = 0;
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
