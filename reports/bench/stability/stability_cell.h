// A cell of the heat map of suite `stability`: one family at one strength in one arithmetic.
#pragma once

#include <string>
#include <vector>

namespace assay::reports {

struct StabilityCell {
  std::string family, arithmetic;
  int strength = 0;
  int exponent = 0;  // the family's knob stands at 2^exponent, or at 0 if it touches
  bool touches = false;
  std::string knob;  // what the knob is, with its unit
  int cases = 0;
  int right = 0;  // answer and pairs of the oracle, no wrong V+ or V- from a given primitive
  int exactly_right = 0;  // right, with the times and signs of exact arithmetic
  int missed = 0, late = 0, early = 0, spurious = 0;
  int wrong_signs = 0;  // steps with a wrong V+ or V-
  // The errors of first times that are wrong: the time minus t*, as a share of the step (above 0:
  // late), and in ulps.
  std::vector<double> time_errors, time_errors_ulps;

  double share_right() const { return cases ? static_cast<double>(right) / cases : 1; }
};

}  // namespace assay::reports
