// How much memory a piece of work takes at its highest.
#pragma once

#include <functional>
#include <optional>

namespace assay::reports {

// Runs `work` in a child process and returns by how many bytes its resident memory rose above what
// it started with, at the highest. Counts whole pages, so it means little below a megabyte; freed
// memory that the parent still holds is given back first, so that the child cannot reuse it
// unnoticed. Nothing where the system does not tell (/proc) or the child failed.
std::optional<double> peak_memory_of(const std::function<void()>& work);

}  // namespace assay::reports
