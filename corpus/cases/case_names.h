// Words of the case schema that its reader and its writer share.
#pragma once

#include <string_view>

namespace assay::corpus {

inline constexpr std::string_view case_schema = "assay-case/1";

}  // namespace assay::corpus
