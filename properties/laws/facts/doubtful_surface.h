// What L12 calls doubtful: input that is no surface of a body, and is answered all the same.
#pragma once

#include "properties/laws/facts/case_facts.h"

namespace assay::properties {

// Some edge has three or more triangles, or is used twice in one direction.
bool has_broken_edges(const CaseFacts& facts);

// Two vertices of triangles are at one place at the start of the step.
bool has_coincident_vertices(const CaseFacts& facts, std::size_t s);

// The triangle is a segment or a point at one end of the step or at both. Decided exactly.
bool has_zero_area(const CaseFacts& facts, std::size_t s, std::int32_t triangle);

// Untouched triangles of one component lie on different layers: nested shells, parts turned inside
// out.
bool has_several_layers(CaseFacts& facts, std::size_t s);

}  // namespace assay::properties
