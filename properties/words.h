// The words of an enum, as a table in the order of its values, which count from 0.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace assay::properties {

// The word of a value; "unknown" for a value that the enum does not have.
template <class Enum, std::size_t n>
constexpr const char* word_of(const char* const (&words)[n], Enum value) {
  const auto place = static_cast<std::size_t>(value);
  return place < n ? words[place] : "unknown";
}

// The value of a word; nothing for an unknown word.
template <class Enum, std::size_t n>
constexpr std::optional<Enum> value_of(const char* const (&words)[n], std::string_view word) {
  for (std::size_t place = 0; place < n; ++place) {
    if (words[place] == word) return static_cast<Enum>(place);
  }
  return std::nullopt;
}

}  // namespace assay::properties
