// The hard families that each file makes; hard_families.cpp puts them together.
#pragma once

#include <vector>

#include "corpus/hard/hard_families.h"

namespace assay::corpus {

std::vector<HardFamily> feature_families();  // near-coplanar, near-parallel, slivers, ...
std::vector<HardFamily> time_families();     // the ends of the step, multiple roots, lengths
std::vector<HardFamily> view_families();     // view tests near zero
std::vector<HardFamily> number_families();   // offsets, scales, denormals
std::vector<HardFamily> crowd_families();    // duplicates, coplanar sheets, many at once

}  // namespace assay::corpus
