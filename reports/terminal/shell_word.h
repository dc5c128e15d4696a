// Words of a command that can be pasted into a shell.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace assay::reports {

// The word itself, or the word in quotes if a shell would read it as something else.
std::string shell_word(const std::string& word);

// How to call this program: "assay" if that is what a shell finds on the PATH, else its path: from
// this folder if it lies below, "build/release/assay"; `from_anywhere` always its whole path.
// The line that a certificate or a page holds begins with "assay" on every machine.
std::string this_program(bool from_anywhere = false);

// The path of the same file that can be used from any folder; empty for none. The word of a
// detector in Python stays as it is.
std::string absolute_path(const std::filesystem::path& path);

// " --detector LIB.so", with " --threads N" if N is not 1; empty for the built-in detector.
std::string detector_words(const std::string& library, std::uint64_t threads = 1);

}  // namespace assay::reports
