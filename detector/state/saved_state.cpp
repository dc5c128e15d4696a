#include "detector/state/saved_state.h"

namespace assay::detector {

// FNV-1a, an index at a time.
std::uint64_t digest_of(const Topology& mesh, std::int32_t vertex_count) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&](std::int32_t value) {
    hash = (hash ^ static_cast<std::uint32_t>(value)) * 0x100000001b3u;
  };
  add(vertex_count);
  for (const auto& triangle : mesh.triangles) {
    for (const auto vertex : triangle) add(vertex);
  }
  return hash;
}

}  // namespace assay::detector
