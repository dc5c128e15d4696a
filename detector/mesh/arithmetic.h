// In which numbers a step is computed. detector/README.md says what each arithmetic promises.
#pragma once

#include <cstdint>

#include "detector/mesh/enum_names.h"

namespace assay::detector {

enum class Arithmetic : std::uint8_t {
  exact,             // doubles with proved bounds, integers where these cannot tell: never wrong
  bounded,           // doubles with proved bounds alone: what they cannot tell counts as contact
  double_precision,  // doubles with bounds 0: promises nothing, made to be measured
  single_precision,  // floats with bounds 0, coordinates rounded to float first: promises nothing
};
constexpr auto names_of(Arithmetic) {
  using enum Arithmetic;
  return std::to_array<Named<Arithmetic>>({{exact, "exact"},
                                           {bounded, "bounded"},
                                           {double_precision, "double"},
                                           {single_precision, "float"}});
}

}  // namespace assay::detector
