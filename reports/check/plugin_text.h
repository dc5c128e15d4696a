// What a plug-in says of itself, for people.
#pragma once

#include <cstdint>
#include <string>

#include "properties/claims/claims.h"
#include "properties/worker/isolation/isolation.h"

namespace assay::reports {

// "plug-in NAME VERSION", its claims, its contract, its isolation, and the threads that it may
// use: one line each, without a newline at the end.
std::string plugin_text(const std::string& name_and_version, const properties::Claims& claims,
                        const properties::Contract& contract,
                        const properties::Isolation& isolation, std::uint64_t threads);

// "  it printed:" and the lines that it printed in a case, each behind four blanks; empty if it
// printed nothing.
std::string printed_text(const std::string& printed);

}  // namespace assay::reports
