#include "properties/search/moves.h"

#include <algorithm>

namespace assay::properties {

double greatest_of(const corpus::Case& c) {
  double greatest = 0;
  for (const auto& frame : c.frames) greatest = std::max(greatest, frame.cwiseAbs().maxCoeff());
  return greatest;
}

std::span<const Move> moves() {
  static const std::vector<Move> all = [] {
    const auto of_features = feature_moves(), of_meshes = mesh_moves();
    std::vector<Move> list(of_features.begin(), of_features.end());
    list.insert(list.end(), of_meshes.begin(), of_meshes.end());
    return list;
  }();
  return all;
}

}  // namespace assay::properties
