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

// The sine of x turns and `shift` quarters of a turn.
double shifted_sine(double x, int shift) {
  // Both subtractions are exact: the rest is x less the nearest multiple of a quarter.
  const double quarters = std::floor(4 * x + 0.5);
  const double a = 2 * pi * (x - quarters / 4);
  const int quarter = static_cast<int>(quarters - 4 * std::floor(quarters / 4)) + shift;
  switch (quarter % 4) {
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

}  // namespace

double sin_turn(double x) { return shifted_sine(x, 0); }

double cos_turn(double x) { return shifted_sine(x, 1); }

}  // namespace assay::corpus
