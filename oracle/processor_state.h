// Tells whether the processor's arithmetic is fit for exact methods.
//
// A library that was built for speed can change this arithmetic for a whole thread or process; it
// is enough to load a library that sets flush-to-zero. Every bound and sign of the oracle would
// then be worthless.
#pragma once

namespace assay::oracle {

// Returns true when doubles round to nearest and denormals are neither flushed nor read as zero. It
// takes about 10 ns.
bool processor_state_is_exact();

// Ends the process with a message, in every build type, if processor_state_is_exact() is false.
void require_exact_processor_state();

}  // namespace assay::oracle
