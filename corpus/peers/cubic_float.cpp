// The textbook method (cubic.h) in floats, the roots in closed form, as it runs on graphics cards.
//
// Version: 1, of this file. Settings: one tolerance of 1e-5, of barycentric numbers and of times,
// which is some 80 steps of a float below 1; coefficients below 1e-7 of the greatest count as
// zero. Contract: float32, no contact at the start, coordinates of usual sizes, times within the
// tolerance. Claims: those of cubic_double.cpp, from the same place, which speaks of no
// arithmetic.
#include "corpus/peers/closed_form.h"

namespace assay::peers {
namespace {

struct Floats {
  using Number = float;
  static constexpr float tolerance = 1e-5f, small = 1e-7f;
};

struct CubicFloat : FeaturePairs<CubicTests<ClosedForm<Floats>>> {
  using FeaturePairs::FeaturePairs;
  static plugin::Description describe() {
    plugin::Description d = cubic_description();
    d.name = "cubic in floats, tolerance 1e-5";
    d.coordinates = ASSAY_COORDINATES_FLOAT32;
    d.time_tolerance = 1e-5;
    return d;
  }
};

}  // namespace
}  // namespace assay::peers

ASSAY_EXPORT_DETECTOR(assay::peers::CubicFloat);
