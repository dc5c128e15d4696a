// Changes a case, for the reducer's passes. Each change returns a new case without unused parts:
// vertices without a triangle and frames without a step are dropped, indices are renumbered in
// their old order, and the expected facts are cleared, because they were about the old case.
//
// A relation is carried over to the vertices and triangles that are left (carried_over).
//
// If a case has ghosts, new ones are made from the unmatched edges of the new mesh. Each fan
// takes the apex of an old fan with which it shares a vertex, or else the mean of its loop.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "properties/numbering.h"

namespace assay::properties {

// Returns whether the case is valid; only valid cases are judged. A valid case has at least one
// triangle, step and frame; indices are in range, none twice in a triangle; no two triangles have
// the same three vertices; coordinates are finite; frames, view and apexes have equal lengths; the
// relation fits.
bool is_valid(const Case& c);

inline std::size_t vertex_count(const Case& c) {
  return static_cast<std::size_t>(c.frames.front().rows());
}

Case with_triangles(const Case& c, const std::vector<std::array<std::int32_t, 3>>& triangles);

std::vector<std::array<std::int32_t, 3>> triangles_of(const Case& c);

inline std::array<std::int32_t, 3> as_set(std::array<std::int32_t, 3> corners) {
  std::ranges::sort(corners);
  return corners;
}

// Returns the case with the triangles t for which keep[t] != 0.
Case keep_triangles(const Case& c, const std::vector<std::uint8_t>& keep);

// Returns the case in which vertex v becomes target[v]. Chains of targets are followed to their
// end; REQUIRES that every chain has an end. Triangles that then repeat an index are dropped, and
// so are pairs of equal, oppositely oriented triangles, so that a closed mesh stays closed.
Case merge_vertices(const Case& c, const std::vector<std::int32_t>& target);

// Closes each loop of unmatched edges with a fan from the loop's vertex number `corner` (modulo
// its length), without a new vertex. A closed mesh is returned as it is.
Case close_loops(const Case& c, std::size_t corner);

// Returns the case seen from a fixed point, the mean of all places of all vertices.
Case seen_from_its_middle(const Case& c);

// Returns the case with these steps only. The script is left out if each step goes from one frame
// to the next.
Case with_steps(const Case& c, const std::vector<CaseStep>& steps);

// Carries the relation of a case, which says which pairs count (detector/mesh/counted_pairs.h),
// over to a changed mesh.

// The map from old to new vertices. Several old vertices can become one new vertex. It gets its
// body and its place at rest from the old vertex that `was` names.
struct NewVertices {
  std::vector<std::int32_t> number;  // by old vertex: its new number, or -1 if it is gone
  std::vector<std::int32_t> was;     // by new vertex: the number of one old vertex
};

// Returns the relation for the triangles `after`, over new vertices; `before` are the old
// triangles, over old vertices. A triangle stays the same if its three vertices stay. Listed pairs
// with a dropped part are left out, and bodies without vertices, too. All other pairs and bodies
// are renumbered in their old order.
CountedPairs carried_over(const CountedPairs& pairs, const Triangles& before,
                          const Triangles& after, const NewVertices& vertices);

}  // namespace assay::properties
