#include "corpus/scenes/trigonometry.h"

#include <cmath>

namespace assay::corpus {
namespace {

// sin(a) for |a| <= pi/4: the first term left out, a^17/17!, is below 5e-17.
double sin_small(double a) {
  const double s = a * a;
  double sum = 0;
  for (int k = 15; k >= 3; k -= 2) sum = (sum + 1.0) * (-s / (k * (k - 1)));
  return a + a * sum;
}

// cos(a) for |a| <= pi/4: the first term left out, a^18/18!, is below 3e-18.
double cos_small(double a) {
  const double s = a * a;
  double sum = 0;
  for (int k = 16; k >= 2; k -= 2) sum = (sum + 1.0) * (-s / (k * (k - 1)));
  return 1.0 + sum;
}

}  // namespace

double sin_turn(double x) {
  // Both subtractions are exact: r is x less a near multiple of a quarter.
  const double quarters = std::floor(4 * x + 0.5);
  const double a = 2 * pi * (x - quarters / 4);
  const auto quarter = static_cast<int>(quarters - 4 * std::floor(quarters / 4));
  switch (quarter) {
    case 0:
      return sin_small(a);
    case 1:
      return cos_small(a);
    case 2:
      return -sin_small(a);
    default:
      return -cos_small(a);
  }
}

double cos_turn(double x) { return sin_turn(x + 0.25); }

}  // namespace assay::corpus
