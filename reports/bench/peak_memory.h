// Measures the highest memory that a piece of work takes.
#pragma once

#include <functional>
#include <optional>

namespace assay::reports {

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
