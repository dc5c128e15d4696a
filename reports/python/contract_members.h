// Translates the words for claims and contracts that Python uses into the plug-in interface.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>

#include "detector/plugin/assay_detector.h"
#include "properties/claims/claims.h"

namespace assay::python {

inline pybind11::tuple claim_words() {
  pybind11::list words;
  for (const auto& row : properties::all_rows<properties::Claim>) {
    if (row.bit != 0) words.append(row.name);
  }
  return words;
}

// Returns the words of each member of a contract, in the order of the numbers that stand for them.
// A member that is a number has no words.
inline pybind11::dict words_of_members() {
  pybind11::dict members;
  assay_description description = {};
  properties::Contract contract;
  visit_members(description, contract, [&]<class T>(const char* name, const auto&, const T&) {
    pybind11::list words;
    if constexpr (Listed<T>) {
      for (std::int64_t number = 0; const auto value = from_number<T>(number); ++number)
        words.append(name_of(*value));
    }
    members[name] = pybind11::tuple(words);
  });
  return members;
}

// Sets the members of the contract in the description. `numbers` comes from described() of
// assay/hosting.py, which turns words into numbers.
inline void set_contract(assay_description& description, const pybind11::dict& numbers) {
  properties::Contract contract;
  visit_members(description, contract, [&]<class T>(const char* name, T& member, const auto&) {
    using Number = std::conditional_t<std::is_integral_v<T>, pybind11::int_, pybind11::float_>;
    member = Number(numbers[name]).template cast<T>();
  });
}

}  // namespace assay::python
