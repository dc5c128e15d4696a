// Exact rationals to doubles.
#pragma once

#include <optional>
#include <string_view>

namespace assay::corpus {

enum class RationalState { exact, not_a_number, zero_denominator, not_a_double };

struct RationalValue {
  RationalState state;
  double value;  // when exact
};

// numerator/denominator, two decimal integers of any sign and length, as the double that equals it.
// not_a_number: letters, blanks inside, or more than 20,000 digits (no double needs them);
// not_a_double: no double is equal, overflow included.
RationalValue exact_double(std::string_view numerator, std::string_view denominator);

}  // namespace assay::corpus
