// Measures times. Measurements of several things are repeated in turn, so that what is
// compared was measured side by side, in one run.
#pragma once

#include <functional>
#include <vector>

namespace assay::reports {

// Processor time of this thread in ns. The work of other programs does not count, but their effect
// on caches and clock rates remains.
double processor_ns();

// The processor time of one run of `work`, in ns.
double ns_of(const std::function<void()>& work);
// The same by the clock on the wall, for work in several threads.
double wall_ns_of(const std::function<void()>& work);

// Makes `rounds` rounds of all measurements, in forward and backward order by turns, after one
// round that is thrown away. Each measurement returns what it measured: samples[i][round] for
// measurement i.
using Measurement = std::function<double()>;
std::vector<std::vector<double>> interleave(int rounds,
                                            const std::vector<Measurement>& measurements);

}  // namespace assay::reports
