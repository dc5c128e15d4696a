// What the laws of state ask of one instant: who shares a layer, who may have been released.
#pragma once

#include <string>
#include <vector>

#include "properties/laws/facts/case_facts.h"

namespace assay::properties {

using TriangleFlags = std::vector<std::uint8_t>;  // by triangle of the mesh, 0 or 1

// What contradicts that the triangles held are untouched and share one layer in each component;
// empty when nothing does.
std::string what_is_not_clean(const CaseFacts& facts, const oracle::LayerState& layers,
                              const TriangleFlags& held);

// Who of `in_question` the oracle lets go at the start of step s: untouched, and of the layer of
// the other triangles of the component that were carried on as clean; where there is none of these,
// of the common layer (L9). REQUIRES has_views(s).
TriangleFlags may_be_clean(CaseFacts& facts, std::size_t s, const TriangleFlags& in_question);

// Whether the account below can be kept for step s: it and the steps that it goes on from are
// judged, and trusted. A step without views has one too, although it shows no doubts.
bool has_account(CaseFacts& facts, std::size_t s);

// L5 where the step starts: all of S is positive there, and the winding number is 1. REQUIRES
// has_views(s).
bool is_free_by_view_at_start(CaseFacts& facts, std::size_t s, std::size_t component);

// What is dirty where nothing is known of the start, by the oracle: by its layers, or, under
// view-auto, which asks for none, all components that are not free by view. REQUIRES has_views(s).
TriangleFlags dirty_at_a_new_start(CaseFacts& facts, std::size_t s);

// L8, L9 and L15, by the oracle alone: what is dirty at the start of step s. At a new start see
// above; then what was dirty by this account, or touched by a ghost or in contact with its own
// component during the step before, and is not untouched and of the common layer now. That layer is
// the one of the triangles not in doubt; in a component without any, that of most untouched
// triangles.
//
// A step without views releases nothing: at a new start all is dirty, unless the caller vouched for
// it, and one that goes on has all that was in doubt after the step before.
// REQUIRES has_account(s).
TriangleFlags account_of_dirty(CaseFacts& facts, std::size_t s);
// Dirty at the start, touched or in contact during step s; all after a collision of which not all
// pairs were asked for; of a component with ghosts all, where the step has no views and so swept
// none. REQUIRES has_account(s).
TriangleFlags in_doubt_after(CaseFacts& facts, std::size_t s);

// The triangles with some or with no mark of doubt::dirty in the result of step s.
TriangleFlags dirty_triangles(const CaseFacts& facts, std::size_t s);

}  // namespace assay::properties
