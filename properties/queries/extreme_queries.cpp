#include <cmath>
#include <span>

#include "properties/queries/query_families.h"
#include "properties/random.h"

namespace assay::properties {
namespace {

using detector::MovingPoint;
using detector::Point;

constexpr int least_exponent = -1074, greatest_exponent = 1020;

int any_exponent(Random& random) { return random.between(least_exponent, greatest_exponent); }

// The source from which a query draws its coordinates.
class ExtremeNumbers {
 public:
  explicit ExtremeNumbers(Random& random) : random_(random), kind_(random.below(7)) {
    for (int& e : scales_) e = any_exponent(random);
  }

  // An exponent is drawn before its mantissa.
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

// p = (0,-a,0) -> (0,0,-e) and (0,0,0), (0,0,-c) -> 0, 0 -> (0,-e,0). These points are coplanar
// throughout, and the dependencies have roots at 1 - e/a and 1 - e/c.
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

AskedQuery extreme_contact(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  Query query;
  query.first_group = index % 2 == 0 ? 1 : 2;
  make_extreme(random, query.points);
  return {query};
}

}  // namespace assay::properties
