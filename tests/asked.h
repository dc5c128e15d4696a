// How much a test does, and which case of it: by the environment, or by a number that stands in it.
// ASSAY_SEED=7 ASSAY_CASES=100000, say, run more of other cases.
#pragma once

#include <cstdint>
#include <cstdlib>

namespace assay::tests {

inline std::uint64_t asked(const char* variable, std::uint64_t otherwise) {
  const char* text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

}  // namespace assay::tests
