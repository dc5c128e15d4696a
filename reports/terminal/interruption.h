// Handles ctrl-C in the middle of work that keeps what it has and can go on later.
#pragma once

#include <string>

namespace assay::reports {

// From now on SIGINT and SIGTERM end the program with `code`, once `line` is printed. REQUIRES
// that no thread has started yet; threads started later leave the two signals to the program.
// Workers are not affected: a ctrl-C in a terminal does not reach them, and they block nothing
// (properties/worker/child_process.h). A signal that is ignored stays ignored.
void end_when_interrupted(const std::string& line, int code);

}  // namespace assay::reports
