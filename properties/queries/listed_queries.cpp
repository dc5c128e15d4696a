#include "properties/queries/listed_queries.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "properties/numbering.h"
#include "properties/words.h"

namespace assay::properties {

namespace {

using detector::MovingPoint;
using detector::Point;
using oracle::Rung;

MovingPoint rest(const Point& p) { return {p, p}; }

Query over_resting_face(const Point& from, const Point& to) {
  return {{MovingPoint{from, to}, rest({0, 0, 0}), rest({4, 0, 0}), rest({0, 4, 0})}, 1};
}

Query edges(const MovingPoint& a0, const MovingPoint& a1, const MovingPoint& b0,
            const MovingPoint& b1) {
  return {{a0, a1, b0, b1}, 2};
}

std::vector<RungCase> make() {
  const double below_third = 0x1.5555555555555p-2, above_third = 0x1.5555555555556p-2;
  const double below_cube_root = 0x1.965fea53d6e3cp-1,
               above_cube_root = 0x1.965fea53d6e3dp-1;  // of 1/2
  const double below_square_root = 0x1.6a09e667f3bccp-1, above_square_root = 0x1.6a09e667f3bcdp-1;
  return {
      {"ordered at both ends", over_resting_face({1, 1, 1}, {1, 1, 0.5}), false, Rung::axis, {}},
      {"edges beside each other",
       edges(rest({0, 0, 0}), rest({1, 0, 0}), rest({2, 0, 0}), rest({3, 0, 0})),
       false,
       Rung::axis,
       {}},
      {"passes beside the face",
       over_resting_face({3, 3, 1}, {3, 3.5, -1}),
       false,
       Rung::interval,
       {}},
      {"crosses the face",
       over_resting_face({1, 1, 1}, {1, 1, -2}),
       true,
       Rung::interval,
       {below_third, above_third}},
      {"edges cross",
       edges(rest({-1, 0, 0}), rest({1, 0.25, 0}), MovingPoint{{0.125, -1, 1}, {0.125, -1, -2}},
             MovingPoint{{0, 1, 1}, {0, 1, -2}}),
       true,
       Rung::interval,
       {below_third, above_third}},
      {"crosses far from the origin",
       {{MovingPoint{{0x1p40 + 1, 0x1p40 + 1, 0x1p40 + 1}, {0x1p40 + 1, 0x1p40 + 1, 0x1p40 - 1}},
         rest({0x1p40, 0x1p40, 0x1p40}), rest({0x1p40 + 4, 0x1p40, 0x1p40}),
         rest({0x1p40, 0x1p40 + 4, 0x1p40})},
        1},
       true,
       Rung::interval,
       {0.5, 0.5}},
      {"touches at the end",
       over_resting_face({1, 1, 1}, {1, 1, 0}),
       true,
       Rung::quadratic,
       {1, 1}},
      {"starts in contact", over_resting_face({1, 1, 0}, {1, 1, 5}), true, Rung::quadratic, {0, 0}},
      {"meets an edge of the face",
       over_resting_face({2, 0, 1}, {2, 0, -1}),
       true,
       Rung::quadratic,
       {0.5, 0.5}},
      {"meets a corner of the face",
       over_resting_face({4, 0, 3}, {4, 0, -1}),
       true,
       Rung::quadratic,
       {0.75, 0.75}},
      {"coplanar throughout",
       over_resting_face({4, 4, 0}, {0, 0, 0}),
       true,
       Rung::quadratic,
       {0.5, 0.5}},
      {"collinear throughout",
       edges(MovingPoint{{0, 0, 0}, {3, 3, 3}}, MovingPoint{{1, 1, 1}, {4, 4, 4}}, rest({2, 2, 2}),
             rest({9, 9, 9})),
       true,
       Rung::quadratic,
       {below_third, above_third}},
      {"all points coincide",
       edges(rest({1, 2, 3}), rest({1, 2, 3}), rest({1, 2, 3}), rest({1, 2, 3})),
       true,
       Rung::quadratic,
       {0, 0}},
      {"crosses at 2^400, beyond the intervals",
       {{MovingPoint{{0x1p400, 0x1p400, 0x1p400}, {0x1p400, 0x1p400, -0x1p401}}, rest({0, 0, 0}),
         rest({0x1p402, 0, 0}), rest({0, 0x1p402, 0})},
        1},
       true,
       Rung::quadratic,
       {below_third, above_third}},
      // F is a multiple of (1 + t)(2 t^2 - 1), and so is L of the corner that moves along y.
      {"meets an edge at the square root of 1/2",
       {{MovingPoint{{0, 0, 1}, {2, 0, 1}}, rest({0, 0, 0}), MovingPoint{{3, 0, 0}, {3, 0, 3}},
         MovingPoint{{0, 4, 0}, {0, 8, 0}}},
        1},
       true,
       Rung::quadratic,
       {below_square_root, above_square_root}},
      // 2^-1200 F = t^3 - 1/2, and the weights of the corners are as 1 : t : t^2.
      {"a cube root at 2^400, beyond the intervals",
       {{rest({0, 0, 0}), MovingPoint{{0, 0, -0x1p399}, {0x1p400, 0, -0x1p399}},
         MovingPoint{{-0x1p400, 0, 0}, {-0x1p400, 0x1p400, 0}},
         MovingPoint{{0, -0x1p400, 0}, {0, -0x1p400, 0x1p400}}},
        1},
       true,
       Rung::quadratic,
       {below_cube_root, above_cube_root}},
  };
}

}  // namespace

std::span<const RungCase> rung_cases() {
  static const std::vector<RungCase> cases = make();
  return cases;
}

const char* name_of(Rung rung) { return word_of({"axis", "interval", "quadratic"}, rung); }
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
