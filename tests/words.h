// A list of names written as one text, for a formatter puts each name of a list on a line.
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
