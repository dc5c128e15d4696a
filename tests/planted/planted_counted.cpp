// The agreement of a plain loop, the oracle and the detector on what counts (L19), up to its first
// disagreement. Linked with the detector and the oracle as they are, and with one of them in which
// one line is wrong (counted_*.fault). Exit code 0, or 4 on a disagreement.
#include <cstdio>

#include "tests/properties/worlds/counted_steps.h"

int main() {
  using namespace assay::properties::test;
  constexpr std::uint64_t seed = 20119, cases = 1000;
  CountedTally tally;
  for (std::uint64_t i = 0; i < cases; ++i) {
    const auto wrong = disagreement(make_counted_steps(seed, i), tally);
    if (!wrong) continue;
    std::printf("disagreement after %llu steps\n%s\n", static_cast<unsigned long long>(tally.steps),
                wrong->c_str());
    return 4;
  }
  std::printf("no disagreement in %llu steps\n", static_cast<unsigned long long>(tally.steps));
  return 0;
}
