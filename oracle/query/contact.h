// The exact referee for one vertex-face or edge-edge query.
//
// Guarantee: the answer is that of exact arithmetic on the input doubles, for every finite input,
// also for degenerate features, for features at rest, and for points that are coplanar or collinear
// throughout. Touching is a contact, and the step includes t = 0 and t = 1. Coordinates must be
// finite. Cost: 0.03 us if an axis separates the two features; 1 to 2 us in interval arithmetic,
// and about 8 us more if a time is wanted; about 10 us in integers for degenerate and nearly
// degenerate queries (0.4 ms when exponents spread over all doubles). Thread safe, because threads
// share no number objects. Ends the process when the processor does not round to nearest or flushes
// denormals.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "detector/mesh/step_types.h"

namespace assay::oracle {

// The rung that decided whether there is a contact. For one query, `Want::yes_no` and
// `Want::first_time` can be decided by different rungs, because a time is harder to decide.
enum class Rung : std::uint8_t { axis, interval, quadratic };

struct RungCounts {
  std::uint64_t axis = 0, interval = 0, quadratic = 0;
  void add(Rung rung);
  RungCounts& operator+=(const RungCounts& other);
  friend bool operator==(const RungCounts&, const RungCounts&) = default;
};

struct ContactAnswer {
  bool contact = false;
  // The first contact time; set only when contact is true and a time was wanted.
  detector::TimeEnclosure first;
  Rung rung = Rung::axis;
};

ContactAnswer contact_of(const detector::FourPoints& query, detector::Want want);
ContactAnswer vertex_face_contact(const detector::VertexFace& query, detector::Want want);
ContactAnswer edge_edge_contact(const detector::EdgeEdge& query, detector::Want want);

// Returns the first contact time, or nothing if there is no contact. Uses CGAL's algebraic kernel
// and none of the rungs, so the rungs can be compared with it. Takes 0.1 to 0.4 ms (7 ms when
// exponents spread over all doubles).
std::optional<detector::TimeEnclosure> first_time_by_kernel(const detector::FourPoints& query);

// Returns whether, without motion, the open segment e0e1 strictly pierces the open triangle f0f1f2:
// the ends lie strictly on opposite sides of its plane, and the line passes strictly inside all
// three edges.
bool segment_pierces_triangle(const detector::Point& e0, const detector::Point& e1,
                              const std::array<detector::Point, 3>& face);

// The shape of a contact: a special property that makes a careless test miss the contact. A contact
// has the first of these shapes that applies to it. F is the cubic whose zeros are the times at
// which the four points lie in a plane (contact_events.h).
enum class ContactShape : std::uint8_t {
  parallel_edges,       // the two edges are parallel, or one is a point, throughout the step
  coplanar_throughout,  // F is zero throughout
  double_root,          // F has a zero of multiplicity 2 or 3 at the time of the contact
  at_end_of_feature,    // the vertex meets an edge of the face, or one edge an end of the other
  generic,
};

// Returns the shape of the first contact of a query. REQUIRES that the query has a contact and that
// `first` encloses its first time. About 50 us; in degenerate queries a few ms.
ContactShape shape_of(const detector::FourPoints& query, const detector::TimeEnclosure& first);

}  // namespace assay::oracle
