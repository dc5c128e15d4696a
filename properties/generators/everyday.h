// Everyday numbers: lengths, places and ends as programs make them.
//
// Sizes are 10^-4 to 10^6 and no powers of two. Places are decimals, inches, quotients or float32,
// or are turned by any angle; ends come from x + v dt, from x + dx, or are rounded as places are.
// So mantissas are full and x0 + (x1 - x0) is often not x1, and yet much is level, as floors and
// boxes are. Detectors that round on the way to their arithmetic err here. They err neither at
// random places, where nothing is level, nor at small integers, where nothing is rounded.
#pragma once

#include "properties/generators/draft.h"

namespace assay::properties {

// Returns a size between 10^-4 and 10^6: three digits times a power of ten.
double everyday_size(Random& random);

// Returns the double `units` units of the last place from `c` in the direction of the sign of
// `towards`, or in the opposite one if `units` is negative. A unit of 0 is one of 1.
double units_beyond(double c, int units, double towards);

// Moves the first `first_group` of four points, which come by `way`, along one axis: to where they
// touch the other points or have passed them by less than a unit of the last place, and `units`
// units beyond. One point touches a face and two touch an edge, by the exact sign of their volume.
void put_on(std::array<Point, 4>& x, std::size_t first_group, const Point& way, int units);

// Draws how far beyond a feature something ends: 0 for two of three, else 1 to 16 units of the
// last place, or now and then 1 to 4 short of it.
int units_at_a_feature(Random& random);

// The numbers of one program, drawn once for a case.
class EverydayNumbers {
 public:
  explicit EverydayNumbers(Random& random);

  // The place of a point that is given in units of the size.
  Point place(const Point& x) const;
  // Where a vertex ends that is at `x0` and moves by `way`, which is given in units of the size.
  Point end(const Point& x0, const Point& way) const;
  // Whether coordinates that are equal stay equal in places and ends.
  bool keeps_levels() const { return !is_turned_; }
  const char* tag() const;

 private:
  enum Rounding { none, decimals, inches, quotient, float32 };
  enum Motion { velocity, sum, rounded_end };
  double rounded(double c) const;
  Point turned(const Point& x) const;

  double size_;
  Rounding rounding_;
  Motion motion_;
  int grain_ = 0;                // places are multiples of 10^grain_ ...
  double multiplier_ = 1;        // ... times this
  double divisor_ = 1;           // ... over this
  double time_step_ = 1;         // of a motion by velocity
  Point offset_ = {0, 0, 0};     // of the whole scene, in units of the size
  bool is_turned_;               // by any angle, before places are rounded
  std::array<Point, 3> rows_{};  // of the turn
};

// Gives a draft everyday numbers, and lets its landings meet. Frames, view and axis are in units of
// the size before.
void use_everyday_numbers(Random& random, Draft& draft);

// Makes two pieces of about `size` triangles together, in units of the size: one rests or rises,
// has a level top, and the other comes down on it. A vertex or a level edge of the upper piece
// lands on the top, on its border or at its corner, where a step ends; or the piece goes on through
// the top, slides along it, begins there, or stays and leaves again. A third of the open pieces is
// flat and mostly slides within the plane of the top.
Draft falling_piece(Random& random, bool closed, int size);

}  // namespace assay::properties
