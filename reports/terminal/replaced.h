// Characters that mean something to a reader of a format, as that format writes them.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace assay::reports {

// The text with each character that is named put in its place; all others stay.
std::string replaced(std::string_view text, const std::map<char, std::string_view>& characters);

}  // namespace assay::reports
