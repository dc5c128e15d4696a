// Features at rest: whether they meet, by signs of integer determinants alone.
//
// Complete like contact.h (degenerate, coplanar, collinear, coinciding features), and faster on
// what is degenerate: 1 to 5 us, as no time has to be found.
#pragma once

#include <span>

#include "oracle/instant/instant.h"

namespace assay::oracle {

IntegerPoint operator-(const IntegerPoint& a, const IntegerPoint& b);
IntegerPoint cross(const IntegerPoint& a, const IntegerPoint& b);
Integer dot(const IntegerPoint& a, const IntegerPoint& b);

// Vertices named by index into the points.
using StaticPoints = std::span<const IntegerPoint>;
using StaticEdge = std::array<std::int32_t, 2>;
using StaticFace = std::array<std::int32_t, 3>;

// Closed features; a zero-area triangle is the segment or point that it has become.
bool vertex_meets_face(StaticPoints x, std::int32_t vertex, const StaticFace& face);
bool edges_meet(StaticPoints x, const StaticEdge& a, const StaticEdge& b);

// As segment_pierces_triangle of contact.h: ends strictly on opposite sides of the plane, line
// strictly inside all three edges.
bool edge_pierces_face(StaticPoints x, const StaticEdge& edge, const StaticFace& face);

}  // namespace assay::oracle
