// Named queries, each with the answer, the first time, and the rung of the oracle that must decide
// it. The rung is checked because a rung that left its share to the next one would still answer
// rightly, only more slowly.
#pragma once

#include <span>

#include "properties/queries/query_methods.h"

namespace assay::properties {

struct RungCase {
  const char* name;
  Query query;
  bool contact;
  oracle::Rung rung;
  detector::TimeEnclosure first;
};

std::span<const RungCase> rung_cases();

const char* name_of(oracle::Rung rung);

}  // namespace assay::properties
