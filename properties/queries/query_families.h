// The random queries as families of cases (query_case.h): strata of a campaign of queries.
#pragma once

#include <span>
#include <string_view>

#include "properties/generators/families.h"

namespace assay::properties {

// One family for each generator of query_generators.h, "query-small-int" and so on, and
// "query-extreme". make_case (families.h) makes their cases, each from its id alone.
std::span<const Family> query_families();

// The family of this name, be it of meshes or of queries; null if there is none.
const Family* find_family(std::string_view name);
bool is_query_family(std::string_view name);

}  // namespace assay::properties
