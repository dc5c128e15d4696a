// A feature pair as one number: its kind, the index of its first feature (a vertex or an edge) and
// that of its second (a face or an edge).
#pragma once

#include <cstdint>

#include "detector/mesh/step_types.h"

namespace assay::detector {

using FeatureKey = std::uint64_t;

namespace feature_key {
inline constexpr int index_bits = 31;
inline constexpr FeatureKey index_mask = (FeatureKey{1} << index_bits) - 1;
}  // namespace feature_key

constexpr FeatureKey key_of(FeatureKind kind, std::int32_t first, std::int32_t second) {
  return (static_cast<FeatureKey>(kind) << (2 * feature_key::index_bits)) |
         (static_cast<FeatureKey>(first) << feature_key::index_bits) |
         static_cast<FeatureKey>(second);
}
constexpr FeatureKind kind_of(FeatureKey key) {
  return static_cast<FeatureKind>(key >> (2 * feature_key::index_bits));
}
constexpr std::int32_t first_of(FeatureKey key) {
  return static_cast<std::int32_t>((key >> feature_key::index_bits) & feature_key::index_mask);
}
constexpr std::int32_t second_of(FeatureKey key) {
  return static_cast<std::int32_t>(key & feature_key::index_mask);
}

}  // namespace assay::detector
