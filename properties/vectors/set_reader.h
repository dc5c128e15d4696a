// Reads the files of a conformance set (set_files.h).
#pragma once

#include <filesystem>

#include "corpus/json_fields.h"
#include "properties/problem.h"
#include "properties/vectors/vectors.h"

namespace assay::properties {

// What set.json tells readers of a flag.
struct ReadFlag {
  VectorFlag flag;
  std::string wrong;  // what usually goes wrong
};

// With what the files say of themselves: they may be of another version than this one.
struct ReadSet {
  VectorSet set;
  std::string version, digest;
  std::vector<ReadFlag> flags;      // in the order of set.json
  std::vector<std::string> titles;  // of the groups, each as its file has it
};

// Refuses a folder without a set, files whose bytes are not those that set.json names, a digest
// that is not theirs, cases that are none, and an id that is there twice. What is no motion and no
// result may be absent from a case.
Expected<ReadSet> read_set(const std::filesystem::path& folder);

// What the readers of sets and of results share.

Expected<std::string> text_at(const corpus::JsonField& object, std::string_view key);
Expected<void> want_schema(const corpus::JsonField& object, std::string_view schema);
// Two numbers in ascending order.
Expected<detector::TimeEnclosure> read_interval(const corpus::JsonField& field);
// The first two numbers of an array: triangles of a mesh, in ascending order.
Expected<detector::TrianglePair> read_pair(const corpus::JsonField& field, std::int64_t triangles);

}  // namespace assay::properties
