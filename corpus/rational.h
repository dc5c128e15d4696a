// Turns exact rationals into doubles.
#pragma once

#include <optional>
#include <string_view>

namespace assay::corpus {

enum class RationalState { exact, not_a_number, zero_denominator, not_a_double };

struct RationalValue {
  RationalState state;
  double value;  // when exact
};

// The double that equals numerator/denominator, two decimal integers of any sign and length.
// not_a_number: one of them has letters, blanks inside, or more than 20,000 digits (no double
// needs them). not_a_double: no double is equal, overflow included.
RationalValue exact_double(std::string_view numerator, std::string_view denominator);

}  // namespace assay::corpus
