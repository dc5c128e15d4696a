// Words of a command that can be pasted into a shell.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace assay::reports {

// The word itself, or in quotes where a shell would read it as something else.
std::string shell_word(const std::string& word);

// The same file, to be named from any folder; empty for none. A detector in Python keeps its word.
std::string absolute_path(const std::filesystem::path& path);

// " --detector LIB.so", with " --threads N" where these are not 1; empty for the built-in detector.
std::string detector_words(const std::string& library, std::uint64_t threads = 1);

}  // namespace assay::reports
