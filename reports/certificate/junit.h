// What a run or a certificate came to as JUnit XML, for CI systems.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace assay::reports {

// The suites are gates (those of the predicate), strata (family, configuration), laws, faults,
// corpus, and failures (one for each signature, with its replay line). A test fails if its line of
// the certificate says so. Equal predicates give equal bytes; `times` is not looked at.
std::string junit_text(const nlohmann::ordered_json& predicate);

// The text escaped for XML, with characters that XML 1.0 does not take replaced.
std::string xml_escaped(const std::string& text);

}  // namespace assay::reports
