// A conformance set (corpus/vectors/README.md), as far as judging needs it: what is right for each
// case, and why a case is hard. The points stay in the files.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "corpus/json_fields.h"

namespace assay::reports {

enum class VectorResult : std::uint8_t { free, collision, acceptable };

using TimeInterval = std::array<double, 2>;
using VectorPair = std::array<std::int32_t, 2>;

// A query, or a step of a mesh.
struct VectorStep {
  VectorResult result = VectorResult::free;
  std::optional<TimeInterval> first_time;
  std::optional<std::vector<VectorPair>> pairs;
};

struct VectorCase {
  std::string id, about, group;
  std::vector<std::string> flags;
  bool is_mesh = false, is_limit = false;
  std::int32_t triangles = 0;  // of a mesh
  std::vector<VectorStep> steps;
};

struct VectorFlag {
  std::string name, about, wrong;
};

struct VectorSet {
  std::string version, profile, digest;
  std::vector<VectorFlag> flags;    // in the order of set.json
  std::vector<std::string> groups;  // likewise
  std::vector<VectorCase> cases;
};

// Reads set.json and the groups that it names. Refuses a group whose bytes are not those of
// set.json, and what lacks a field that is needed here.
corpus::Expected<VectorSet> read_vector_set(const std::filesystem::path& folder);

// What the readers of sets and of results share.

// Two numbers in ascending order.
corpus::Expected<TimeInterval> read_interval(const corpus::JsonField& field);
// Two triangles of a mesh in ascending order, and whatever stands behind them.
corpus::Expected<VectorPair> read_pair(const corpus::JsonField& field, std::int32_t triangles);

}  // namespace assay::reports
