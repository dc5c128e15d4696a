// Static contacts: which triangles meet at one instant, decided by integers alone.
#pragma once

#include <span>
#include <vector>

#include "detector/mesh/step_types.h"
#include "oracle/instant/instant.h"

namespace assay::oracle {

// Whether features at rest meet, decided by signs of integer determinants alone.
//
// The tests are as complete as those of contact.h: they decide degenerate, coplanar, collinear and
// coinciding features too. On degenerate ones they are faster, 1 to 5 us, because no time has to
// be found.

IntegerPoint operator-(const IntegerPoint& a, const IntegerPoint& b);
IntegerPoint cross(const IntegerPoint& a, const IntegerPoint& b);
Integer dot(const IntegerPoint& a, const IntegerPoint& b);

// Features name their vertices by index into the points.
using StaticPoints = std::span<const IntegerPoint>;
using StaticEdge = std::array<std::int32_t, 2>;
using StaticFace = std::array<std::int32_t, 3>;

// Whether two closed features have a point in common. A zero-area triangle is the segment or point
// that it has become.
bool vertex_meets_face(StaticPoints x, std::int32_t vertex, const StaticFace& face);
bool edges_meet(StaticPoints x, const StaticEdge& a, const StaticEdge& b);

// The condition of segment_pierces_triangle of contact.h: the ends lie strictly on opposite sides
// of the plane of the face, and the line passes strictly inside all three of its edges.
bool edge_pierces_face(StaticPoints x, const StaticEdge& edge, const StaticFace& face);

// All pairs in contact at the instant, ascending. Contact is defined in detector/README.md, The
// laws: two closed faces of the two triangles that share no vertex meet. So triangles that share a
// vertex or an edge are in contact when they meet beyond it, and triangles with the same three
// vertices always are. REQUIRES indices in range. 0.1 to 0.4 s for 20,000 triangles. If nothing
// moves in a step, judge_step finds the same set.
std::vector<detector::TrianglePair> contacts_at(const Instant& instant,
                                                const detector::TrianglesView& triangles,
                                                int jobs = 1);

// Whether any pair is in contact; stops at the first that it finds.
bool any_contact_at(const Instant& instant, const detector::TrianglesView& triangles, int jobs = 1);

// Element t of the result is 1 when triangle t meets another triangle of its own component, or a
// ghost of that component. REQUIRES that triangles and ghosts name vertices of this instant.
// `component` lists the component of each triangle, then that of each ghost.
std::vector<std::uint8_t> touched_at(const Instant& instant,
                                     const detector::TrianglesView& triangles,
                                     const detector::TrianglesView& ghosts,
                                     const std::vector<std::int32_t>& component, int jobs = 1);

}  // namespace assay::oracle
