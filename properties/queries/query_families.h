// The random queries as families of cases (query_case.h): strata of a campaign of queries.
#pragma once

#include <span>
#include <string_view>

#include "properties/generators/families.h"

namespace assay::properties {

// "query-small-int" and so on, a family for each generator of query_generators.h, and
// "query-extreme". make_case (families.h) makes their cases, each from its id alone.
std::span<const Family> query_families();

// Of meshes or queries; null where there is none of this name.
const Family* find_family(std::string_view name);
bool is_query_family(std::string_view name);

}  // namespace assay::properties
