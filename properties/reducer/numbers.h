// The coordinates of a case as a list, and simpler values for one of them.
#pragma once

#include <vector>

#include "corpus/cases/case_file.h"

namespace assay::properties {

// Coordinates that are changed together: one axis of one place (vertex, end of the view primitive,
// apex), in all frames in which it has the same value. So what rests goes on resting.
using NumberGroup = std::vector<double*>;

// Of vertex 0, 1, .. by axis and value, then of the view, then of the apexes. Valid as long as `c`
// is not changed in shape.
std::vector<NumberGroup> number_groups(corpus::Case& c);

// The coordinates along one axis, or along all (axis -1).
std::vector<double*> numbers_along(corpus::Case& c, int axis);

// Values of lower number_cost, simplest first: small integers, then `value` with fewer digits.
std::vector<double> simpler_values(double value);

// To `digits` significant decimal digits.
double rounded_to_digits(double value, int digits);

}  // namespace assay::properties
