// Measures times and memory. Measurements of several things are repeated in turn, so that what is
// compared was measured side by side, in one run.
#pragma once

#include <functional>
#include <optional>
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

// Keeps the compiler from optimising away a result that nothing else reads.
template <class T>
void keep(const T& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

// Runs `work` in a child process (by fork), and returns the highest rise of the child's resident
// memory above what it started with, in bytes. It counts whole pages, and those of code that is
// run for the first time, so it means little below a megabyte. REQUIRES that the work does not
// need threads that the parent has started. Freed memory that the parent still holds is given back
// first, so that the child cannot reuse it unnoticed. Nothing if the system does not tell (/proc)
// or the child failed.
//
// In the child, blocks of 128 KB and more go back to the system as soon as they are freed.
// `prepare`, if given, runs there first and does not count. What the work reads is best made by it:
// a parent that has made and freed much keeps a memory full of holes, which the child inherits and
// fills differently each time.
std::optional<double> peak_memory_of(const std::function<void()>& work,
                                     const std::function<void()>& prepare = {});

}  // namespace assay::reports
