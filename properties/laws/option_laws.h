// Options, states and meshes in pairs: faults hide in corners of their product, where no test of
// one of them alone looks.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace assay::properties {

// One value of each factor.
inline constexpr std::size_t option_factors = 9;
using OptionRow = std::array<std::uint8_t, option_factors>;
using FactorSizes = std::array<std::uint8_t, option_factors>;

// Rows in which every two values of every two factors stand together. A greedy choice: each row
// begins with two values that do not stand together yet, and each further factor takes the value
// that makes most of such pairs. Equal seeds give equal rows, others mostly other ones.
std::vector<OptionRow> covering_rows(const FactorSizes& sizes, std::uint64_t seed);

}  // namespace assay::properties
