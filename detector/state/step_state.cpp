#include "detector/state/step_state.h"

#include <cstring>

namespace assay::detector {
namespace {

constexpr std::size_t row_bytes = 3 * sizeof(double);

// Rows of x are bytes of one block where nothing lies between them.
bool is_packed(const PositionsView& x) { return x.outerStride() == 3; }

}  // namespace

void StepState::keep(const PositionsView& x) {
  positions.resize(x.rows(), 3);
  if (is_packed(x)) {
    std::memcpy(positions.data(), x.data(), row_bytes * static_cast<std::size_t>(x.rows()));
  } else {
    positions = x;
  }
}

bool StepState::holds_at(const PositionsView& x) const {
  if (positions.rows() != x.rows()) return false;
  const auto same = [&](Eigen::Index row, Eigen::Index count) {
    return std::memcmp(positions.data() + 3 * row, x.data() + x.outerStride() * row,
                       row_bytes * static_cast<std::size_t>(count)) == 0;
  };
  if (is_packed(x)) return same(0, x.rows());
  for (Eigen::Index row = 0; row < x.rows(); ++row) {
    if (!same(row, 1)) return false;
  }
  return true;
}

}  // namespace assay::detector
