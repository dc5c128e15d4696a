#include "detector/exact/integer.h"

#include <bit>
#include <cassert>
#include <climits>
#include <cmath>

namespace assay::detector {

Binary binary_of(double value) {
  assert(std::isfinite(value));
  if (value == 0) return {};
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  constexpr int mantissa_bits = 53;
  auto mantissa = static_cast<std::int64_t>(std::ldexp(fraction, mantissa_bits));
  exponent -= mantissa_bits;
  const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
  return {mantissa >> zeros, exponent + zeros};
}

void to_common_integers(std::span<const double> values, std::span<Integer> out) {
  assert(values.size() == out.size());
  int least = INT_MAX;
  for (const double value : values) {
    if (value != 0) least = std::min(least, binary_of(value).exponent);
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Binary b = binary_of(values[i]);
    out[i] = b.mantissa;
    if (b.mantissa != 0) out[i] <<= static_cast<unsigned>(b.exponent - least);
  }
}

}  // namespace assay::detector
