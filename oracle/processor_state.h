// The arithmetic of the processor, as exact methods need it.
//
// A library that was built for speed can change it for a whole thread or process (flush-to-zero
// set by loading it is enough), and every bound and sign below would then be worth nothing.
#pragma once

namespace assay::oracle {

// True when doubles round to nearest and denormals are neither flushed nor read as zero. It takes
// about 10 ns.
bool processor_state_is_exact();

// Ends the process with a message, in every build type, when the above does not hold.
void require_exact_processor_state();

}  // namespace assay::oracle
