// What happens when the oracle's exact numbers, which are GMP's, find no memory.
#pragma once

namespace assay::oracle {

// Registers what ends the program: from now on `end` is called when GMP finds no memory, in place
// of GMP's abort. `end` must not return, and it must not throw because an exception cannot leave
// GMP's code. REQUIRES that no exact number has been made yet.
void end_without_memory(void (*end)());

}  // namespace assay::oracle
