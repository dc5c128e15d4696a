// Queries in the exact rationals that existing runners read: corpus/README.md, Query files.
#pragma once

#include "properties/vectors/vectors.h"

namespace assay::properties {

// The path within corpus/vectors/csv: the folder says which features a file holds.
std::string csv_name(const VectorGroup& group);

// Eight rows a query, each with the label and, of a distance, with the separation. What is
// acceptable has the label 1, its exact answer. REQUIRES a group of queries.
std::string csv_text(const VectorGroup& group);

}  // namespace assay::properties
