// The coordinates of a case as a list, and simpler values for one of them.
#pragma once

#include <vector>

#include "corpus/cases/case_file.h"

namespace assay::properties {

// Coordinates that are changed together: those on one axis of one place (a vertex, an end of the
// view primitive, an apex), in all frames in which they have the same value. So what rests goes on
// resting.
using NumberGroup = std::vector<double*>;

// All groups: those of vertex 0, 1, .. by axis and value, then those of the view, then those of
// the apexes. Valid as long as the shape of `c` is not changed.
std::vector<NumberGroup> number_groups(corpus::Case& c);

// The coordinates along one axis, or along all (axis -1).
std::vector<double*> numbers_along(corpus::Case& c, int axis);

// Values of lower number_cost, the simplest first: small integers, then `value` with fewer digits.
std::vector<double> simpler_values(double value);

// The value rounded to `digits` significant decimal digits.
double rounded_to_digits(double value, int digits);

}  // namespace assay::properties
