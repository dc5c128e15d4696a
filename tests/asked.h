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

// Returns how many cases a test does where `cases` are usual. Under a sanitizer a case takes five
// times as long, and a quarter of the cases shows what it looks for.
constexpr int usual(int cases) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return cases / 4;
#else
  return cases;
#endif
}

// Returns how far apart the places are at which a test looks, where so far is usual.
constexpr int spaced(int apart) { return 4 * apart / usual(4); }

}  // namespace assay::tests
