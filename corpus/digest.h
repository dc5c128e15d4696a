// SHA-256 of bytes and files (FIPS 180-4), by OpenSSL's libcrypto.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "corpus/problem.h"

namespace assay::corpus {

// Returns the digest as 64 hexadecimal digits, lower case.
std::string sha256_of(std::string_view bytes);

// Returns the digest of a file's bytes. Reads the file in pieces. The problem says why the file
// cannot be read.
Expected<std::string> sha256_of_file(const std::filesystem::path& path);

}  // namespace assay::corpus
