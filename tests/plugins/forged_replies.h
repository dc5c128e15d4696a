// Forged replies of a worker: a plug-in shares the process of the code that replies, finds its
// channel, and knows the format by heart.
#pragma once

#include <string>

namespace assay::tests {

// Takes the place of the code that replies, for ever, if `mode` names a forgery ("forge-...").
// Returns if it names none.
void forge(const std::string& mode);

}  // namespace assay::tests
