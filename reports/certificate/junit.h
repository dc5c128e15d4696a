// What a run or a certificate came to as JUnit XML, for CI systems.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace assay::reports {

// Suites: gates (those of the predicate), strata (family, configuration), laws, faults, corpus,
// failures (one a signature, with its replay line). A test fails where the line of the certificate
// says so: equal predicates give equal bytes; `times` is not looked at.
std::string junit_text(const nlohmann::ordered_json& predicate);

// With what XML 1.0 does not take replaced.
std::string xml_escaped(const std::string& text);

}  // namespace assay::reports
