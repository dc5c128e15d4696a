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
    std::vector<Move> list;
    for (const auto& some : {feature_moves(), step_moves(), mesh_moves(), view_moves()})
      list.insert(list.end(), some.begin(), some.end());
    return list;
  }();
  return all;
}

}  // namespace assay::properties
