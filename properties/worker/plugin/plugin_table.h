// The table of functions that a plug-in returns, in any version that this host takes, and what the
// plug-in says of itself.
#pragma once

#include "detector/plugin/assay_detector.h"
#include "properties/problem.h"
#include "properties/worker/plugin/plugin_description.h"

namespace assay::properties {

// The text as one printable line, no longer than a reply may hold; empty for none.
std::string line_of(const char* text);

// What the plug-in says about the call that failed last, in one line; empty for nothing.
std::string text_of_error(const assay_detector_api& table);
// "evaluate returned 3: TEXT".
std::string text_of_code(const assay_detector_api& table, const char* function, std::int32_t code);

// The table as one of this host's version; functions that an older version does not have are NULL.
// Refuses NULL, another version of the interface, and a table with a gap; the problem does not name
// the library.
Expected<assay_detector_api> read_table(const assay_detector_api* api);

// The plug-in's description. Refuses one that makes no sense; the problem does not name the
// library.
Expected<PluginDescription> read_description(const assay_detector_api& table);

}  // namespace assay::properties
