// Splits a text into words. A list of names is written as one text, because the formatter would put
// each name on its own line.
#pragma once

#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace assay::tests {

inline std::vector<std::string> words(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

}  // namespace assay::tests
