// Writes characters that have a meaning in a format in the way in which that format wants them.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace assay::reports {

// The text in which each character that is a key of `characters` is replaced by its value.
std::string replaced(std::string_view text, const std::map<char, std::string_view>& characters);

}  // namespace assay::reports
