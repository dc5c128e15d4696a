// The words of claims and contracts in Python, and what they mean in the plug-in interface.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "detector/plugin/assay_detector.h"
#include "properties/claims/claims.h"

namespace assay::python {

// A member of the contract by its name in Python: a choice of words, or a number.
struct ContractMember {
  const char* name;
  std::variant<std::int32_t assay_description::*, double assay_description::*,
               std::uint64_t assay_description::*>
      place;
  std::vector<std::string> words;
};

// In the order of their numbers.
template <class Enum>
std::vector<std::string> words_of() {
  std::vector<std::string> words;
  for (std::size_t number = 0; number < all_values<Enum>.size(); ++number)
    words.emplace_back(name_of(*from_number<Enum>(static_cast<std::int64_t>(number))));
  return words;
}

inline std::vector<ContractMember> contract_members() {
  using Description = assay_description;
  return {{"adjacency", &Description::adjacency, words_of<properties::Adjacency>()},
          {"coordinates", &Description::coordinates, words_of<properties::Coordinates>()},
          {"start", &Description::start, words_of<properties::StartRule>()},
          {"features", &Description::features, words_of<properties::TestedFeatures>()},
          {"reports", &Description::reports, {"pairs", "no-pairs"}},
          {"margin", &Description::margin, {}},
          {"separation", &Description::separation, {}},
          {"start_distance", &Description::start_distance, {}},
          {"least_nonzero", &Description::least_nonzero, {}},
          {"largest", &Description::largest, {}},
          {"time_tolerance", &Description::time_tolerance, {}},
          {"counts", &Description::counts, words_of<detector::CountedLevel>()},
          {"rings", &Description::rings, {}},
          {"rest_distance", &Description::rest_distance, {}},
          {"limit_gives", &Description::limit_gives, words_of<properties::LimitGives>()},
          {"progress", &Description::progress, {}},
          {"motion", &Description::motion, words_of<properties::MotionGiven>()},
          {"capacity_triangles", &Description::capacity_triangles, {}},
          {"capacity_contacts", &Description::capacity_contacts, {}},
          {"capacity_candidates", &Description::capacity_candidates, {}}};
}

inline pybind11::tuple claim_words() {
  pybind11::list words;
  for (const auto& row : properties::claim_rows) {
    if (row.bit != 0) words.append(row.name);
  }
  return words;
}

inline pybind11::dict words_of_members() {
  pybind11::dict members;
  for (const auto& member : contract_members()) {
    pybind11::list words;
    for (const auto& word : member.words) words.append(word);
    members[member.name] = pybind11::tuple(words);
  }
  return members;
}

// Takes over the numbers that `described` of assay/hosting.py has made of words.
inline void set_contract(assay_description& description, const pybind11::dict& numbers) {
  for (const auto& member : contract_members()) {
    const pybind11::object given = numbers[member.name];
    std::visit(
        [&](const auto place) {
          using Number = std::remove_reference_t<decltype(description.*place)>;
          description.*place = given.template cast<Number>();
        },
        member.place);
  }
}

}  // namespace assay::python
