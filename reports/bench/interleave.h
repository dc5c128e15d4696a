// Repeated measurements of several things, taken in turn: what is compared was measured side by
// side, in one run.
#pragma once

#include <functional>
#include <vector>

namespace assay::reports {

// Processor time of this thread in ns: what other programs do beside it is left out, though not
// what they do to caches and clock rates.
double processor_ns();

// Of one run of `work`.
double ns_of(const std::function<void()>& work);

// Rounds of all measurements, forward and backward by turns, after one that is thrown away. Each
// returns what it measured. samples[i][round] for measurement i.
using Measurement = std::function<double()>;
std::vector<std::vector<double>> interleave(int rounds,
                                            const std::vector<Measurement>& measurements);

// Keeps a result that nothing else reads from being optimised away.
template <class T>
void keep(const T& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

}  // namespace assay::reports
