#include "properties/queries/query_families.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "properties/changes/changes.h"
#include "properties/generators/parts.h"
#include "properties/random.h"

namespace assay::properties {

const Family* find_family(std::string_view name) {
  for (const auto list :
       {families(), question_families(), size_families(), counted_families(), query_families()}) {
    const auto place = std::ranges::find(list, name, &Family::name);
    if (place != list.end()) return &*place;
  }
  return nullptr;
}

bool is_query_family(std::string_view name) {
  const auto* family = find_family(name);
  return family && family->query;
}

bool is_dear_query_family(std::string_view name) {
  constexpr int dear = 100;
  return is_query_family(name) && find_family(name)->one_in >= dear;
}

namespace {

Query empty_query(std::uint64_t index) {
  Query q{};
  q.first_group = index % 2 == 0 ? 1 : 2;
  return q;
}

double& any_coordinate(Random& random, Query& q) {
  MovingPoint& p = q.points[static_cast<std::size_t>(random.below(4))];
  Point& end = random.below(2) == 0 ? p.t0 : p.t1;
  return end[static_cast<std::size_t>(random.below(3))];
}

// Makes planar and collinear worlds in any direction: it replaces p by its projection into one.
Point flattened(const Point& p, int dimensions, const std::array<Point, 2>& directions) {
  if (dimensions == 3) return p;
  Point shadow = {0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    shadow[k] = p[0] * directions[0][k] + (dimensions == 2 ? p[1] * directions[1][k] : 0);
  }
  return shadow;
}

// Makes a query of small integers, within a reach of 1 to 4. A fifth of the queries is planar and a
// tenth lies on one line. The motions range from none to every point moving on its own.
Query small_integers(Random& random, std::uint64_t index) {
  Query q = empty_query(index);
  const int reach = random.between(1, 4);
  const int shape = random.below(10);
  const int dimensions = shape == 0 ? 1 : shape <= 2 ? 2 : 3;
  const std::array<Point, 2> directions = {integer_point(random, 1), integer_point(random, 1)};
  auto point = [&] { return flattened(integer_point(random, reach), dimensions, directions); };
  for (MovingPoint& p : q.points) p.t0 = p.t1 = point();
  const int motion = random.below(8);
  if (motion == 1) {
    q.points[static_cast<std::size_t>(random.below(4))].t1 = point();
  } else if (motion == 2) {
    const Point by = point();
    for (int i = 0; i < q.first_group; ++i) {
      MovingPoint& p = q.points[static_cast<std::size_t>(i)];
      for (std::size_t k = 0; k < 3; ++k) p.t1[k] += by[k];
    }
  } else if (motion > 2) {
    for (MovingPoint& p : q.points) p.t1 = point();
  }
  if (random.below(12) == 0) {
    q.points[static_cast<std::size_t>(random.below(4))] =
        q.points[static_cast<std::size_t>(random.below(4))];
  }
  return q;
}

QueryTask small_int(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  return {small_integers(random, index)};
}

// Constructs a contact at a dyadic time: the two hulls are drawn through one point there, and the
// velocities are free. All numbers are small dyadics, so the contact is exact.
QueryTask constructed(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  Query q = empty_query(index);
  constexpr int integer_reach = 4, fastest = 8;
  const double time = random.between(0, 8) / 8.0;
  auto weights = [&](std::size_t count) {
    std::array<double, 3> w = {1, 0, 0};
    for (std::size_t i = 1; i < count; ++i) {
      const double share = random.between(0, 4) / 4.0;
      w[i] = w[i - 1] * share;
      w[i - 1] -= w[i];
    }
    return w;
  };
  const auto first_group = static_cast<std::size_t>(q.first_group);
  std::array<Point, 4> at;
  for (Point& p : at) p = integer_point(random, integer_reach);
  // Moves the first group as a whole until its weighted point is that of the second group.
  const auto w1 = weights(first_group), w2 = weights(4 - first_group);
  for (std::size_t k = 0; k < 3; ++k) {
    double gap = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      gap += i < first_group ? -w1[i] * at[i][k] : w2[i - first_group] * at[i][k];
    }
    for (std::size_t i = 0; i < first_group; ++i) at[i][k] += gap;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const Point velocity = integer_point(random, fastest);
    for (std::size_t k = 0; k < 3; ++k) {
      q.points[i].t0[k] = at[i][k] - time * velocity[k];
      q.points[i].t1[k] = at[i][k] + (1 - time) * velocity[k];
    }
  }
  return {q, time};
}

// Changes one to three coordinates of an exact contact or a small-integer query to a neighbouring
// double. A coordinate 0 is changed by one unit of the last place of 1.
QueryTask ulp_neighbours(std::uint64_t seed, std::uint64_t index) {
  Random random(~seed, index);
  Query q = random.below(2) == 0 ? constructed(seed, index).query : small_integers(random, index);
  for (int changes = random.between(1, 3); changes > 0; --changes) {
    double& c = any_coordinate(random, q);
    c = units_beyond(c, 1, random.below(2) == 0 ? 1 : -1);
  }
  return {q};
}

QueryTask far_from_origin(std::uint64_t seed, std::uint64_t index) {
  Random random(~seed, index);
  QueryTask task =
      random.below(2) == 0 ? constructed(seed, index) : QueryTask{small_integers(random, index)};
  // Up to 2^50 integers stay exact. The eighths and smaller parts of a constructed contact may be
  // rounded.
  std::array<double, 3> offset;
  for (double& c : offset) {
    const int exponent = random.between(30, 50);
    const double far = std::ldexp(random.below(2) == 0 ? 1 : -1, exponent);
    c = far + random.below(1000);
  }
  const auto numbers = numbers_of(task.query);
  for (std::size_t i = 0; i < numbers.size(); ++i) *numbers[i] += offset[i % 3];
  task.met_at.reset();
  return task;
}

QueryTask mixed_scales(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  Query q = small_integers(random, index);
  const bool by_point = random.below(2) == 0;
  constexpr int exponent_reach = 30;
  for (MovingPoint& p : q.points) {
    const int of_point = random.between(-exponent_reach, exponent_reach);
    for (Point* end : {&p.t0, &p.t1}) {
      for (double& c : *end) {
        c = std::ldexp(c, by_point ? of_point : random.between(-exponent_reach, exponent_reach));
      }
    }
  }
  return {q};
}

QueryTask dyadics(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  Query q = empty_query(index);
  for (double* c : numbers_of(q)) {
    const int bits = random.below(11);
    *c = std::ldexp(random.between(-(1 << bits), 1 << bits), -bits);
  }
  return {q};
}

// Makes the smallest numbers, alone or among small integers.
QueryTask denormals(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  Query q = small_integers(random, index);
  constexpr int subnormal_exponent = -1074;
  const int kind = random.below(3);
  if (kind == 0) {
    for (double* c : numbers_of(q)) *c = std::ldexp(*c, subnormal_exponent);
  } else {
    for (int changes = kind == 1 ? 1 : random.between(2, 8); changes > 0; --changes) {
      double& c = any_coordinate(random, q);
      c = std::ldexp(random.between(-3, 3), subnormal_exponent);
    }
  }
  return {q};
}

QueryTask exponents(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  Query q = empty_query(index);
  const bool small = random.below(2) == 0;
  for (double* c : numbers_of(q)) {
    const double mantissa = small ? random.between(-2, 2) : random.full_mantissa();
    *c = std::ldexp(mantissa, random.between(-1074, 1022));
  }
  if (random.below(3) == 0) q.points[3] = q.points[static_cast<std::size_t>(random.below(3))];
  return {q};
}

QueryTask generic(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  Query q = empty_query(index);
  for (double* c : numbers_of(q)) *c = random.full_mantissa();
  return {q};
}

// Lets the first group land on the second one at the end of the step: level or at any angle,
// exactly or some units of the last place beyond or short of it. Some pass within the step, and
// some leave. One in six is generic.
QueryTask everyday(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  Query q = empty_query(index);
  const auto first_group = static_cast<std::size_t>(q.first_group);
  const EverydayNumbers numbers(random);
  const auto axis = static_cast<std::size_t>(random.below(3));
  const bool is_level = numbers.keeps_levels();
  std::array<double, 4> weights{};  // of the place of contact, in both groups
  std::array<Point, 4> landed;
  for (std::size_t i = 0; i < 4; ++i) {
    landed[i] = any_vector(random);
    if (is_level) landed[i][axis] = 0;
    weights[i] = random.one_in(5) ? 0 : random.between(1, 8);
  }
  const auto normalise = [&](std::size_t from, std::size_t to) {
    if (std::all_of(&weights[from], &weights[from] + (to - from), [](double w) { return w == 0; }))
      weights[from] = 1;
    double sum = 0;
    for (std::size_t i = from; i < to; ++i) sum += weights[i];
    for (std::size_t i = from; i < to; ++i) weights[i] /= sum;
  };
  normalise(0, first_group);
  normalise(first_group, 4);
  // From the place of contact in the first group to that in the second one.
  const auto gap = [&](const std::array<Point, 4>& at) {
    Point sum = {0, 0, 0};
    for (std::size_t i = 0; i < 4; ++i) sum = sum + (i < first_group ? -1 : 1) * weights[i] * at[i];
    return sum;
  };
  const Point onto = gap(landed);
  for (std::size_t i = 0; i < first_group; ++i) landed[i] = landed[i] + onto;

  const bool is_generic = random.one_in(6), rests = random.one_in(2),
             is_straight = random.one_in(2);
  Point down = any_vector(random), other = any_vector(random);
  if (is_straight) {
    down = {0, 0, 0};
    down[axis] = random.signed_unit();
    other = random.signed_unit() * down;
  }
  std::array<Point, 4> end;
  for (std::size_t i = 0; i < 4; ++i) {
    Point way = i < first_group ? down : rests ? Point{0, 0, 0} : other;
    if (is_generic) way = any_vector(random);
    q.points[i].t0 = numbers.place(landed[i] - way);
    end[i] = numbers.end(q.points[i].t0, way);
  }
  if (!is_generic) {
    const Point rest = gap(end), way = end[0] - q.points[0].t0;
    for (std::size_t i = 0; i < first_group; ++i) {
      end[i] = end[i] + rest;
      if (is_level) end[i][axis] = end[3][axis];
    }
    put_on(end, first_group, way, units_at_a_feature(random));
  }
  const int when = random.below(8);
  const double share = random.between(1, 31) / 32.0;
  for (std::size_t i = 0; i < 4; ++i) {
    auto& p = q.points[i];
    p.t1 = when == 0 ? p.t0 + 1 / share * (end[i] - p.t0) : end[i];
    if (when == 1) std::swap(p.t0, p.t1);
  }
  // Written differently, -0 would be another query.
  for (double* c : numbers_of(q)) *c += 0.0;
  return {q};
}

constexpr Family contact_table[] = {
    family_of<small_int>("query-small-int", "integers within 1..4, planar and collinear too", 1),
    family_of<constructed>("query-constructed", "exact contacts at a known time of eighths", 5),
    family_of<ulp_neighbours>("query-ulp", "neighbouring doubles of exact contacts", 5),
    family_of<far_from_origin>("query-far", "moved by 2^30 to 2^50", 10),
    family_of<mixed_scales>("query-mixed-scales", "small integers times 2^-30 to 2^30", 20),
    family_of<dyadics>("query-dyadics", "fractions of up to 10 bits", 10),
    family_of<denormals>("query-denormals", "5e-324 alone or among small integers", 200),
    family_of<exponents>("query-exponents", "exponents over all doubles", 1000),
    family_of<generic>("query-generic", "uniform in a cube", 5),
    family_of<everyday>("query-everyday",
                        "coordinates as programs compute them; motion ends at a feature", 5),
    family_of<extreme_contact>(
        "query-extreme", "exponents over all doubles, denormals, few mantissas, mostly degenerate",
        1000),
};

}  // namespace

std::span<const Family> query_families() { return contact_table; }
std::span<const Family> self_test_queries() {
  return query_families().first(std::size(contact_table) - 1);
}

namespace {

constexpr int least_exponent = -1074, greatest_exponent = 1020;

int any_exponent(Random& random) { return random.between(least_exponent, greatest_exponent); }

// The source from which a query draws its coordinates.
class ExtremeNumbers {
 public:
  explicit ExtremeNumbers(Random& random) : random_(random), kind_(random.below(7)) {
    for (int& e : scales_) e = any_exponent(random);
  }

  // Draws a number, the exponent before the mantissa.
  double next() {
    switch (kind_) {
      case 0: {  // anything
        const int exponent = any_exponent(random_);
        return std::ldexp(random_.full_mantissa(), exponent);
      }
      case 1: {  // few mantissas
        const int exponent = any_exponent(random_);
        return std::ldexp(random_.between(-2, 2), exponent);
      }
      case 2: {  // powers of two and many zeros
        if (random_.one_in(2)) return 0;
        const int exponent = any_exponent(random_);
        return std::ldexp(2 * random_.below(2) - 1, exponent);
      }
      case 3: {  // few scales
        const int exponent = scales_[random_.below(3)];
        return std::ldexp(random_.between(-3, 3), exponent);
      }
      case 4:  // denormals beside ordinary numbers
        return random_.one_in(3) ? std::ldexp(random_.between(-3, 3), least_exponent)
                                 : random_.between(-4, 4);
      case 5: {  // neighbouring doubles of small integers of one scale, and zeros
        const double c = std::ldexp(random_.between(-4, 4), scales_[0]);
        return random_.one_in(2) ? c : std::nextafter(c, random_.signed_unit());
      }
      default: {  // full mantissas of few scales
        const int exponent = scales_[random_.below(3)];
        return std::ldexp(random_.full_mantissa(), exponent);
      }
    }
  }

 private:
  Random& random_;
  int kind_;
  std::array<int, 3> scales_;
};

// Makes points coincide, stay or move alike, or lie all in a plane or on a line.
void degenerate(Random& random, std::span<MovingPoint> points) {
  const auto any = [&]() -> MovingPoint& { return one_of(random, points); };
  if (random.one_in(4)) any() = any();
  if (random.one_in(4)) any().t0 = any().t0;
  if (random.one_in(4)) any().t1 = any().t1;
  if (random.one_in(3)) {
    MovingPoint& still = any();
    still.t1 = still.t0;
  }
  // 0 changes nothing; 1 lets a coordinate vanish; 2 gives it the value of the next one; 3 leaves
  // only one coordinate.
  const int shape = std::max(0, random.below(8) - 4);
  const auto k = static_cast<std::size_t>(random.below(3));
  for (MovingPoint& p : points) {
    for (Point* x : {&p.t0, &p.t1}) {
      if (shape == 1) (*x)[k] = 0;
      if (shape == 2) (*x)[k] = (*x)[(k + 1) % 3];
      if (shape == 3) (*x)[k] = (*x)[(k + 1) % 3] = 0;
    }
  }
}

// Makes p = (0,-a,0) -> (0,0,-e) and (0,0,0), (0,0,-c) -> 0, 0 -> (0,-e,0). These points are
// coplanar throughout, and the dependencies have roots at 1 - e/a and 1 - e/c.
void roots_next_to_one(Random& random, std::span<MovingPoint> points) {
  const auto power = [&](int lo, int hi) { return std::ldexp(1, random.between(lo, hi)); };
  const double a = power(0, greatest_exponent), c = a * random.between(1, 9);
  const double e = power(least_exponent, 0);
  points[0] = {{0, -a, 0}, {0, 0, -e}};
  points[1] = {{0, 0, 0}, {0, 0, 0}};
  points[2] = {{0, 0, -c}, {0, 0, 0}};
  points[3] = {{0, 0, 0}, {0, -e, 0}};
  if (random.one_in(2)) points[1].t1[0] = power(least_exponent, 0);
}

}  // namespace

void make_extreme(Random& random, std::span<MovingPoint> points) {
  ExtremeNumbers numbers(random);
  for (MovingPoint& p : points) {
    for (double& c : p.t0) c = numbers.next();
    for (double& c : p.t1) c = numbers.next();
  }
  if (random.one_in(2)) degenerate(random, points);
  if (random.one_in(16)) roots_next_to_one(random, points);
}

QueryTask extreme_contact(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  Query query;
  query.first_group = index % 2 == 0 ? 1 : 2;
  make_extreme(random, query.points);
  return {query};
}

}  // namespace assay::properties
