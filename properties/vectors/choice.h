// Which cases stand in the conformance set.
#pragma once

#include <filesystem>
#include <functional>

#include "properties/problem.h"
#include "properties/vectors/vectors.h"

namespace assay::properties {

enum class VectorProfile : std::uint8_t { core, full };
constexpr auto names_of(VectorProfile) {
  return std::to_array<Named<VectorProfile>>(
      {{VectorProfile::core, "core"}, {VectorProfile::full, "full"}});
}

struct ChoiceAsked {
  VectorProfile profile = VectorProfile::core;
  std::filesystem::path curated;  // folder of the curated cases
  std::filesystem::path found;    // the file of what was found (corpus/vectors/found.json)
  int jobs = 1;                   // threads; the set does not depend on it
  std::function<void(std::string_view group)> progress{};
};

// The same set on every machine. It takes what was found, each smallest mesh that a public detector
// has failed on, and curated cases whole; of hard families and random queries it takes few of a
// kind: of one group, result, flags and size. Refuses files that are none.
Expected<VectorSet> choose_vectors(const ChoiceAsked& asked);

}  // namespace assay::properties
