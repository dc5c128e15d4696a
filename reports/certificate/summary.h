// What a run or a certificate came to, for CI systems: as Markdown and as JUnit XML.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "reports/terminal/work.h"

namespace assay::reports {

// Verdict, gates, strata, power, failures with their replay lines. Equal predicates give equal
// bytes. `begun`: when a run without a certificate was begun; empty: not known.
std::string summary_text(const nlohmann::ordered_json& predicate, const std::string& begun = "");

// For one entry of `failures`: "met 3 times", or that no trial showed it.
std::string met_text(const nlohmann::ordered_json& failure);

// Writes OUT/junit.xml and OUT/summary.md for CI systems. Fails if one cannot be written.
Expected<void> write_for_ci(const nlohmann::ordered_json& predicate,
                            const std::filesystem::path& out, const std::string& begun = "");

// What a predicate is about, because a verdict says no more than what was claimed: "claims
// free-sound, total; not judged: no-spurious (the contract has a margin), its elementary query;
// meshes of up to 2048 triangles; largest tried: (extremes_text); contract margin 0.1; isolation
// full; campaign smoke, seed 1 (the default)". For the built-in detector, whose configurations
// differ in their claims, the number of configurations stands there instead.
std::string judged_text(const nlohmann::ordered_json& predicate);

// As JUnit XML. The suites are gates (those of the predicate), strata (family, configuration),
// laws, faults, corpus, and failures (one for each signature, with its replay line). A test fails
// if its line of the certificate says so. Equal predicates give equal bytes; `times` is not looked
// at.
std::string junit_text(const nlohmann::ordered_json& predicate);

// The text escaped for XML, with characters that XML 1.0 does not take replaced.
std::string xml_escaped(const std::string& text);

}  // namespace assay::reports
