// Changes of a case from which the reducer's passes are made. Each returns a new case with nothing
// unused in it: vertices without a triangle and frames without a step go, indices are renumbered in
// their old order, the expected facts (they were of the old case) are cleared.
//
// Where a case has ghosts they are made anew from the unmatched edges of the new mesh; each fan
// takes the apex of an old fan that it shares a vertex with, or else the mean of its loop.
#pragma once

#include <cstdint>
#include <vector>

#include "corpus/cases/case_file.h"
#include "properties/numbering.h"

namespace assay::properties {

// At least one triangle, step and frame; indices in range, none twice in a triangle; no two
// triangles with the same three vertices; coordinates finite; frames, view and apexes of equal
// lengths. Only such cases are judged.
bool is_valid(const corpus::Case& c);

inline std::size_t vertex_count(const corpus::Case& c) {
  return static_cast<std::size_t>(c.frames.front().rows());
}

corpus::Case with_triangles(const corpus::Case& c,
                            const std::vector<std::array<std::int32_t, 3>>& triangles);

std::vector<std::array<std::int32_t, 3>> triangles_of(const corpus::Case& c);

// Triangles t with keep[t] != 0.
corpus::Case keep_triangles(const corpus::Case& c, const std::vector<std::uint8_t>& keep);

// Vertex v becomes target[v] (followed until it ends; no circles). Triangles that thereby repeat an
// index go, and so do pairs of equal, oppositely oriented triangles: a cycle stays a cycle.
corpus::Case merge_vertices(const corpus::Case& c, const std::vector<std::int32_t>& target);

// Closes each loop of unmatched edges with a fan from the loop's vertex number `corner` (modulo its
// length): no new vertex. A closed mesh is returned as it is.
corpus::Case close_loops(const corpus::Case& c, std::size_t corner);

// Seen from a fixed point: the mean of all places of all vertices.
corpus::Case seen_from_its_middle(const corpus::Case& c);

// These steps only; the script is left out where it says no more than consecutive frames do.
corpus::Case with_steps(const corpus::Case& c, const std::vector<corpus::CaseStep>& steps);

}  // namespace assay::properties
