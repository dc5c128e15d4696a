// How many cases a test runs, and with which seed: as the environment says, otherwise as the test
// says. For example, ASSAY_SEED=7 ASSAY_CASES=100000 runs more cases, with another seed.
#pragma once

#include <cstdint>
#include <cstdlib>

namespace assay::tests {

inline std::uint64_t asked(const char* variable, std::uint64_t otherwise) {
  const char* text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

// Returns how many cases a test runs: `cases` or, under a sanitizer, a quarter of them. A case
// takes five times as long there, and a quarter of the cases is enough for the sanitizer to find
// its errors.
constexpr int usual(int cases) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return cases / 4;
#else
  return cases;
#endif
}

// Returns the distance between the places at which a test looks: `apart` or, under a sanitizer,
// four times as much.
constexpr int spaced(int apart) { return 4 * apart / usual(4); }

}  // namespace assay::tests
