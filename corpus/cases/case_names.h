// Words of the case schema that its reader and its writer share.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "detector/mesh/step_types.h"

namespace assay::corpus {

inline constexpr std::string_view case_schema = "assay-case/1";

// The words for detector::Answer, in its order.
inline constexpr std::array<const char*, 4> answer_names = {"free", "collision", "undecided",
                                                            "error"};

constexpr const char* name_of(detector::Answer answer) {
  return answer_names[static_cast<std::size_t>(answer)];
}

constexpr std::optional<detector::Answer> answer_named(std::string_view name) {
  for (std::size_t i = 0; i < answer_names.size(); ++i) {
    if (name == answer_names[i]) return static_cast<detector::Answer>(i);
  }
  return std::nullopt;
}

}  // namespace assay::corpus
