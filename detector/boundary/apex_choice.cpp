#include "detector/boundary/apex_choice.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace assay::detector {
namespace {

// The work to place an apex and make the tree of its fan, in box tests for each ghost.
constexpr std::uint64_t work_to_place = 20;

// Every loop gets at least so much, which is 20 us, enough for a loop of a few edges.
constexpr std::uint64_t least_share = 4'000;

constexpr std::size_t growth_of_most = 8;

// In meshes of at least so many triangles, what only grazes a ghost's plane is taken for
// untouched. On a flat sheet these are all triangles along a side, for each ghost over that side.
constexpr std::size_t large_mesh = 256;

// A sweep asks whether to go on after as much work as a few pairs take.
constexpr std::uint64_t work_between_looks = 512;

}  // namespace

ApexChoice::ApexChoice(const Surface& surface, const BoundingVolumeTree& tree,
                       const PositionsView& x, const ElementaryTest& elementary,
                       const StopFunction& stop)
    : surface_(surface),
      all_(with_apexes(x, std::vector<MovingPoint>(surface.loops.size()), false)),
      x_(x),
      view_of_all_(all_),
      stop_(stop),
      sweep_{surface, tree, {view_of_all_, view_of_all_}, elementary, true},
      ghosts_(surface.ghost_count()),
      touched_(surface.mesh.triangles.size(), 0) {
  sweep_.found = &found_;
  sweep_.by_planes = touched_.size() < large_mesh ? ByPlanes::strict : ByPlanes::grazing;
  sweep_.work_between_stops = work_between_looks;
  std::iota(ghosts_.begin(), ghosts_.end(),
            static_cast<std::int32_t>(surface.mesh.triangles.size()));
  std::size_t ghost = 0;
  for (const auto& loop : surface.loops) {
    first_ghost_.push_back(ghost);
    ghost += loop.size();
  }
}

ApexChoice::Result ApexChoice::run() {
  result_.rules.assign(surface_.loops.size(), apex_rules[0]);
  std::vector<std::size_t> order(surface_.loops.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return surface_.loops[a].size() < surface_.loops[b].size();
  });
  const std::uint64_t budget = base_work + work_per_triangle * surface_.all().triangles.size();
  std::size_t ghosts_left = ghosts_.size();
  for (const auto l : order) {
    if (stop_.stopped()) break;
    const std::uint64_t left = budget - std::min(budget, work());
    const double part =
        static_cast<double>(surface_.loops[l].size()) / static_cast<double>(ghosts_left);
    result_.rules[l] = choose(l, static_cast<std::uint64_t>(part * static_cast<double>(left)));
    ghosts_left -= surface_.loops[l].size();
  }
  return std::move(result_);
}

ApexRule ApexChoice::choose(std::size_t loop, std::uint64_t share) {
  const std::uint64_t end = work() + std::max(share, least_share);
  ApexRule chosen = apex_rules[0];
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  std::array<bool, apex_rules.size()> was_cut{};
  // A rule that touches many triangles is not followed to its end while another one may touch
  // fewer: in each round rules are given up at `most` triangles, and `most` grows from round to
  // round.
  const std::size_t all = surface_.mesh.triangles.size();
  for (std::size_t most = 1; most / growth_of_most <= all; most *= growth_of_most) {
    for (std::size_t r = 0; r < apex_rules.size() && fewest > 0; ++r) {
      if (was_cut[r]) continue;
      const std::uint64_t left = end - std::min(end, work());
      const std::size_t cut_before = result_.cut_short;
      const auto touched =
          touched_by(loop, apex_rules[r], std::min(fewest, most), left / (apex_rules.size() - r));
      was_cut[r] = result_.cut_short > cut_before;
      if (!touched) continue;
      fewest = *touched;
      chosen = apex_rules[r];
    }
    if (fewest < most || stop_.stopped()) break;
  }
  return chosen;
}

std::optional<std::size_t> ApexChoice::touched_by(std::size_t loop, const ApexRule& rule,
                                                  std::size_t fewest, std::uint64_t most_work) {
  const Loop& vertices = surface_.loops[loop];
  const std::uint64_t to_place = work_to_place * vertices.size();
  if (to_place > most_work) {
    ++result_.cut_short;
    return std::nullopt;
  }
  const std::uint64_t end = work() + most_work;
  std::uint64_t seen = work();
  placing_ += to_place;
  const Point apex = place_apex(rule, vertices, x_);
  all_.row(surface_.first_apex + static_cast<Eigen::Index>(loop)) << apex[0], apex[1], apex[2];
  const auto ghosts = std::span(ghosts_).subspan(first_ghost_[loop], vertices.size());
  const HoleTree hole(surface_.all(), ghosts, sweep_.tree.grid(), sweep_.motion);
  const auto has_to_end = [&] {
    const bool asks_for_end = stop_.after(work() - seen);
    seen = work();
    return asks_for_end || found_.size() >= fewest || work() >= end;
  };
  const bool went_through = sweep_hole(sweep_, hole, has_to_end, touched_, result_.counts);
  const std::size_t count = found_.size();
  stop_.after(work() - seen);
  for (const auto t : found_) touched_[at(t)] = 0;
  found_.clear();
  if (!went_through && count < fewest) ++result_.cut_short;
  if (!went_through || count >= fewest) return std::nullopt;
  return count;
}

}  // namespace assay::detector
