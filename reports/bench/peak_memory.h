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
std::optional<double> peak_memory_of(const std::function<void()>& work);

}  // namespace assay::reports
