// The words of an enum, as a table in the order of its values, which count from 0; those of a
// count; and what a misspelt word is near to.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "detector/mesh/enum_names.h"

namespace assay::properties {

using assay::name_of;  // of enums that list their values

// The word of a value; "unknown" for a value that the enum does not have.
template <class Enum, std::size_t n>
constexpr const char* word_of(const char* const (&words)[n], Enum value) {
  const auto place = static_cast<std::size_t>(value);
  return place < n ? words[place] : "unknown";
}

// "once" or "3 times".
inline std::string times_text(std::uint64_t count) {
  return count == 1 ? "once" : std::to_string(count) + " times";
}

// How many letters have to be added, dropped or exchanged to make one word the other.
inline std::size_t letters_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t exchanged = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({exchanged, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

// Whether the first may be meant by who writes the second, and is not it.
inline bool is_nearly(std::string_view meant, std::string_view written) {
  constexpr std::size_t slips = 2;
  return meant != written && letters_between(meant, written) <= slips;
}

}  // namespace assay::properties
