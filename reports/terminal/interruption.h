// Ctrl-C in the middle of work that keeps what it has and can go on later.
#pragma once

#include <string>

namespace assay::reports {

// From now on SIGINT and SIGTERM end the program with `code`, once `line` is printed. To be called
// before any thread starts: these then leave the two signals to the program. Workers do not take
// part: a ctrl-C in a terminal does not reach them, and they block nothing
// (properties/worker/child_process.h). A signal that is ignored stays ignored.
void end_when_interrupted(const std::string& line, int code);

}  // namespace assay::reports
