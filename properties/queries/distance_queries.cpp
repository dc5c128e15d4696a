#include <array>
#include <cmath>
#include <string>

#include "properties/changes/changes.h"
#include "properties/generators/draft.h"
#include "properties/queries/query_families.h"
#include "properties/random.h"

namespace assay::properties {

namespace {
using detector::Separation;

// Returns the query of a family of contacts, asked for a distance.
QueryTask asked_of(const std::string& family, std::uint64_t seed, std::uint64_t index,
                   const Separation& distance = {}) {
  return {find_family("query-" + family)->query(seed, index).query, {}, distance};
}

void scale(QueryTask& q, int exponent) {
  for (double* c : numbers_of(q.query)) *c = std::ldexp(*c, exponent);
  for (double* d : {&q.within->first, &q.within->second}) *d = std::ldexp(*d, exponent);
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
  const int rotation = random.below(3);
  WholeVector v{{}, static_cast<double>(of[3])};
  for (int k = 0; k < 3; ++k) {
    const int c = of[static_cast<std::size_t>((k + rotation) % 3)];
    v.w[static_cast<std::size_t>(k)] = random.one_in(2) ? c : -c;
  }
  return v;
}

// Builds two features whose distance at a time in eighths is exactly the length of an integer
// vector w: they lie on the two sides of a slab across w, with a foot on each of its planes. All
// coordinates are integers while the time is 0 or 1 or the velocities are multiples of 8, and
// eighths otherwise.
class Touch {
 public:
  enum class Feet : std::uint8_t { anywhere, at_ends, of_collapsed };

  Touch(Random& random, std::uint64_t index, Feet feet)
      : random_(random), across_(whole_vector(random)), time_(random.below(9) / 8.0) {
    query_.query.first_group = index % 2 == 0 ? 1 : 2;
    query_.within = Separation{across_.length, 0};
    const Point foot = integer_point(random, 4), other = foot + across_.w;
    // Parallel edges, or a face that has become a segment along them, lie along this.
    along_ = tangent();
    if (query_.query.first_group == 1) {
      at_[0] = foot;
      place_face(other, feet);
    } else {
      place_edge(0, foot, -1, feet);
      place_edge(2, other, 1, feet);
    }
  }

  // Sets the time of the touch.
  void at(double time) { time_ = time; }

  // Makes a query in which each point has a velocity of its own.
  QueryTask moving_freely(int reach) {
    return with_motion([&](std::size_t) { return integer_point(random_, reach); });
  }
  // Makes a query in which the groups go towards each other, and each point also moves along the
  // planes of the slab.
  QueryTask approaching() {
    const double speed = random_.between(1, 3);
    return with_motion([&](std::size_t i) {
      const Point toward = speed * across_.w;
      const bool is_first = query_.query.in_first_group(static_cast<int>(i));
      return (random_.one_in(2) ? tangent() : Point{}) + (is_first ? 1 : -1) * toward;
    });
  }
  // Makes a query in which the distance does not change at the time of the touch, to first order.
  // If `rigid`, each group keeps its shape.
  QueryTask sliding(bool rigid) {
    const Point drift = integer_point(random_, 3);
    const std::array<Point, 2> own = {tangent(), tangent()};
    return with_motion([&](std::size_t i) {
      const bool is_first = query_.query.in_first_group(static_cast<int>(i));
      return drift + (rigid ? own[is_first ? 0 : 1] : tangent());
    });
  }
  QueryTask at_rest() {
    return with_motion([](std::size_t) { return Point{}; });
  }

 private:
  Point tangent() { return cross(across_.w, integer_point(random_, 2)); }
  // Returns a random offset that does not lead into the slab; side 1 is the second feature's.
  Point outward(double side) {
    const Point p = integer_point(random_, 6);
    return Point{} + (dot(p, across_.w) * side < 0 ? -1 : 1) * p;
  }

  void place_edge(std::size_t i, const Point& foot, double side, Feet feet) {
    const int kind = feet == Feet::at_ends ? 0 : feet == Feet::of_collapsed ? 2 : random_.below(4);
    if (kind == 0) {  // the foot is an end
      at_[i] = foot;
      at_[i + 1] = foot + (random_.one_in(4) ? tangent() : outward(side));
    } else if (kind == 3 || (feet == Feet::of_collapsed && random_.one_in(4))) {  // no length
      at_[i] = at_[i + 1] = foot;
    } else {
      const Point way = kind == 2 ? along_ : tangent();
      at_[i] = foot + way;
      at_[i + 1] = foot + -random_.between(0, 3) * way;
    }
  }

  void place_face(const Point& foot, Feet feet) {
    const int kind = feet == Feet::at_ends        ? random_.below(2)
                     : feet == Feet::of_collapsed ? 3 + random_.below(2)
                                                  : random_.below(4);
    const Point a = tangent(), b = tangent();
    std::array<Point, 3> from;
    if (kind == 0) from = {Point{}, outward(1), outward(1)};                      // a corner
    if (kind == 1) from = {a, Point{} + -random_.between(0, 3) * a, outward(1)};  // on an edge
    if (kind == 2) from = {a, b, Point{} + -1 * a + -random_.between(1, 3) * b};  // inside
    if (kind == 3)
      from = {along_, Point{} + -1 * along_, Point{} + random_.between(-3, 3) * along_};
    if (kind == 4) from = {};  // a point
    const auto rotation = static_cast<std::size_t>(random_.below(3));
    for (std::size_t i = 0; i < 3; ++i) at_[1 + (i + rotation) % 3] = foot + from[i];
  }

  template <class Velocity>
  QueryTask with_motion(const Velocity& velocity_of) {
    for (std::size_t i = 0; i < 4; ++i) {
      const Point velocity = velocity_of(i);
      query_.query.points[i] = {at_[i] + -time_ * velocity, at_[i] + (1 - time_) * velocity};
    }
    query_.met_at = time_;
    return query_;
  }

  Random& random_;
  const WholeVector across_;
  double time_;
  Point along_{};
  std::array<Point, 4> at_{};
  QueryTask query_;
};

QueryTask any_touch(Random& random, std::uint64_t index) {
  Touch touch(random, index, Touch::Feet::anywhere);
  const int kind = random.below(4);
  if (kind == 0) return touch.moving_freely(8);
  if (kind == 1) return touch.approaching();
  return kind == 2 ? touch.sliding(random.one_in(2)) : touch.at_rest();
}

// Makes a query of multiples of 2^-30.
QueryTask in_a_cube(std::uint64_t seed, std::uint64_t index) {
  Random random(~seed, index);
  const int halvings = random.below(8);
  return asked_of("generic", seed, index, {std::ldexp(random.unit(), -halvings), 0});
}

// Draws whole numbers, parts of these, and roots of whole numbers, rounded to doubles: the roots
// are next to distances that occur.
Separation small_distance(Random& random) {
  const double whole = random.between(0, 12);
  const int kind = random.below(4);
  if (kind == 3) return {static_cast<double>(random.between(0, 3)), random.between(0, 3) / 4.0};
  return {kind == 0 ? whole : kind == 1 ? std::sqrt(whole) : whole / 8, 0};
}

QueryTask of_small_integers(std::uint64_t seed, std::uint64_t index) {
  Random random(~seed, index);
  return asked_of("small-int", seed, index, small_distance(random));
}

// Makes edges that are parallel at one end of the step, at both, or throughout, at any distance.
// The ends of half of them come close.
QueryTask parallel_edges(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  QueryTask q;
  q.query.first_group = 2;
  const Point way = integer_point(random, 3);
  for (std::size_t i = 0; i < 4; i += 2) {
    auto& a = q.query.points[i];
    auto& b = q.query.points[i + 1];
    a = {integer_point(random, 4), integer_point(random, 4)};
    b = {a.t0 + random.between(-2, 2) * way, a.t1 + random.between(-2, 2) * way};
  }
  if (random.one_in(2)) q.query.points[3].t1 = integer_point(random, 4);
  if (random.one_in(4)) q.query.points[0].t0 = integer_point(random, 4);
  q.within = small_distance(random);
  return q;
}

QueryTask feet_at_ends(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  Touch touch(random, index, Touch::Feet::at_ends);
  return random.one_in(2) ? touch.approaching() : touch.moving_freely(6);
}

// Returns an edge or a face that is a segment or a point at one time of the step, or throughout.
QueryTask collapsing(std::uint64_t seed, std::uint64_t index) {
  Random random(~seed, index);
  QueryTask q = asked_of("small-int", seed, index, small_distance(random));
  auto& x = q.query.points;
  const auto group = static_cast<std::size_t>(q.query.first_group);
  const MovingPoint& point = x[group];
  const int where = random.below(4), first = random.one_in(2) ? static_cast<int>(group) + 1 : 3;
  for (auto i = static_cast<std::size_t>(first); i < 4; ++i) {
    if (where == 0) x[i].t0 = point.t0;
    if (where == 1) x[i].t1 = point.t1;
    if (where == 2) x[i] = point;
    // In the middle: the vector from the kept point is reversed.
    if (where == 3) x[i].t1 = point.t1 + (point.t0 + -1 * x[i].t0);
  }
  return q;
}

// Makes a query in which the cross product of two edges vanishes when the distance is d for the
// first time, or nearly then.
QueryTask no_normal(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  Touch touch(random, index, Touch::Feet::of_collapsed);
  return random.one_in(3) ? touch.moving_freely(4) : touch.approaching();
}

QueryTask tangent(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  Touch touch(random, index, Touch::Feet::anywhere);
  return touch.sliding(random.one_in(2));
}

QueryTask at_rest(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  QueryTask q = Touch(random, index, Touch::Feet::anywhere).at_rest();
  if (random.one_in(3)) {
    const int exponent = random.between(-1074, -40);
    q.within->second = std::ldexp(random.one_in(2) ? 1 : -1, exponent);
    if (q.within->second < 0) q.met_at.reset();
  }
  return q;
}

QueryTask no_distance(std::uint64_t seed, std::uint64_t index) {
  Random random(~seed, index);
  constexpr std::array from = {"constructed", "small-int", "ulp", "generic"};
  return asked_of(one_of(random, from), seed, index);
}

QueryTask huge_distance(std::uint64_t seed, std::uint64_t index) {
  Random random(~seed, index);
  QueryTask q = asked_of(random.one_in(2) ? "small-int" : "exponents", seed, index);
  const int exponent = random.between(3, 1022);
  q.within->first = std::ldexp(1 + random.unit(), exponent);
  if (random.one_in(2)) q.within->second = q.within->first;
  return q;
}

// Makes a query of the smallest numbers: in the coordinates and d, or in one of them.
QueryTask of_denormals(std::uint64_t seed, std::uint64_t index) {
  Random random(~seed, index);
  constexpr int least_exponent = -1074;
  if (random.one_in(3)) {
    const int exponent = random.one_in(2) ? least_exponent : -2;
    return asked_of("denormals", seed, index, {std::ldexp(random.between(0, 9), exponent), 0});
  }
  QueryTask q = any_touch(random, index);
  if (random.one_in(3)) {
    q.within->second = std::ldexp(random.between(0, 3), least_exponent);
    return q;
  }
  scale(q, 3);  // eighths become integers
  scale(q, least_exponent);
  return q;
}

QueryTask all_doubles(std::uint64_t seed, std::uint64_t index) {
  Random random(~seed, index);
  if (random.one_in(2)) {
    QueryTask q = any_touch(random, index);
    scale(q, random.between(-1070, 1000));
    return q;
  }
  const auto any = [&] {
    const int exponent = random.between(-1074, 1020);
    return std::ldexp(random.unit(), exponent);
  };
  const auto* family = random.one_in(2) ? "extreme" : "exponents";
  return asked_of(family, seed, index, {any(), random.one_in(3) ? any() : 0});
}

// Makes an exact touch, and changes d or one coordinate by a few units in the last place.
QueryTask beside(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  QueryTask q = any_touch(random, index);
  const int bits = random.between(49, 56);
  const double ulp = std::ldexp(random.one_in(2) ? 1 : -1, -bits);
  if (random.one_in(2)) {
    q.within->second = ulp * random.between(1, 4);
    if (q.within->second < 0) q.met_at.reset();
  } else {
    auto& p = q.query.points[static_cast<std::size_t>(random.below(4))];
    double& c = (random.one_in(2) ? p.t0 : p.t1)[static_cast<std::size_t>(random.below(3))];
    c += c == 0 ? ulp : std::nextafter(c, c + ulp) - c;
    q.met_at.reset();
  }
  return q;
}

// Makes features that are within d for a short time only.
QueryTask just_inside(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  Touch touch(random, index, Touch::Feet::anywhere);
  QueryTask q = touch.sliding(random.one_in(2));
  q.within->second = std::ldexp(1, -random.between(10, 100));
  return q;
}

QueryTask starting_at_d(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  Touch touch(random, index, Touch::Feet::anywhere);
  touch.at(0);
  QueryTask q = random.one_in(2) ? touch.moving_freely(6) : touch.sliding(random.one_in(2));
  if (random.one_in(4)) {
    q.within->second = -std::ldexp(1, -random.between(20, 1074));
    q.met_at.reset();
  }
  return q;
}

constexpr Family distance_table[] = {
    family_of<in_a_cube>("distance-generic", "uniform in a cube", 1),
    family_of<of_small_integers>("distance-small-int",
                                 "integers within 1..4, d a whole number or a root", 1),
    family_of<parallel_edges>("distance-parallel",
                              "edges parallel at an end of the step, or throughout", 5),
    family_of<feet_at_ends>("distance-ends", "at d; nearest points are corners or ends", 5),
    family_of<collapsing>("distance-collapsing", "features that become segments or points", 5),
    family_of<no_normal>("distance-no-normal", "at d while a normal vanishes or nearly does", 5),
    family_of<tangent>("distance-tangent", "reach d without coming nearer, or stay at d", 5),
    family_of<at_rest>("distance-at-rest", "at rest, at distance d or nearly d", 5),
    family_of<no_distance>("distance-zero", "d = 0: contacts", 5),
    family_of<huge_distance>("distance-huge", "d up to the sum of the two greatest doubles", 10),
    family_of<of_denormals>("distance-denormals", "5e-324 in coordinates, in d, or in both", 20),
    family_of<all_doubles>("distance-all-doubles", "exponents over all doubles", 100),
    family_of<beside>("distance-ulp", "a few units in the last place off d", 10),
    family_of<just_inside>("distance-inside", "within d for a short time", 10),
    family_of<starting_at_d>("distance-start", "at t=0 at d, or just beyond d", 5),
};

}  // namespace

std::span<const Family> distance_families() { return distance_table; }

}  // namespace assay::properties
