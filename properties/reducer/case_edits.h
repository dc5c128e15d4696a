// Changes of a case from which the reducer's passes are made. Each returns a new case with nothing
// unused in it: vertices without a triangle and frames without a step are dropped, indices are
// renumbered in their old order, and the expected facts are cleared, because they were those of
// the old case.
//
// A relation goes on with the vertices and triangles that are left (carried_over).
//
// If a case has ghosts, they are made anew from the unmatched edges of the new mesh. Each fan
// takes the apex of an old fan with which it shares a vertex, or else the mean of its loop.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "corpus/cases/case_file.h"
#include "detector/mesh/counted_pairs.h"
#include "detector/mesh/types.h"
#include "properties/numbering.h"

namespace assay::properties {

// Whether the case is valid; only valid cases are judged. It has at least one triangle, step and
// frame; indices are in range, none twice in a triangle; no two triangles have the same three
// vertices; coordinates are finite; frames, view and apexes have equal lengths; the relation fits.
bool is_valid(const corpus::Case& c);

inline std::size_t vertex_count(const corpus::Case& c) {
  return static_cast<std::size_t>(c.frames.front().rows());
}

corpus::Case with_triangles(const corpus::Case& c,
                            const std::vector<std::array<std::int32_t, 3>>& triangles);

std::vector<std::array<std::int32_t, 3>> triangles_of(const corpus::Case& c);

inline std::array<std::int32_t, 3> as_set(std::array<std::int32_t, 3> corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

// The case with the triangles t for which keep[t] != 0.
corpus::Case keep_triangles(const corpus::Case& c, const std::vector<std::uint8_t>& keep);

// The case in which vertex v becomes target[v] (followed until it ends; REQUIRES no circles).
// Triangles that thereby repeat an index are dropped, and so are pairs of equal, oppositely
// oriented triangles, so that a cycle stays a cycle.
corpus::Case merge_vertices(const corpus::Case& c, const std::vector<std::int32_t>& target);

// Closes each loop of unmatched edges with a fan from the loop's vertex number `corner` (modulo
// its length), without a new vertex. A closed mesh is returned as it is.
corpus::Case close_loops(const corpus::Case& c, std::size_t corner);

// The case seen from a fixed point, the mean of all places of all vertices.
corpus::Case seen_from_its_middle(const corpus::Case& c);

// The case with these steps only. The script is left out if it says no more than that consecutive
// frames are the steps.
corpus::Case with_steps(const corpus::Case& c, const std::vector<corpus::CaseStep>& steps);

// The relation of a case, which says which pairs count (detector/mesh/counted_pairs.h), for a mesh
// that has changed.

// What has become of the vertices. Several old vertices may be one new one; it has the body and the
// place at rest of the old one that it was.
struct NewVertices {
  std::vector<std::int32_t> number;  // by old vertex: its new number, or -1 if it is gone
  std::vector<std::int32_t> was;     // by new vertex: an old number of it
};

// The relation for the triangles `after`, over new vertices, that were `before`, over old ones. A
// triangle stays the same if its three vertices do. Pairs in lists of which a part is gone are left
// out, and so are bodies without vertices; the others are numbered anew in their old order.
detector::CountedPairs carried_over(const detector::CountedPairs& pairs,
                                    const detector::Triangles& before,
                                    const detector::Triangles& after, const NewVertices& vertices);

}  // namespace assay::properties
