// What a process that runs cases may take of the machine's memory. REQUIRES Linux for more than the
// limit itself.
#pragma once

#include <cstdint>

namespace assay::properties {

// Of address space, of this process and of each that it starts; 0: no limit. A limit that the user
// has set stays where it is lower. False where the system refuses.
bool limit_memory(std::uint64_t bytes);

// Where the machine itself runs out of memory the system ends this process, and what it starts,
// before any other: many processes together may take more than each of them.
void end_first_without_memory();

}  // namespace assay::properties
