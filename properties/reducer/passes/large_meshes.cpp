// Cuts meshes of very many triangles (passes.h).

#include <algorithm>
#include <vector>

#include "properties/reducer/case_edits.h"
#include "properties/reducer/passes/passes.h"

namespace assay::properties {
namespace {

constexpr std::size_t most_for_the_passes = 1000;

std::size_t triangle_count(const ReductionSearch& search) {
  return static_cast<std::size_t>(search.best().triangles.rows());
}

// The middle of a triangle over all frames.
Eigen::RowVector3d middle_of(const corpus::Case& c, std::int32_t triangle) {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (const auto& frame : c.frames) {
    for (int k = 0; k < 3; ++k) sum += frame.row(c.triangles(triangle, k));
  }
  return sum / (3. * static_cast<double>(c.frames.size()));
}

// The triangles of the best case, those of the reported pair first, then the others by how near
// they are to it. Without a pair they are as near as to the first triangle.
std::vector<std::int32_t> near_first(const ReductionSearch& search) {
  const auto& c = search.best();
  auto focus = search.finding().focus;
  if (focus.empty()) focus.push_back(0);
  Eigen::RowVector3d centre = Eigen::RowVector3d::Zero();
  for (const auto t : focus) centre += middle_of(c, t) / static_cast<double>(focus.size());
  auto order = in_order(triangle_count(search));
  std::vector<double> distance;
  for (const auto t : order) distance.push_back((middle_of(c, t) - centre).squaredNorm());
  for (const auto t : focus) distance[at(t)] = -1;
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return distance[at(a)] < distance[at(b)]; });
  return order;
}

// Offers the triangles at the places [0, begin) and [end, ...) of the order.
bool offer_without(ReductionSearch& search, const std::vector<std::int32_t>& order,
                   std::size_t begin, std::size_t end) {
  std::vector<std::uint8_t> keep(order.size(), 1);
  for (std::size_t i = begin; i < end; ++i) keep[at(order[i])] = 0;
  return search.offer(keep_triangles(search.best(), keep));
}

// The triangles around the pair: four times as many each time, until they fail. Then the least
// number between the last two that still fails.
void keep_the_nearest(ReductionSearch& search) {
  constexpr std::size_t fewest = 8, times = 4;
  std::size_t passes = 0;
  for (std::size_t count = fewest; count < triangle_count(search) && !search.ended();
       count *= times) {
    const auto order = near_first(search);
    if (offer_without(search, order, count, order.size())) break;
    passes = count;
  }
  while (triangle_count(search) > passes + 1 && triangle_count(search) > most_for_the_passes &&
         !search.ended()) {
    const auto order = near_first(search);
    const std::size_t middle = passes + (order.size() - passes) / 2;
    if (!offer_without(search, order, middle, order.size())) passes = middle;
  }
}

// Leaves out a half, or a quarter, wherever it lies. Returns whether that made the mesh smaller.
bool leave_out_parts(ReductionSearch& search) {
  for (const std::size_t parts : {2, 4}) {
    for (std::size_t part = 0; part < parts && !search.ended(); ++part) {
      const auto order = near_first(search);
      const auto place = [&](std::size_t p) { return p * order.size() / parts; };
      if (offer_without(search, order, place(part), place(part + 1))) return true;
    }
  }
  return false;
}

}  // namespace

std::size_t cut_large_mesh(ReductionSearch& search) {
  if (triangle_count(search) <= most_for_the_passes) return 0;
  search.match_kind_alone(true);
  do {
    keep_the_nearest(search);
  } while (triangle_count(search) > most_for_the_passes && leave_out_parts(search));
  search.match_kind_alone(false);
  const bool is_known = !search.ended() && triangle_count(search) > most_for_the_passes;
  return is_known ? triangle_count(search) : 0;
}

}  // namespace assay::properties
