// Ctrl-C in the middle of work that keeps what it has and can go on later.
#pragma once

#include <string>

namespace assay::reports {

// From now on SIGINT and SIGTERM end the program with `code`, once `line` is printed. To be called
// before any thread or worker starts: these then leave the two signals to the program, so a ctrl-C,
// which a terminal sends to all of them, is no crash of the detector. A signal that is ignored
// stays ignored.
void end_when_interrupted(const std::string& line, int code);

}  // namespace assay::reports
