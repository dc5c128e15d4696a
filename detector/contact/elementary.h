// The elementary test of the production detector, vertex-face and edge-edge. It is a ladder of
// rungs: axis order, doubles with proved bounds, integers. Each rung decides with certainty or
// passes the query on.
//
// Guarantee of exact arithmetic: for every finite input the answer is that of exact arithmetic on
// the doubles given. Touching counts, and a contact at t=0 or at t=1 counts. A time is given by its
// unique enclosure (TimeEnclosure). For the other arithmetics see rungs.h.
#pragma once

#include <memory>

#include "detector/contact/lanes/query_lanes.h"
#include "detector/geometry/orientation.h"
#include "detector/mesh/step_counts.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

struct ContactResult {
  bool contact = false;
  TimeEnclosure time;                    // of the first contact; set only with Want::first_time
  ContactRung rung = ContactRung::axis;  // which rung decided whether there is a contact
};

// Tests a query. Axis order is tested first, in every arithmetic, on the inputs before any
// rounding. In exact arithmetic the test takes 0.1 to 1 us on average for candidates of a mesh; the
// time of a contact costs about 1 us more.
ContactResult test_contact(const FourPoints& query, Want want,
                           Arithmetic arithmetic = Arithmetic::exact);

// Does the same in exact arithmetic. REQUIRES a query for which separated_along_an_axis returns
// false.
ContactResult test_contact_past_axis(const FourPoints& query, Want want);

// The elementary test as a stage of the detector. It tests every feature pair that axis order does
// not decide, and edges that may pierce a triangle.
class ElementaryTest {
 public:
  virtual ~ElementaryTest() = default;
  // Returns 0 if this tests for contacts, or d > 0 if it tests for features that come within d.
  virtual double separation() const { return 0; }
  // Returns kernels that test many queries at once, or null. A query that the kernels decide is not
  // given to the functions below. A stage that does not override this is given every query.
  virtual const QueryKernels* first_rungs() const { return nullptr; }
  // Returns whether the axis rung (rungs.h) shows that the features stay apart.
  virtual bool is_apart_along_an_axis(const FourPoints& query) const;
  virtual ContactResult test(const FourPoints& query, Want want) const {
    return test_contact_past_axis(query, want);
  }
  // Does the same, except that it may return no contact if the first contact is later than `until`.
  // REQUIRES until in [0,1], and a test whose times are unique enclosures.
  virtual ContactResult test_until(const FourPoints& query, Want want, double until) const;
  // Returns whether the open segment strictly pierces the open triangle at one instant. In this way
  // the detector finds two triangles that met before the step began.
  virtual bool pierces(const Point& e0, const Point& e1, const std::array<Point, 3>& face) const {
    return segment_pierces_triangle(e0, e1, face);
  }
  // Returns the first contact time of two triangles for which pierces() returned true at t=0.
  virtual TimeEnclosure piercing_time(const Point&, const Point&,
                                      const std::array<Point, 3>&) const {
    return {0, 0};
  }
};

// Returns the stage for this arithmetic.
std::shared_ptr<const ElementaryTest> make_elementary_test(Arithmetic arithmetic);

// Says whether the two features of an elementary query stay apart up to a time `until`. Searches
// for the first contact use this: once a contact is known, the times of later contacts do not
// matter.
//
// `by_doubles`, `by_integers`: there is no contact in [0, until]; doubles, or integers of fixed
// width, prove this. `no`: there is a contact, or neither doubles nor these integers can tell. 0.1
// us by doubles, 0.2 to 0.6 us with integers. No allocation. REQUIRES until in [0,1].
enum class Later : std::uint8_t { no, by_doubles, by_integers };
Later surely_later(const FourPoints& query, double until);

}  // namespace assay::detector
