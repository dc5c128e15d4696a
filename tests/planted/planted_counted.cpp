// Compares a plain loop, the oracle and the detector on which contacts count (L19), and on what
// comes within a distance, up to their first disagreement. The program is linked with the detector
// and the oracle as they are, or with one of them in which one line is wrong (counted_*.fault, and
// the faults that forget what pierces). Its argument is the number of cases. Exit code 0, or 4 on a
// disagreement.
#include <cstdio>
#include <cstdlib>

#include "tests/properties/worlds/counted_steps.h"

int main(int argc, char** argv) {
  using namespace assay::properties::test;
  constexpr std::uint64_t seed = 20119, cases_within = 100;
  const std::uint64_t cases = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1000;
  CountedTally tally;
  for (std::uint64_t i = 0; i < cases; ++i) {
    const auto steps = make_counted_steps(seed, i);
    auto wrong = disagreement(steps, tally);
    if (!wrong && i < cases_within) wrong = disagreement_within(steps, 0x1p-30, tally);
    if (!wrong) continue;
    std::printf("disagreement after %llu steps\n%s\n", static_cast<unsigned long long>(tally.steps),
                wrong->c_str());
    return 4;
  }
  std::printf("no disagreement in %llu steps\n", static_cast<unsigned long long>(tally.steps));
  return 0;
}
