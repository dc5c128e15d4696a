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
  // Says what is wrong; an empty text if the law holds; nothing if the change cannot be applied to
  // this query without rounding. `pick` chooses among variants of the change.
  std::optional<std::string> (*broken)(const Query& query, const oracle::ContactAnswer& answer,
                                       std::uint64_t pick);
};

// The changes: vertices permuted within their groups (and edges exchanged), axes permuted and
// mirrored, powers of two, time reversed, translation, the two halves of the step joined.
std::span<const Invariance> invariances();

}  // namespace assay::properties
