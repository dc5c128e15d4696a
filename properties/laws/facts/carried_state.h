// What the laws of state ask of one instant: which triangles share a layer, and which of them the
// detector may have released (taken as clean again).
#pragma once

#include <string>
#include <vector>

#include "properties/laws/facts/case_facts.h"

namespace assay::properties {

using TriangleFlags = std::vector<std::uint8_t>;  // by triangle of the mesh, 0 or 1

// Says what contradicts that the triangles marked in `held` are untouched and that those of one
// component share a layer. Empty if nothing contradicts it.
std::string what_is_not_clean(const CaseFacts& facts, const oracle::LayerState& layers,
                              const TriangleFlags& held);

// Which triangles of `in_question` are clean at the start of step s, by the oracle. Such a
// triangle is untouched, and lies in the layer of those other triangles of its component that were
// carried on as clean; if there are none, it lies in the common layer (L9). REQUIRES has_views(s).
TriangleFlags may_be_clean(CaseFacts& facts, std::size_t s, const TriangleFlags& in_question);

// Whether account_of_dirty can be kept for step s: the arithmetic, the release and the test of
// ghosts are the exact ones, and this step and those that it continues are judged and trusted. A
// step without views has an account too, although it shows no doubts.
bool has_account(CaseFacts& facts, std::size_t s);

// L5 at the instant at which the step starts: all of S is positive, and the winding number is 1.
// REQUIRES has_views(s).
bool is_free_by_view_at_start(CaseFacts& facts, std::size_t s, std::size_t component);

// What is dirty by the oracle at a new start, of which nothing is known: the triangles that are
// not clean by its layers. Layers are not asked for with start unknown, nor with start verified
// under a culling that chooses views (view-auto, auto): there all components are dirty that are
// not free by view. REQUIRES has_views(s).
TriangleFlags dirty_at_a_new_start(CaseFacts& facts, std::size_t s);

// What is dirty at the start of step s, by L8, L9 and L15 and the oracle alone. At a new start it
// is dirty_at_a_new_start. Otherwise a triangle is dirty if it was in doubt after the step before
// (dirty by this account, touched by a ghost, or in contact with its own component), and is not
// now untouched and in the common layer. That layer is the one of the triangles that are not in
// doubt; in a component without any, it is the layer of most untouched triangles.
//
// A step without views releases nothing. At a new start all of its triangles are dirty, unless the
// caller vouched for the start; otherwise those that were in doubt after the step before. REQUIRES
// has_account(s).
TriangleFlags account_of_dirty(CaseFacts& facts, std::size_t s);
// The triangles that are in doubt after step s: those that were dirty at its start, were touched
// by a ghost, or were in contact with their own component. After a collision in a step with views
// of which not all pairs were asked for, all are in doubt. A step without views sweeps no ghosts,
// so after it all triangles of a component with ghosts are in doubt. REQUIRES has_account(s).
TriangleFlags in_doubt_after(CaseFacts& facts, std::size_t s);

// By triangle; 1: the result of step s marks it with doubt::dirty.
TriangleFlags dirty_triangles(const CaseFacts& facts, std::size_t s);

}  // namespace assay::properties
