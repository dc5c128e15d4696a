#include "properties/queries/distance_queries.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "properties/generators/draft.h"
#include "properties/queries/query_checks.h"
#include "properties/queries/query_families.h"
#include "properties/random.h"

namespace assay::properties {

namespace {

using detector::MovingPoint;
using detector::Separation;

// The query of another generator of elementary queries.
Query motion_of(std::string_view generator, std::uint64_t seed, std::uint64_t index) {
  const auto all = query_generators();
  return std::ranges::find(all, generator, &QueryGenerator::name)->make(seed, index).query;
}

void scale(DistanceQuery& q, int exponent) {
  for (MovingPoint& p : q.motion.points) {
    for (Point* x : {&p.t0, &p.t1}) {
      for (double& c : *x) c = std::ldexp(c, exponent);
    }
  }
  for (double* d : {&q.distance.first, &q.distance.second}) *d = std::ldexp(*d, exponent);
}

Point sum(const Point& a, const Point& b, double share = 1) {
  return {a[0] + share * b[0], a[1] + share * b[1], a[2] + share * b[2]};
}

// A vector of integers whose length is an integer too.
struct WholeVector {
  Point w;
  double length;
};

WholeVector whole_vector(Random& random) {
  constexpr std::array<std::array<int, 4>, 8> lengths = {{{1, 0, 0, 1},
                                                          {3, 0, 0, 3},
                                                          {3, 4, 0, 5},
                                                          {5, 12, 0, 13},
                                                          {1, 2, 2, 3},
                                                          {2, 3, 6, 7},
                                                          {1, 4, 8, 9},
                                                          {6, 6, 7, 11}}};
  const auto& of = lengths[static_cast<std::size_t>(random.below(8))];
  const int turned = random.below(3);
  WholeVector v{{}, static_cast<double>(of[3])};
  for (int k = 0; k < 3; ++k) {
    const int c = of[static_cast<std::size_t>((k + turned) % 3)];
    v.w[static_cast<std::size_t>(k)] = random.one_in(2) ? c : -c;
  }
  return v;
}

// Builds two features whose distance at a time of eighths is the length of an integer vector w,
// exactly: they lie on the two sides of a slab across w, with a foot on each of its planes. All
// coordinates are integers while the time is 0 or 1 or the velocities are multiples of 8, and
// eighths otherwise.
class Touch {
 public:
  enum class Feet : std::uint8_t { anywhere, at_ends, of_collapsed };

  Touch(Random& random, std::uint64_t index, Feet feet)
      : random_(random), across_(whole_vector(random)), time_(random.below(9) / 8.0) {
    query_.motion.first_group = index % 2 == 0 ? 1 : 2;
    query_.distance = {across_.length, 0};
    const Point foot = integer_point(random, 4), other = sum(foot, across_.w);
    // Parallel edges, or a face that has become a segment along them, lie along this.
    along_ = tangent();
    if (query_.motion.first_group == 1) {
      at_[0] = foot;
      place_face(other, feet);
    } else {
      place_edge(0, foot, -1, feet);
      place_edge(2, other, 1, feet);
    }
  }

  // The time of the touch.
  void at(double time) { time_ = time; }

  // Each point has a velocity of its own.
  DistanceQuery moving_freely(int reach) {
    return moved([&](std::size_t) { return integer_point(random_, reach); });
  }
  // The groups go towards each other, and each point along the planes of the slab besides.
  DistanceQuery approaching() {
    const double speed = random_.between(1, 3);
    return moved([&](std::size_t i) {
      const Point toward = {speed * across_.w[0], speed * across_.w[1], speed * across_.w[2]};
      const bool is_first = query_.motion.in_first_group(static_cast<int>(i));
      return sum(random_.one_in(2) ? tangent() : Point{}, toward, is_first ? 1 : -1);
    });
  }
  // The distance does not change at the time of the touch, to first order. If `rigid`, each group
  // keeps its shape.
  DistanceQuery sliding(bool rigid) {
    const Point drift = integer_point(random_, 3);
    const std::array<Point, 2> own = {tangent(), tangent()};
    return moved([&](std::size_t i) {
      const bool is_first = query_.motion.in_first_group(static_cast<int>(i));
      return sum(drift, rigid ? own[is_first ? 0 : 1] : tangent());
    });
  }
  DistanceQuery at_rest() {
    return moved([](std::size_t) { return Point{}; });
  }

 private:
  Point tangent() { return cross(across_.w, integer_point(random_, 2)); }
  // Not on the inner side of the plane at which it is; side 1 is that of the second feature.
  Point outward(double side) {
    const Point p = integer_point(random_, 6);
    return sum({}, p, dot(p, across_.w) * side < 0 ? -1 : 1);
  }

  void place_edge(std::size_t i, const Point& foot, double side, Feet feet) {
    const int kind = feet == Feet::at_ends ? 0 : feet == Feet::of_collapsed ? 2 : random_.below(4);
    if (kind == 0) {  // the foot is an end
      at_[i] = foot;
      at_[i + 1] = sum(foot, random_.one_in(4) ? tangent() : outward(side));
    } else if (kind == 3 || (feet == Feet::of_collapsed && random_.one_in(4))) {  // no length
      at_[i] = at_[i + 1] = foot;
    } else {
      const Point way = kind == 2 ? along_ : tangent();
      at_[i] = sum(foot, way);
      at_[i + 1] = sum(foot, way, -random_.between(0, 3));
    }
  }

  void place_face(const Point& foot, Feet feet) {
    const int kind = feet == Feet::at_ends        ? random_.below(2)
                     : feet == Feet::of_collapsed ? 3 + random_.below(2)
                                                  : random_.below(4);
    const Point a = tangent(), b = tangent();
    std::array<Point, 3> from;
    if (kind == 0) from = {Point{}, outward(1), outward(1)};                       // a corner
    if (kind == 1) from = {a, sum({}, a, -random_.between(0, 3)), outward(1)};     // on an edge
    if (kind == 2) from = {a, b, sum(sum({}, a, -1), b, -random_.between(1, 3))};  // inside
    if (kind == 3) from = {along_, sum({}, along_, -1), sum({}, along_, random_.between(-3, 3))};
    if (kind == 4) from = {};  // a point
    const auto turned = static_cast<std::size_t>(random_.below(3));
    for (std::size_t i = 0; i < 3; ++i) at_[1 + (i + turned) % 3] = sum(foot, from[i]);
  }

  template <class Velocity>
  DistanceQuery moved(const Velocity& velocity_of) {
    for (std::size_t i = 0; i < 4; ++i) {
      const Point velocity = velocity_of(i);
      query_.motion.points[i] = {sum(at_[i], velocity, -time_), sum(at_[i], velocity, 1 - time_)};
    }
    query_.near_at = time_;
    return query_;
  }

  Random& random_;
  const WholeVector across_;
  double time_;
  Point along_{};
  std::array<Point, 4> at_{};
  DistanceQuery query_;
};

DistanceQuery any_touch(Random& random, std::uint64_t index) {
  Touch touch(random, index, Touch::Feet::anywhere);
  switch (random.below(4)) {
    case 0:
      return touch.moving_freely(8);
    case 1:
      return touch.approaching();
    case 2:
      return touch.sliding(random.one_in(2));
    default:
      return touch.at_rest();
  }
}

// Multiples of 2^-30.
DistanceQuery in_a_cube(std::uint64_t seed, std::uint64_t index) {
  Random random(~seed, index);
  const int halvings = random.below(8);
  return {motion_of("generic", seed, index), {std::ldexp(random.unit(), -halvings), 0}, {}};
}

// Distances of whole numbers and their parts, and roots of whole numbers as doubles, which are next
// to distances that there are.
Separation small_distance(Random& random) {
  const double whole = random.between(0, 12);
  switch (random.below(4)) {
    case 0:
      return {whole, 0};
    case 1:
      return {std::sqrt(whole), 0};
    case 2:
      return {whole / 8, 0};
    default:
      return {static_cast<double>(random.between(0, 3)), random.between(0, 3) / 4.0};
  }
}

DistanceQuery of_small_integers(std::uint64_t seed, std::uint64_t index) {
  Random random(~seed, index);
  return {motion_of("small-int", seed, index), small_distance(random), {}};
}

// Parallel at one end of the step, at both, or throughout, at any distance; the ends of half of
// them come close.
DistanceQuery parallel_edges(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  DistanceQuery q;
  q.motion.first_group = 2;
  const Point way = integer_point(random, 3);
  for (std::size_t i = 0; i < 4; i += 2) {
    auto& a = q.motion.points[i];
    auto& b = q.motion.points[i + 1];
    a = {integer_point(random, 4), integer_point(random, 4)};
    b = {sum(a.t0, way, random.between(-2, 2)), sum(a.t1, way, random.between(-2, 2))};
  }
  if (random.one_in(2)) q.motion.points[3].t1 = integer_point(random, 4);
  if (random.one_in(4)) q.motion.points[0].t0 = integer_point(random, 4);
  q.distance = small_distance(random);
  return q;
}

DistanceQuery feet_at_ends(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  Touch touch(random, index, Touch::Feet::at_ends);
  return random.one_in(2) ? touch.approaching() : touch.moving_freely(6);
}

// An edge or a face that is a segment or a point at one time of the step, or throughout.
DistanceQuery collapsing(std::uint64_t seed, std::uint64_t index) {
  Random random(~seed, index);
  DistanceQuery q = {motion_of("small-int", seed, index), small_distance(random), {}};
  auto& x = q.motion.points;
  const auto group = static_cast<std::size_t>(q.motion.first_group);
  const MovingPoint& kept = x[group];
  const int where = random.below(4), first = random.one_in(2) ? static_cast<int>(group) + 1 : 3;
  for (auto i = static_cast<std::size_t>(first); i < 4; ++i) {
    if (where == 0) x[i].t0 = kept.t0;
    if (where == 1) x[i].t1 = kept.t1;
    if (where == 2) x[i] = kept;
    // In the middle: the way from the kept point turns about.
    if (where == 3) x[i].t1 = sum(kept.t1, sum(kept.t0, x[i].t0, -1));
  }
  return q;
}

// The cross product of two edges vanishes when the distance is d for the first time, or so.
DistanceQuery no_normal(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  Touch touch(random, index, Touch::Feet::of_collapsed);
  return random.one_in(3) ? touch.moving_freely(4) : touch.approaching();
}

DistanceQuery tangent(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  Touch touch(random, index, Touch::Feet::anywhere);
  return touch.sliding(random.one_in(2));
}

DistanceQuery at_rest(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  DistanceQuery q = Touch(random, index, Touch::Feet::anywhere).at_rest();
  if (random.one_in(3)) {
    const int exponent = random.between(-1074, -40);
    q.distance.second = std::ldexp(random.one_in(2) ? 1 : -1, exponent);
    if (q.distance.second < 0) q.near_at.reset();
  }
  return q;
}

DistanceQuery no_distance(std::uint64_t seed, std::uint64_t index) {
  Random random(~seed, index);
  constexpr std::array from = {"constructed", "small-int", "ulp", "generic"};
  return {motion_of(from[static_cast<std::size_t>(random.below(4))], seed, index), {}, {}};
}

DistanceQuery huge_distance(std::uint64_t seed, std::uint64_t index) {
  Random random(~seed, index);
  DistanceQuery q = {motion_of(random.one_in(2) ? "small-int" : "exponents", seed, index), {}, {}};
  const int exponent = random.between(3, 1022);
  q.distance = {std::ldexp(1 + random.unit(), exponent), 0};
  if (random.one_in(2)) q.distance.second = q.distance.first;
  return q;
}

// The smallest numbers: in the coordinates and d, or in one of them.
DistanceQuery of_denormals(std::uint64_t seed, std::uint64_t index) {
  Random random(~seed, index);
  constexpr int least_exponent = -1074;
  if (random.one_in(3)) {
    const int exponent = random.one_in(2) ? least_exponent : -2;
    return {
        motion_of("denormals", seed, index), {std::ldexp(random.between(0, 9), exponent), 0}, {}};
  }
  DistanceQuery q = any_touch(random, index);
  if (random.one_in(3)) {
    q.distance.second = std::ldexp(random.between(0, 3), least_exponent);
    return q;
  }
  scale(q, 3);  // eighths become integers
  scale(q, least_exponent);
  return q;
}

DistanceQuery all_doubles(std::uint64_t seed, std::uint64_t index) {
  Random random(~seed, index);
  if (random.one_in(2)) {
    DistanceQuery q = any_touch(random, index);
    scale(q, random.between(-1070, 1000));
    return q;
  }
  const auto any = [&] {
    const int exponent = random.between(-1074, 1020);
    return std::ldexp(random.unit(), exponent);
  };
  const Query motion =
      random.one_in(2) ? extreme_contact(seed, index) : motion_of("exponents", seed, index);
  return {motion, {any(), random.one_in(3) ? any() : 0}, {}};
}

// d, or one coordinate, a few units in the last place beside an exact touch.
DistanceQuery beside(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  DistanceQuery q = any_touch(random, index);
  const int bits = random.between(49, 56);
  const double ulp = std::ldexp(random.one_in(2) ? 1 : -1, -bits);
  if (random.one_in(2)) {
    q.distance.second = ulp * random.between(1, 4);
    if (q.distance.second < 0) q.near_at.reset();
  } else {
    auto& p = q.motion.points[static_cast<std::size_t>(random.below(4))];
    double& c = (random.one_in(2) ? p.t0 : p.t1)[static_cast<std::size_t>(random.below(3))];
    c += c == 0 ? ulp : std::nextafter(c, c + ulp) - c;
    q.near_at.reset();
  }
  return q;
}

// They are within d for a short time only.
DistanceQuery just_inside(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  Touch touch(random, index, Touch::Feet::anywhere);
  DistanceQuery q = touch.sliding(random.one_in(2));
  q.distance.second = std::ldexp(1, -random.between(10, 100));
  return q;
}

DistanceQuery starting_at_d(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  Touch touch(random, index, Touch::Feet::anywhere);
  touch.at(0);
  DistanceQuery q = random.one_in(2) ? touch.moving_freely(6) : touch.sliding(random.one_in(2));
  if (random.one_in(4)) {
    q.distance.second = -std::ldexp(1, -random.between(20, 1074));
    q.near_at.reset();
  }
  return q;
}

constexpr double generic_open = 0.02, near_degenerate_open = 0.5;

constexpr std::array all_families = {
    DistanceFamily{"distance-generic", "uniform in a cube", in_a_cube, generic_open, 1},
    DistanceFamily{"distance-small-int", "integers within 1..4, d a whole number or a root",
                   of_small_integers, near_degenerate_open, 1},
    DistanceFamily{"distance-parallel", "edges parallel at an end of the step, or throughout",
                   parallel_edges, near_degenerate_open, 5},
    DistanceFamily{"distance-ends", "at d with feet at corners and ends of edges", feet_at_ends,
                   near_degenerate_open, 5},
    DistanceFamily{"distance-collapsing", "features that become segments or points", collapsing,
                   near_degenerate_open, 5},
    DistanceFamily{"distance-no-normal", "at d just where a normal vanishes", no_normal,
                   near_degenerate_open, 5},
    DistanceFamily{"distance-tangent", "at d without crossing it, or sliding along it", tangent,
                   near_degenerate_open, 5},
    DistanceFamily{"distance-at-rest", "nothing moves, at d or next to it", at_rest,
                   near_degenerate_open, 5},
    DistanceFamily{"distance-zero", "d = 0: contacts", no_distance, near_degenerate_open, 5},
    DistanceFamily{"distance-huge", "d up to the sum of the two greatest doubles", huge_distance,
                   near_degenerate_open, 10},
    DistanceFamily{"distance-denormals", "5e-324 in coordinates, in d, or in both", of_denormals,
                   near_degenerate_open, 20},
    DistanceFamily{"distance-all-doubles", "exponents over all doubles", all_doubles,
                   near_degenerate_open, 100},
    DistanceFamily{"distance-ulp", "a few units in the last place beside d", beside,
                   near_degenerate_open, 10},
    DistanceFamily{"distance-inside", "within d for a short time", just_inside,
                   near_degenerate_open, 10},
    DistanceFamily{"distance-start", "at d, or just outside, at t=0", starting_at_d,
                   near_degenerate_open, 5},
};

}  // namespace

std::span<const DistanceFamily> distance_families() { return all_families; }

std::string exact_text(const DistanceQuery& query) {
  return fmt::format("distance {:a} + {:a}\n", query.distance.first, query.distance.second) +
         exact_text(query.motion);
}

}  // namespace assay::properties
