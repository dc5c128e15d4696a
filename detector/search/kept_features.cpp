#include "detector/search/kept_features.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "detector/mesh/for_all.h"

namespace assay::detector {
namespace {

constexpr std::uint64_t work_to_compare = 2;

// Returns the part of a feature pair. The parts grow like the rounds of a search for the first
// contact (search_lanes.h): they hold 1, 3, 12, 16 and 32 of 64 shares.
std::size_t part_of(FeatureKey key) {
  constexpr std::uint64_t mixer = 0x9e3779b97f4a7c15;
  const std::uint64_t share = key * mixer >> 58;
  return share < 1 ? 0 : share < 4 ? 1 : share < 16 ? 2 : share < 32 ? 3 : 4;
}

}  // namespace

void KeptFeatures::keep(const SteppedMesh& step, double until, const FloatGrid& grid,
                        std::vector<FeatureKey> found, PacedStop& pace) {
  x_t0_ = step.vertices_t0;
  x_t1_ = step.vertices_t1;
  tolerance_ = grid.tolerance();
  found_ = std::move(found);
  begins_ = {};
  fastest_.reset();
  until_ = pace.after(work_to_compare * static_cast<std::uint64_t>(x_t0_.rows())) ? 0 : until;
}

// Returns false if it was stopped; the next question then makes the parts.
bool KeptFeatures::make_parts(PacedStop& pace) {
  constexpr std::uint64_t work_of_key = 1;
  std::array<std::size_t, parts + 1> begins{};
  keys_.resize(found_.size());
  for (const FeatureKey key : found_) ++begins[part_of(key) + 1];
  for (std::size_t i = 0; i < parts; ++i) begins[i + 1] += begins[i];
  auto next = begins;
  const auto put = [&](std::size_t i) { keys_[next[part_of(found_[i])]++] = found_[i]; };
  if (!for_each_paced(found_.size(), work_of_key, &pace, put)) return false;
  begins_ = begins;
  return true;
}

double KeptFeatures::covered_until(const SteppedMesh& other, PacedStop& pace) {
  if (until_ == 0 || other.is_at_rest() || other.size() != x_t0_.rows()) return 0;
  if (!fastest_) {
    auto& [row, axis] = fastest_.emplace();
    (x_t1_ - x_t0_).cwiseAbs().maxCoeff(&row, &axis);
  }
  const auto [row, axis] = *fastest_;
  const double from = x_t0_(row, axis),
               share = (other.vertices_t1(row, axis) - from) / (x_t1_(row, axis) - from);
  if (!(share >= 0) || !follows(other, share, pace)) return 0;
  return begins_.back() == found_.size() || make_parts(pace) ? until_ / share : 0;
}

// Returns whether the other step begins at the same places as the kept step, and ends where the
// kept step was after this share.
bool KeptFeatures::follows(const SteppedMesh& other, double share, PacedStop& pace) const {
  std::atomic<bool> is_near = true;
  const auto compare = [&](std::size_t begin, std::size_t end, std::size_t) {
    if (!is_near.load(std::memory_order_relaxed)) return;
    bool near = true;
    for (auto v = static_cast<Eigen::Index>(begin); v < static_cast<Eigen::Index>(end); ++v) {
      for (Eigen::Index k = 0; k < 3; ++k) {
        const double from = x_t0_(v, k);
        const double off = other.vertices_t1(v, k) - (from + share * (x_t1_(v, k) - from));
        near &= other.vertices_t0(v, k) == from &&
                std::abs(off) <= tolerance_[static_cast<std::size_t>(k)];
      }
    }
    if (!near) is_near = false;
  };
  constexpr std::size_t vertices_of_piece = 1024;
  return for_all_pieces(static_cast<std::size_t>(other.size()), vertices_of_piece, work_to_compare,
                        &pace, compare) &&
         is_near;
}

}  // namespace assay::detector
