// Distinguishes one plug-in from another.
#pragma once

#include <filesystem>
#include <string>

#include "corpus/problem.h"

namespace assay::properties {

// SHA-256 of a library's bytes; for a detector in Python, of the file of its module and of the
// library that serves it (python_word.h). cannot_open, with the reason.
corpus::Expected<std::string> digest_of_plugin(const std::filesystem::path& plugin,
                                               const std::filesystem::path& worker);

}  // namespace assay::properties
