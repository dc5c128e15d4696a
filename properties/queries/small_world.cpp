#include "properties/queries/small_world.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "properties/numbering.h"

namespace assay::properties {

namespace {

using Paths = SmallWorld::Paths;

// The least arrangement of the points of a query: they are sorted within each group, and the
// lesser edge stands first.
Paths sorted(Paths p, int first_group) {
  std::sort(p.begin() + first_group, p.end());
  if (first_group == 2) {
    if (p[1] < p[0]) std::swap(p[0], p[1]);
    if (std::pair(p[2], p[3]) < std::pair(p[0], p[1])) {
      std::swap(p[0], p[2]);
      std::swap(p[1], p[3]);
    }
  }
  return p;
}

}  // namespace

SmallWorld::SmallWorld(int side, int dimensions, WorldMotion motion)
    : side_(side), dimensions_(dimensions), motion_(motion), grid_points_(power(side, dimensions)) {
  assert(side >= 2 && dimensions >= 1 && dimensions <= 3);
  for_each_symmetry(dimensions,
                    [&](const ImageOfGrid& image_of) { symmetries_.push_back(image_of(side)); });
}

std::uint64_t SmallWorld::places() const {
  const auto n = static_cast<std::uint64_t>(grid_points_);
  // If every point moves, there are two kinds of queries with four paths each. Otherwise there are
  // three kinds of movers (vertex, corner, end of an edge), four points, and one end of the path.
  return motion_ == WorldMotion::every_point_moves ? 2 * n * n * n * n * n * n * n * n
                                                   : 3 * n * n * n * n * n;
}

std::optional<SmallWorld::Arranged> SmallWorld::arranged_at(std::uint64_t place) const {
  const auto n = static_cast<std::uint64_t>(grid_points_);
  auto digit = [&] {
    const auto d = static_cast<int>(place % n);
    place /= n;
    return d;
  };
  Arranged query{};
  if (motion_ == WorldMotion::every_point_moves) {
    for (Path& path : query.paths) path = {digit(), digit()};
    query.first_group = 1 + static_cast<int>(place);
    return query;
  }
  for (Path& path : query.paths) path[0] = path[1] = digit();
  const int end = digit();
  const auto mover = static_cast<int>(place);  // 0 vertex, 1 corner of the face, 2 end of an edge
  query.first_group = mover == 2 ? 2 : 1;
  Path& moved = query.paths[mover == 1 ? 1 : 0];
  query.mover_first = end != moved[0];
  if (mover == 1 && !query.mover_first) return {};  // at rest: it is counted where the vertex moves
  moved[1] = end;
  return query;
}

// If one point moves, each arrangement of the other points is one place, so only these need to be
// in order.
bool SmallWorld::is_least_of_its_class(const Arranged& query) const {
  const Paths& p = query.paths;
  const bool corner_moves = p[1][0] != p[1][1];
  const bool in_order =
      query.mover_first
          ? (query.first_group == 1 ? corner_moves || p[1] <= p[2] : true) && p[2] <= p[3]
          : p == sorted(p, query.first_group);
  if (!in_order) return false;
  const Paths own = sorted(p, query.first_group);
  return std::all_of(symmetries_.begin(), symmetries_.end(), [&](const std::vector<int>& image) {
    Paths other;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t e = 0; e < 2; ++e) other[i][e] = image[static_cast<std::size_t>(p[i][e])];
    }
    return own <= sorted(other, query.first_group);
  });
}

Query SmallWorld::query_of(const Arranged& query) const {
  const int least = side_ == 3 ? -1 : 0;
  Query q{};
  q.first_group = query.first_group;
  for (std::size_t i = 0; i < 4; ++i) {
    for (int k = 0; k < dimensions_; ++k) {
      const int unit = power(side_, k);
      const auto axis = static_cast<std::size_t>(k);
      q.points[i].t0[axis] = query.paths[i][0] / unit % side_ + least;
      q.points[i].t1[axis] = query.paths[i][1] / unit % side_ + least;
    }
  }
  return q;
}

std::optional<Query> SmallWorld::at(std::uint64_t place) const {
  if (place >= places()) return {};
  const auto query = arranged_at(place);
  if (!query || !is_least_of_its_class(*query)) return {};
  return query_of(*query);
}

}  // namespace assay::properties
