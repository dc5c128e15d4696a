// The elementary test of the production detector: vertex-face and edge-edge, exact by the ladder.
//
// Guarantee: the answer is that of exact arithmetic on the doubles given, for every finite input;
// touching counts, and so do t=0 and t=1. A time is the unique enclosure of TimeEnclosure.
#pragma once

#include "detector/contact/four_points.h"
#include "detector/exact/orientation.h"

namespace assay::detector {

enum class ContactRung : std::uint8_t { axis, filter, exact };

struct ContactRungCounts {
  std::uint64_t axis = 0, filter = 0, exact = 0;
  void add(ContactRung rung);
  std::uint64_t total() const { return axis + filter + exact; }
};

struct ContactResult {
  bool contact = false;
  TimeEnclosure time;                    // first contact time; set when contact and wanted
  ContactRung rung = ContactRung::axis;  // which rung decided whether there is a contact
};

// Mean 0.1 to 1 us for candidates of a mesh; a hit's time costs about 5 us more.
ContactResult test_contact(const FourPoints& query, Want want);

// The same for a query that separated_along_an_axis did not settle.
ContactResult test_contact_past_axis(const FourPoints& query, Want want);

// The stage of the detector: asked for every feature pair that axis order left open, and for edges
// that may pierce a triangle.
class ElementaryTest {
 public:
  virtual ~ElementaryTest() = default;
  virtual ContactResult test(const FourPoints& query, Want want) const {
    return test_contact_past_axis(query, want);
  }
  // Whether the open segment strictly pierces the open triangle, at one instant: how two triangles
  // that met before the step began are found.
  virtual bool pierces(const Point& e0, const Point& e1, const std::array<Point, 3>& face) const {
    return segment_pierces_triangle(e0, e1, face);
  }
};

}  // namespace assay::detector
