// Makes words from outside, such as a plug-in's name, safe to print anywhere.
#pragma once

#include <string>
#include <string_view>

namespace assay::properties {

// The text as UTF-8 without control characters: each of these becomes '?', and each byte that is
// no part of a character becomes U+FFFD. JSON, XML and a terminal then take it as it is.
std::string printable(std::string_view text);

}  // namespace assay::properties
