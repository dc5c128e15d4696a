// One line on stderr for a user. Never throws, whatever stderr is.
#pragma once

#include <string>

#include "reports/terminal/exit_code.h"

namespace assay::reports {

// "assay: MESSAGE", control characters replaced, cut at 1,000 bytes; returns exit_usage.
int refuse(const std::string& message) noexcept;

// Whether all that was printed reached stdout; says so on stderr when not.
bool output_was_written() noexcept;

}  // namespace assay::reports
