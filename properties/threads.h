// Work that several threads share.
#pragma once

#include <functional>

namespace assay::properties {

// Calls `work` in this thread and in up to jobs - 1 others at the same time, and returns when all
// of these calls have returned. Each call has to take work until nothing is left: if the system
// gives fewer threads, those that there are do it all. If calls throw, throws what the first of
// them threw.
void in_threads(int jobs, const std::function<void()>& work);

}  // namespace assay::properties
