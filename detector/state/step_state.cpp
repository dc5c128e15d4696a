#include "detector/state/step_state.h"

#include <atomic>
#include <cstring>

#include "detector/parallel/for_all.h"

namespace assay::detector {
namespace {

constexpr std::size_t row_bytes = 3 * sizeof(double);

// Whether the rows of x follow each other without gaps, so that they can be handled as one block.
bool is_packed(const PositionsView& x) { return x.outerStride() == 3; }

}  // namespace

void StepState::keep(const PositionsView& x, const PacedStop& pace) {
  positions.resize(x.rows(), 3);
  if (!is_packed(x)) {
    positions = x;
    return;
  }
  PacedStop unasked = pace.unasked();
  for_all_pieces(static_cast<std::size_t>(x.rows()), rows_of_piece, 0, &unasked,
                 [&](std::size_t begin, std::size_t end, std::size_t) {
                   std::memcpy(positions.data() + 3 * begin, x.data() + 3 * begin,
                               row_bytes * (end - begin));
                 });
}

bool StepState::holds_at(const PositionsView& x, const PacedStop& pace) const {
  if (positions.rows() != x.rows()) return false;
  const auto same = [&](Eigen::Index row, Eigen::Index count) {
    return std::memcmp(positions.data() + 3 * row, x.data() + x.outerStride() * row,
                       row_bytes * static_cast<std::size_t>(count)) == 0;
  };
  if (is_packed(x)) {
    std::atomic<bool> all_same = true;
    PacedStop unasked = pace.unasked();
    for_all_pieces(static_cast<std::size_t>(x.rows()), rows_of_piece, 0, &unasked,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                     if (all_same && !same(static_cast<Eigen::Index>(begin),
                                           static_cast<Eigen::Index>(end - begin))) {
                       all_same = false;
                     }
                   });
    return all_same;
  }
  for (Eigen::Index row = 0; row < x.rows(); ++row) {
    if (!same(row, 1)) return false;
  }
  return true;
}

}  // namespace assay::detector
