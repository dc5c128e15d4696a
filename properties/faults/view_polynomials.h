// Turns the view test of one triangle into exact polynomials in the time of the step. Planted
// faults use them in wrong ways.
#pragma once

#include <type_traits>

#include "detector/exact/real_root.h"
#include "detector/view/view_signs.h"
#include "properties/words.h"

namespace assay::properties {

using PolynomialVector = std::array<detector::Polynomial, 3>;

detector::Polynomial dot(const PolynomialVector& x, const PolynomialVector& y);

// The polynomials of one triangle (corners p0, p1, p2, normal N) and one primitive (ends q0, q1).
// The polynomials have a common positive factor, which changes no sign.
struct ViewPolynomials {
  PolynomialVector to_corner;                  // p0 - q0
  PolynomialVector normal;                     // N
  detector::Polynomial h0, h1;                 // (p0 - q0).N, (p0 - q1).N
  detector::Polynomial length2;                // d.d, d = q1 - q0
  detector::Polynomial d_normal;               // d.N
  std::array<detector::Polynomial, 3> g0, g1;  // by corner: (p - q0).d, (p - q1).d
};
ViewPolynomials view_polynomials(const detector::MovingTriangle& triangle,
                                 const ViewPrimitive& primitive);

// Returns the sign of f over [0,1], or zero if f has a zero there.
ViewSign strict_sign(const detector::Polynomial& f);

// Replace f by its value at t=0, by its value at t=1, or by the line through both values.
detector::Polynomial at_start(const detector::Polynomial& f);
detector::Polynomial at_end(const detector::Polynomial& f);
detector::Polynomial linear_between_ends(const detector::Polynomial& f);
PolynomialVector at_start(const PolynomialVector& x);
PolynomialVector linear_between_ends(const PolynomialVector& x);

// The view value of one point of the triangle in pieces: h0 where g0 <= 0, h1 where g1 >= 0, and
// `middle` in between.
struct ViewPieces {
  detector::Polynomial h0, h1, middle, g0, g1;
};
ViewPieces pieces_of_corner(const ViewPolynomials& view, std::size_t corner);
// Returns the strict sign of the view value over [0,1]; zero if it has none.
ViewSign sign_of(const ViewPieces& pieces);

// The times t=0, t=1/2 and t=1. sign_at() returns the sign of the triangle if the triangle and the
// primitive rest where they are at this time. still() returns the point at rest where it is at this
// time. Both are exact if the middle of two coordinates is a double.
enum class Sample { start, middle, end };
ViewSign sign_at(Sample sample, const detector::MovingTriangle& triangle,
                 const ViewPrimitive& primitive);
MovingPoint still(Sample sample, const MovingPoint& point);

// Returns the sign if all signs are equal, else zero.
ViewSign common_sign(std::initializer_list<ViewSign> signs);

// Returns the sign if the signs at all these times are equal, else zero. A fault uses this sign for
// the whole step.
template <Sample... samples>
ViewSign sampled(const detector::MovingTriangle& triangle, const ViewPrimitive& primitive) {
  return common_sign({sign_at(samples, triangle, primitive)...});
}

// A classifier that looks at one triangle after the other.
class TriangleSigns : public detector::ViewClassifier {
 public:
  bool classify(const detector::Topology& surface, const detector::Component& component,
                const SteppedMesh& motion, const ViewPrimitive& primitive,
                std::vector<ViewSign>& signs, detector::ViewCounts& counts,
                detector::PacedStop& pace) const override;
  virtual ViewSign sign(const detector::MovingTriangle& triangle,
                        const ViewPrimitive& primitive) const = 0;
};

// A TriangleSigns whose sign is given by the function `look`, from the step's polynomials or from
// the triangle itself.
template <auto look>
struct Signs : TriangleSigns {
  ViewSign sign(const detector::MovingTriangle& triangle,
                const ViewPrimitive& primitive) const override {
    if constexpr (std::is_invocable_v<decltype(look), const ViewPolynomials&>) {
      return look(view_polynomials(triangle, primitive));
    } else {
      return look(triangle, primitive);
    }
  }
};

// Returns the sign that the detector's own view test gives.
ViewSign right_sign(const detector::MovingTriangle& triangle, const ViewPrimitive& primitive);

}  // namespace assay::properties
