// Measures the highest memory that a piece of work takes.
#pragma once

#include <functional>
#include <optional>

namespace assay::reports {

// Runs `work` in a child process, and returns by how many bytes the child's resident memory rose
// at most above what it started with. It counts whole pages, so it means little below a megabyte.
// Freed memory that the parent still holds is given back first, so that the child cannot reuse it
// unnoticed. Nothing if the system does not tell (/proc) or the child failed.
std::optional<double> peak_memory_of(const std::function<void()>& work);

}  // namespace assay::reports
