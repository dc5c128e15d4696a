// The table of functions that a plug-in returns, of any version that this host takes, and what it
// says of itself.
#pragma once

#include "detector/plugin/assay_detector.h"
#include "properties/problem.h"
#include "properties/worker/plugin/plugin_description.h"

namespace assay::properties {

// One line of printable text, and no more of it than a reply may hold; empty for none.
std::string line_of(const char* text);

// What the plug-in has to say of the call that failed last, one line; empty for nothing.
std::string text_of_error(const assay_detector_api& table);
// "evaluate returned 3: TEXT".
std::string text_of_code(const assay_detector_api& table, const char* function, std::int32_t code);

// The table as one of this host's version: what an older version does not have is NULL.
// not_a_plugin, other_abi_version; broken_plugin: a gap. The library is not named.
Expected<assay_detector_api> read_table(const assay_detector_api* api);

// broken_plugin: a description that says nothing sensible. The library is not named.
Expected<PluginDescription> read_description(const assay_detector_api& table);

}  // namespace assay::properties
