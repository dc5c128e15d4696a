// What happens when exact numbers find no memory.
#pragma once

namespace assay::oracle {

// From now on `end` is called, which must not return, where GMP would abort the process. GMP's own
// code cannot be left by an exception. To be called before the first exact number is made.
void end_without_memory(void (*end)());

}  // namespace assay::oracle
