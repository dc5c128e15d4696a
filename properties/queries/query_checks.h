// Puts one query to all methods and tries one invariance, and tells what contradicts what.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "properties/queries/query_families.h"

namespace assay::properties {

// What a family of queries came to.
struct QueryTally {
  std::uint64_t queries = 0;
  std::uint64_t contacts = 0;
  std::uint64_t contradictions = 0;
  std::uint64_t open = 0;         // a method could not tell
  std::uint64_t invariances = 0;  // changes of a query that could be applied
  oracle::RungCounts rungs;       // the rungs of the oracle's timed answer
  QueryTally& operator+=(const QueryTally& other);
};

// Compares every method, and the invariance that `pick` chooses (or the next one that can be
// applied), with the oracle's timed answer: verdicts are equal, times are equal in every bit, and
// a known contact is found and is not late. Returns what contradicts, or nothing. The dearest part
// is the algebraic kernel.
std::optional<std::string> check_query(const GeneratedQuery& made, std::uint64_t pick,
                                       QueryTally& tally);

// The kind and all coordinates as hexadecimal doubles, one point a line.
std::string exact_text(const Query& query);
// "contact at [0x1p-1, 0x1p-1]": the answers of the oracle and of all methods, one a line.
std::string answers_text(const Query& query);

}  // namespace assay::properties
