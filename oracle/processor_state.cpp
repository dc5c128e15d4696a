#include "oracle/processor_state.h"

#include <cfenv>
#include <cstdio>
#include <cstdlib>
#include <limits>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace assay::oracle {

bool processor_state_is_exact() {
#if defined(__SSE2__)
  // MXCSR: bits 13-14 rounding, bit 15 flush-to-zero, bit 6 denormals-are-zero.
  constexpr unsigned must_be_clear = (3U << 13) | (1U << 15) | (1U << 6);
  return (_mm_getcsr() & must_be_clear) == 0;
#else
  volatile double smallest_normal = std::numeric_limits<double>::min();
  volatile double half = smallest_normal * 0.5;
  return std::fegetround() == FE_TONEAREST && half != 0 && half + half == smallest_normal;
#endif
}

void require_exact_processor_state() {
  if (processor_state_is_exact()) return;
  std::fputs(
      "assay::oracle: the processor does not round to nearest, or flushes denormals to zero;\n"
      "a library or the calling code has set this mode, and no exact answer is possible\n",
      stderr);
  std::abort();
}

}  // namespace assay::oracle
