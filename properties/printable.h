// Makes words from outside, such as a plug-in's name, safe to print anywhere.
#pragma once

#include <string>
#include <string_view>

namespace assay::properties {

// The text as UTF-8 without control characters: each of these becomes '?', and each byte that is
// no part of a character becomes U+FFFD. A terminal can then show it, and writers of JSON and XML,
// which escape quotes and brackets themselves, accept it.
std::string printable(std::string_view text);

}  // namespace assay::properties
