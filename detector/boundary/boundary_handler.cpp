#include "detector/boundary/boundary_handler.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

#include "detector/parallel/workers.h"

namespace assay::detector {
namespace {

struct LoopBox {
  Point lo, hi;
};

LoopBox box_of(const Loop& loop, const PositionsView& x) {
  LoopBox box{point_of(x, loop[0]), point_of(x, loop[0])};
  for (const auto v : loop) {
    for (std::size_t k = 0; k < 3; ++k) {
      box.lo[k] = std::min(box.lo[k], x(v, static_cast<Eigen::Index>(k)));
      box.hi[k] = std::max(box.hi[k], x(v, static_cast<Eigen::Index>(k)));
    }
  }
  return box;
}

Point centroid(const Loop& loop, const PositionsView& x, const LoopBox& box) {
  // Each term is scaled before it is added, and the result clamped to the loop's box, so that
  // rounding cannot make it overflow.
  const double weight = 1.0 / static_cast<double>(loop.size());
  Point c = {0, 0, 0};
  for (const auto v : loop) {
    for (std::size_t k = 0; k < 3; ++k) c[k] += weight * x(v, static_cast<Eigen::Index>(k));
  }
  for (std::size_t k = 0; k < 3; ++k) c[k] = std::clamp(c[k], box.lo[k], box.hi[k]);
  return c;
}

// Splits a component into parts (halves, quarters and so on), each swept by one worker, and returns
// the top nodes of the parts. Their number depends on the mesh alone, so the counts of a sweep do
// not depend on the workers.
std::vector<std::int32_t> parts_of(const BoundingVolumeTree& tree, std::int32_t component,
                                   std::size_t triangles) {
  constexpr std::size_t least_triangles = 256, most_parts = 64;
  std::vector<std::int32_t> parts = {tree.root_of(component)}, halves;
  for (; triangles / 2 >= least_triangles && parts.size() < most_parts; triangles /= 2) {
    halves.clear();
    for (const auto node : parts) {
      halves.push_back(tree.child(node));
      halves.push_back(tree.child(node) + 1);
    }
    std::swap(parts, halves);
  }
  return parts;
}

}  // namespace

Point place_apex(const ApexRule& rule, const Loop& loop, const PositionsView& x) {
  const LoopBox box = box_of(loop, x);
  const Point c = centroid(loop, x, box);
  if (rule.height == 0) return c;
  // The normal is twice the area vector of the fan from the centroid. Its unit is the longest side
  // of the loop's box, so that products neither overflow nor vanish.
  double side = 0;
  for (std::size_t k = 0; k < 3; ++k) side = std::max(side, box.hi[k] - box.lo[k]);
  if (!(side > 0) || !std::isfinite(side)) return c;
  Point normal = {0, 0, 0};
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point p = point_of(x, loop[i]), q = point_of(x, loop[(i + 1) % loop.size()]);
    Point a, b;
    for (std::size_t k = 0; k < 3; ++k) {
      a[k] = (p[k] - c[k]) / side;
      b[k] = (q[k] - c[k]) / side;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t m = (k + 1) % 3, n = (k + 2) % 3;
      normal[k] += a[m] * b[n] - a[n] * b[m];
    }
  }
  double length2 = 0, diagonal2 = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double extent = (box.hi[k] - box.lo[k]) / side;
    length2 += normal[k] * normal[k];
    diagonal2 += extent * extent;
  }
  if (!(length2 > 0)) return c;
  const double reach = rule.height * side * std::sqrt(diagonal2) / std::sqrt(length2);
  Point apex;
  for (std::size_t k = 0; k < 3; ++k) {
    apex[k] = c[k] + reach * normal[k];
    if (!std::isfinite(apex[k])) return c;
  }
  return apex;
}

Positions with_apexes(const PositionsView& x, const std::vector<MovingPoint>& apexes, bool at_end) {
  Positions all(x.rows() + static_cast<Eigen::Index>(apexes.size()), 3);
  all.topRows(x.rows()) = x;
  for (std::size_t l = 0; l < apexes.size(); ++l) {
    const Point& p = at_end ? apexes[l].t1 : apexes[l].t0;
    all.row(x.rows() + static_cast<Eigen::Index>(l)) << p[0], p[1], p[2];
  }
  return all;
}

namespace {

// The work to place an apex and make the tree of its fan, in box tests for each ghost.
constexpr std::uint64_t work_to_place = 20;

// Every loop gets at least this much work (20 us), enough for a loop of a few edges.
constexpr std::uint64_t least_share = 4'000;

constexpr std::size_t growth_of_most = 8;

// In meshes of at least this many triangles, a triangle that only grazes a ghost's plane is taken
// for untouched. On a flat sheet, all triangles along a side graze the plane of each ghost over
// that side.
constexpr std::size_t large_mesh = 256;

// A sweep asks whether to go on each time it has done the work of a few pairs.
constexpr std::uint64_t work_between_looks = 512;

}  // namespace

ApexChoice::ApexChoice(const Surface& surface, const BoundingVolumeTree& tree,
                       const PositionsView& x, const ElementaryTest& elementary,
                       const StopFunction& stop)
    : surface_(surface),
      all_(with_apexes(x, std::vector<MovingPoint>(surface.loops.size()), false)),
      x_(x),
      view_of_all_(all_),
      stop_(stop, work_between_asks),
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
  // In each round a rule is given up once it touches `most` triangles, and `most` grows from round
  // to round. So a rule that touches many triangles is not followed to its end while another rule
  // may touch fewer.
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
  std::uint64_t work_before = work();
  placing_ += to_place;
  const Point apex = place_apex(rule, vertices, x_);
  all_.row(surface_.first_apex + static_cast<Eigen::Index>(loop)) << apex[0], apex[1], apex[2];
  const auto ghosts = std::span(ghosts_).subspan(first_ghost_[loop], vertices.size());
  const HoleTree hole(surface_.all(), ghosts, sweep_.tree.grid(), sweep_.motion);
  const auto has_to_end = [&] {
    const bool asks_for_end = stop_.after(work() - work_before);
    work_before = work();
    return asks_for_end || found_.size() >= fewest || work() >= end;
  };
  const bool went_through = sweep_hole(sweep_, hole, has_to_end, touched_, result_.counts);
  const std::size_t count = found_.size();
  stop_.after(work() - work_before);
  for (const auto t : found_) touched_[at(t)] = 0;
  found_.clear();
  if (!went_through && count < fewest) ++result_.cut_short;
  if (!went_through || count >= fewest) return std::nullopt;
  return count;
}

Surface BoundaryHandler::close_up(const TrianglesView& triangles, Eigen::Index vertex_count,
                                  PacedStop& pace) const {
  return make_surface(triangles, vertex_count, pace);
}

std::vector<ApexRule> BoundaryHandler::choose_apexes(const Surface& surface,
                                                     BoundingVolumeTree& tree,
                                                     const PositionsView& x,
                                                     const ElementaryTest& elementary,
                                                     const StopFunction& stop) const {
  if (surface.is_closed()) return {};
  PacedStop pace(stop, ApexChoice::work_between_asks);
  if (!tree.refit(surface.mesh, {x, x}, pace) || !tree.join_boxes(&pace))
    return std::vector<ApexRule>(surface.loops.size());
  return ApexChoice(surface, tree, x, elementary, stop).run().rules;
}

std::vector<MovingPoint> BoundaryHandler::place_apexes(const Surface& surface,
                                                       const std::vector<ApexRule>& rules,
                                                       const SteppedMesh& motion) const {
  std::vector<MovingPoint> apexes;
  for (std::size_t l = 0; l < surface.loops.size(); ++l) {
    apexes.push_back({place_apex(rules[l], surface.loops[l], motion.vertices_t0),
                      place_apex(rules[l], surface.loops[l], motion.vertices_t1)});
  }
  return apexes;
}

// A tree for each hole saves at most 2 % of the time of a search ghost by ghost (124 ghosts against
// 25,472 triangles: 0.49 ms and 0.50 ms), because the same elementary tests take nearly all the
// time.
bool BoundaryHandler::sweep(const GhostSweep& sweep, std::span<const std::int32_t> ghosts,
                            const StopFunction& stop, std::vector<std::uint8_t>& touched,
                            GhostCounts& counts) const {
  if (ghosts.empty()) return true;
  sweep.tree.join_boxes(nullptr);  // if the step has not done it
  const Topology& all = sweep.surface.all();
  const auto holes = make_hole_trees(all, ghosts, sweep.tree.grid(), sweep.motion);
  const auto component = all.component_of_triangle[at(ghosts[0])];
  const auto parts = parts_of(sweep.tree, component,
                              sweep.surface.mesh.components[at(component)].triangles.size());
  struct alignas(64) Lane {
    GhostCounts counts;
  };
  std::vector<Lane> lanes(sweep.workers ? sweep.workers->count() : 1);
  // The first lane goes on with the counts of earlier sweeps, by which the stop function is asked.
  lanes[0].counts = counts;
  std::atomic<bool> is_whole = true;
  const auto run = [&](const LoopPiece& piece) {
    const bool completed = std::all_of(holes.begin(), holes.end(), [&](const HoleTree& hole) {
      return sweep_hole_below(parts[piece.begin], sweep, hole, stop, touched,
                              lanes[piece.lane].counts);
    });
    if (!completed) is_whole = false;
  };
  if (sweep.workers) {
    sweep.workers->share_out(parts.size(), 1, run);
  } else {
    for (std::size_t i = 0; i < parts.size(); ++i) run({i, i + 1, 0});
  }
  counts = {};
  for (const auto& lane : lanes) counts += lane.counts;
  return is_whole;
}

}  // namespace assay::detector
