// Numbers in text, independent of the locale.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace assay::corpus {

// The double nearest to a decimal number, ties to even, denormals included: infinity for a number
// beyond the largest double, zero for one below half the least denormal. A leading + is allowed;
// "nan" and "inf" are read as such. Nothing when `word` is not a number from its first to its last
// character.
std::optional<double> parse_double(std::string_view word);

// The decimal integer that the whole of `word` is, if it fits into 64 bits; else nothing. A
// leading + is allowed.
std::optional<std::int64_t> parse_integer(std::string_view word);

}  // namespace assay::corpus
