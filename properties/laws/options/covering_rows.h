// Values of several factors in pairs: faults hide in corners of their product, where no test of one
// of them alone looks.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace assay::properties {

// One value of each factor, and how many values each has.
using FactorRow = std::vector<std::uint8_t>;
using FactorSizes = std::vector<std::uint8_t>;

// A value of factor f and one of factor g, with f < g.
struct TwoValues {
  std::size_t f, g;
  std::uint8_t a, b;
};
using MayMeet = std::function<bool(const TwoValues&)>;
inline bool all_may_meet(const TwoValues&) { return true; }

// Rows in which every two values stand together that may meet, and no others. A greedy choice: each
// row begins with two values that do not stand together yet, and each further factor takes the
// value that makes most of such pairs. Equal seeds give equal rows, others mostly other ones.
// REQUIRES in each factor a value that may meet all others.
std::vector<FactorRow> covering_rows(const FactorSizes& sizes, std::uint64_t seed,
                                     const MayMeet& may_meet = all_may_meet);

}  // namespace assay::properties
