// The files of a conformance set: corpus/vectors/README.md says what stands in them.
#pragma once

#include <filesystem>

#include "properties/problem.h"
#include "properties/vectors/vectors.h"

namespace assay::properties {

inline constexpr std::string_view vectors_schema = "assay-vectors/1";
inline constexpr std::string_view vectors_version = "1.0.0";

struct SetFile {
  std::string name;  // within the folder
  std::string text;
};

// All files of the set: set.json, one for each group, and csv/ for the queries. The same set gives
// the same bytes everywhere: each case stands in a line of its own, and numbers are the shortest
// decimals that give back the same double.
std::vector<SetFile> files_of(const VectorSet& set);

// SHA-256 of the lines "<SHA-256 of a group's file>  <its name>", which stands in set.json.
std::string digest_of(const VectorSet& set);

// Writes the files, each whole or not at all. The folder is made if it is not there; other files in
// it stay.
Expected<void> write_set(const std::filesystem::path& folder, const VectorSet& set);

}  // namespace assay::properties
