#include "reports/terminal/replaced.h"

namespace assay::reports {

std::string replaced(std::string_view text, const std::map<char, std::string_view>& characters) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    const auto found = characters.find(c);
    if (found == characters.end()) {
      out += c;
    } else {
      out += found->second;
    }
  }
  return out;
}

}  // namespace assay::reports
