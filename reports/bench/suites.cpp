#include "reports/bench/suites.h"

#include <algorithm>

namespace assay::reports {

int BenchSettings::triangles(int full) const {
  constexpr int least = 320;
  return std::max(least, static_cast<int>(full * scale));
}

int BenchSettings::rounds(int full) const {
  constexpr int least = 2;
  return std::max(least, static_cast<int>(full * std::min(1.0, scale)));
}

}  // namespace assay::reports
