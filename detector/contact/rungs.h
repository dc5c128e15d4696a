// The rungs of the elementary test (elementary.h). The axis rung compares inputs, and the filter
// rung computes in doubles with proved bounds. Neither ever decides wrongly, and a query that a
// rung cannot decide goes to the next rung. This header declares, in this order: these two rungs,
// the tests without integers (in doubles with proved bounds, and in plain doubles or floats), and
// the rungs of integers. Only integers without bound allocate.
#pragma once

#include <optional>

#include "detector/contact/contact_pieces.h"
#include "detector/contact/elementary.h"
#include "detector/exact/bernstein.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

// The axis rung. Returns whether the two groups are more than `by` apart along an axis, in the same
// sense at t=0 and at t=1. Then they are more than `by` apart throughout, because every point moves
// linearly; with `by` 0 this means that there is no contact. Exact: if the rounded difference of
// two doubles is greater than a double, so is their exact difference. REQUIRES by >= 0. About 10
// ns.
bool separated_along_an_axis(const FourPoints& query, double by = 0);

struct FilterResult {
  Decision decision = Decision::open;
  // Set only if the decision is yes and a time is wanted. True if the first contact time is
  // known to be the only root of the coplanarity cubic in (lo, hi), and the cubic certainly
  // changes its sign there.
  bool time_bracketed = false;
  double lo = 0, hi = 1;
  double time_guess = 0;  // a double near that root
};

// The filter rung. Decides a query if Bernstein coefficients over pieces of [0,1] can tell. 0.1 to
// 1.5 us.
FilterResult filter_contact(const FourPoints& query, Want want);

// The limits of halving pieces. A halving takes 40 ns, and integers (contact_fixed.cpp) take 2 us.
// If the signs of the cubic at the beginning and at the end of a piece are certain, halving soon
// finds the part with the root, and the signs of the dependencies in that part. With these depths
// 37 of 5,171 queries of a simulation stay open, and 1,097 with a depth of two. If one of the two
// signs is not certain, more halvings are mostly useless; for example at a contact just at t=0, or
// if points stay coplanar. They are also mostly useless once a piece was not decided.
inline constexpr int max_filter_depth = 8, max_unsure_depth = 2, max_filter_halvings = 16;

// Tests only in doubles with proved bounds. If doubles cannot tell, `rung` is `open` and a contact
// is reported, so no contact is ever missed. The time is an interval of doubles that contains the
// first contact time if there is a contact. It is proved that there is no contact before lo, so lo
// is never late. hi is a time by which a contact is certain, or 1 if no contact is certain.
// REQUIRES a query for which separated_along_an_axis returns false. 0.1 to 5 us, no allocation.
ContactResult bounded_contact(const FourPoints& query, Want want);

// Encloses in doubles the first root of a cubic whose coefficients are known only up to a bound.
//
// f holds the Bernstein coefficients over [lo,hi], each off by at most `bound`. REQUIRES that lo
// and hi are k / 2^n with n <= 32, and that f has certain and different signs at lo and at hi. The
// result is a closed interval. For each cubic whose coefficients differ from f by at most `bound`,
// it contains the first root in [lo,hi]: it begins at a time up to which there is certainly no
// root, and ends at a time by which the sign has certainly changed. Nothing is promised about the
// width of the interval. 0.1 us; 1 us if roots are close together.
TimeEnclosure enclose_first_root(const Cubic& f, double bound, double lo, double hi);

// Tests in plain doubles or floats: the filter rung with bounds 0, and no integers. It promises
// nothing; it exists to be measured.
//
// `rung` is always `filter`, and the time is one double. Number is double or float; coordinates are
// first rounded to Number. REQUIRES a query for which separated_along_an_axis returns false.
// 0.1 to 1 us.
template <class Number>
ContactResult plain_contact(const FourPoints& query, Want want);

// The integer rungs of the elementary test: integers of fixed width, and integers without bound for
// the queries that integers of fixed width do not decide. Together they decide every query. They
// treat every degenerate case by the same few rules (contact_exact.cpp).

// Returns whether there is a contact, its first time with Want::first_time, and the rung (`fixed`
// or `unbounded`) that decided. With Want::yes_no the time in the result has no meaning. Exact for
// all finite inputs. 0.2 to 1 us for coordinates of similar magnitude.
ContactResult exact_contact(const FourPoints& query, Want want = Want::first_time);

// Returns the time of a contact that the filter has bracketed. REQUIRES that this time is the only
// root of the coplanarity cubic in (lo, hi), and that the cubic changes its sign there. `guess` is
// near that time. 0.4 us for coordinates of similar magnitude.
TimeEnclosure exact_bracketed_time(const FourPoints& query, double lo, double hi, double guess);

// Do the same as exact_contact and exact_bracketed_time, but only in integers without bound.
// exact_contact and exact_bracketed_time call them if integers of fixed width do not decide.
// nullopt means that there is no contact. 5 to 50 us for coordinates of similar magnitude; the time
// grows with the spread of their exponents, to 2 ms over all doubles.
std::optional<TimeEnclosure> general_first_contact(const FourPoints& query);
TimeEnclosure general_bracketed_time(const FourPoints& query, double lo, double hi, double guess);

// Returns whether the four points are coplanar at all times, which means that the coplanarity cubic
// vanishes identically.
bool coplanar_throughout(const FourPoints& query);

// The rung `fixed`: exact integers of fixed width. It computes in the smallest of a few widths into
// which the coordinates of the query fit. This rung never decides wrongly. Its decision is `open`
// if the signs over a few pieces of the step do not show whether there is a contact, or if the
// exponents of the coordinates differ too much. It allocates nothing.

struct FixedResult {
  Decision decision = Decision::open;
  TimeEnclosure time;  // set only if the decision is yes and a time is wanted
};

// Decides a query if it can. 0.2 to 1 us for coordinates of similar magnitude.
FixedResult fixed_contact(const FourPoints& query, Want want);

// Returns the only root of the coplanarity cubic in (lo, hi), or nullopt if the exponents of the
// coordinates differ too much. The preconditions are those of exact_bracketed_time. 0.4 us.
std::optional<TimeEnclosure> fixed_bracketed_time(const FourPoints& query, double lo, double hi,
                                                  double guess);

}  // namespace assay::detector
