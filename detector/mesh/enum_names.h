// Lists the values of an enum with their names. The list is written once, beside the enum:
//
//   enum class Start : std::uint8_t { verified, clean, unknown };
//   constexpr auto names_of(Start) {
//     return std::to_array<Named<Start>>(
//         {{Start::verified, "verified"}, {Start::clean, "clean"}, {Start::unknown, "unknown"}});
//   }
//
// Loops over the values, checks of numbers and texts for users are all made from this list. The
// list has the order in which users read the names.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace assay {

template <class Enum>
struct Named {
  Enum value;
  const char* name;
};

// True for each enum that has such a list (names_of), in any namespace.
template <class Enum>
concept Listed = requires {
  names_of(Enum{}).front().name;
};

template <Listed Enum>
inline constexpr auto all_values = [] {
  constexpr auto list = names_of(Enum{});
  std::array<Enum, list.size()> values{};
  std::transform(list.begin(), list.end(), values.begin(),
                 [](const auto& row) { return row.value; });
  return values;
}();

// Returns the value with this number; nullopt if no value has it.
template <Listed Enum>
constexpr std::optional<Enum> from_number(std::int64_t number) {
  for (const Enum value : all_values<Enum>) {
    if (static_cast<std::int64_t>(value) == number) return value;
  }
  return std::nullopt;
}

// Returns the name of a value; "unknown" for a number that is no value.
template <Listed Enum>
constexpr const char* name_of(Enum value) {
  for (const auto& row : names_of(value)) {
    if (row.value == value) return row.name;
  }
  return "unknown";
}

// Returns the value with this name; nullopt if no value has it.
template <Listed Enum>
constexpr std::optional<Enum> from_name(std::string_view name) {
  for (const auto& row : names_of(Enum{})) {
    if (row.name == name) return row.value;
  }
  return std::nullopt;
}

// Returns all names, as a user reads them: "verified, clean, unknown".
template <Listed Enum>
std::string all_names() {
  std::string text;
  for (const auto& row : names_of(Enum{}))
    text += (text.empty() ? "" : ", ") + std::string(row.name);
  return text;
}

// For an enum of assay::detector, argument-dependent lookup of name_of searches only this
// namespace, not the namespace assay around it.
namespace detector {
using assay::name_of;
}

}  // namespace assay
