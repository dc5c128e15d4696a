// The exact integers of the last rung. Most values of a query fit into the inline storage, so that
// no memory is allocated. Larger ones allocate memory and stay exact.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <span>

namespace assay::detector {

inline constexpr unsigned inline_integer_bits = 512;

using Integer = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<
        inline_integer_bits, 0, boost::multiprecision::signed_magnitude,
        boost::multiprecision::unchecked, std::allocator<boost::multiprecision::limb_type>>,
    boost::multiprecision::et_off>;

// A finite double as mantissa * 2^exponent, exactly. The mantissa is odd; 0 is 0 * 2^0.
struct Binary {
  std::int64_t mantissa = 0;
  int exponent = 0;
};
Binary binary_of(double value);

// Sets out[i] to the integer values[i] * 2^-e, with one e for all: the least exponent of their
// binary forms. Scaling all coordinates of a query by one positive number changes no sign and no
// root.
void to_common_integers(std::span<const double> values, std::span<Integer> out);

}  // namespace assay::detector
