// Work that several threads share.
#pragma once

#include <functional>

namespace assay::properties {

// Calls `work` in this thread and in up to jobs - 1 others at the same time, and returns when all
// of these calls have: each of them takes what there is to do until nothing is left. Where the
// system gives fewer threads, those that there are do it all. Throws what the first call threw
// that threw.
void in_threads(int jobs, const std::function<void()>& work);

}  // namespace assay::properties
