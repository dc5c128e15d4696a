// Limits the memory that a process that runs cases may take. REQUIRES Linux for more than the
// limit itself.
#pragma once

#include <cstdint>

namespace assay::properties {

// Limits the bytes of address space of this process and of each process that it starts; 0: no
// limit. A lower limit that the user has set stays. False if the system refuses.
bool limit_memory(std::uint64_t bytes);

// If the machine itself runs out of memory, the system ends this process, and what it starts,
// before any other. Many processes together may take more than the machine has, although each
// keeps its limit.
void end_first_without_memory();

}  // namespace assay::properties
