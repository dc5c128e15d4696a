// The items of a list as one line of text, with `between` between them.
#pragma once

#include <fmt/format.h>

#include <string>

namespace assay::reports {

template <class List>
std::string joined(const List& list, const char* between) {
  std::string text;
  for (const auto& item : list) text += fmt::format("{}{}", text.empty() ? "" : between, item);
  return text;
}

}  // namespace assay::reports
