// Changes of a query under which the oracle's answer, and mostly its first time, are known.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "properties/queries/query_methods.h"

namespace assay::properties {

struct Invariance {
  const char* name;
  // What is wrong, empty when the law holds; nothing when it cannot be applied to this query
  // without rounding. `pick` chooses among variants of the change.
  std::optional<std::string> (*broken)(const Query& query, const oracle::ContactAnswer& answer,
                                       std::uint64_t pick);
};

// Vertices permuted within their groups (and edges exchanged), axes permuted and mirrored, powers
// of two, time reversed, translation, the two halves of the step joined.
std::span<const Invariance> invariances();

}  // namespace assay::properties
