#include "detector/distance/nearness.h"

#include "detector/contact/rungs.h"
#include "detector/exact/ball.h"
#include "detector/exact/real_root.h"
#include "detector/exact/root_isolation.h"
#include "detector/geometry/near_regions.h"

namespace assay::detector {
namespace {

template <class Number>
using Places = std::array<std::array<Number, 3>, 4>;

// Coordinates and distance as integers in one unit.
struct IntegerQuery {
  IntegerQuery(const FourPoints& query, double d) : first_group(query.first_group) {
    std::array<double, 25> values;
    std::array<Integer, 25> scaled;
    std::size_t count = 0;
    for (const MovingPoint& p : query.points) {
      for (std::size_t k = 0; k < 3; ++k) {
        values[count++] = p.t0[k];
        values[count++] = p.t1[k];
      }
    }
    values[count] = d;
    to_common_integers(values, scaled);
    squared_distance = scaled[count] * scaled[count];
    count = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        at_start[i][k] = scaled[count++];
        at_end[i][k] = scaled[count++];
      }
    }
  }

  Places<Polynomial> over_step() const {
    Places<Polynomial> x;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < 3; ++k)
        x[i][k] = Polynomial::linear(at_start[i][k], at_end[i][k]);
    }
    return x;
  }

  int first_group;
  Integer squared_distance;
  Places<Integer> at_start, at_end;
};

bool near_at_start(const IntegerQuery& query) {
  return some_region_holds(
      NearRegions<Integer>(query.at_start, query.first_group, query.squared_distance),
      Near::within);
}

bool holds_at(const RealRoot& time, const NearRegion<Polynomial>& region) {
  if (region.conditions > 0 && time.sign_of(region.positive) <= 0) return false;
  for (std::size_t g = 0; g < region.conditions; ++g) {
    if (time.sign_of(region.not_negative[g]) < 0) return false;
  }
  return true;
}

// Looks at a short piece [lo,hi] of the step in balls. Returns for each region whether its
// conditions hold in the piece; false too for a region that is surely not near there. Returns
// nothing if neither is sure for some region.
std::optional<std::array<bool, 9>> regions_that_hold(const FourPoints& query, double d, double lo,
                                                     double hi) {
  constexpr double least_width = 0x1p-900;
  if (!(hi - lo > least_width)) return std::nullopt;
  const Ball time = Ball::between(lo, hi), squared = Ball::of(d) * Ball::of(d);
  Places<Ball> x;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Ball from = Ball::of(query.points[i].t0[k]), to = Ball::of(query.points[i].t1[k]);
      x[i][k] = from + time * (to - from);
    }
  }
  const NearRegions<Ball> regions(x, query.first_group, squared);
  std::array<bool, 9> holds{};
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const auto region = regions[i];
    if (region.f.sign() == 1) continue;
    bool fails = false, is_sure = region.conditions == 0 || region.positive.sign() == 1;
    for (std::size_t g = 0; g < region.conditions; ++g) {
      const auto sign = region.not_negative[g].sign();
      fails |= sign == -1;
      is_sure &= sign == 1;
    }
    if (fails) continue;
    if (!is_sure) return std::nullopt;
    holds[i] = true;
  }
  return holds;
}

// Returns nothing if balls or counts of sign changes do not tell.
std::optional<TimeEnclosure> time_in_piece(const FourPoints& query, double d, double lo, double hi,
                                           double guess) {
  const auto holds = regions_that_hold(query, d, lo, hi);
  if (!holds) return std::nullopt;
  const IntegerQuery integers(query, d);
  const Places<Polynomial> x = integers.over_step();
  const Polynomial squared = Polynomial::constant(integers.squared_distance);
  const NearRegions<Polynomial> regions(x, query.first_group, squared);
  std::optional<TimeEnclosure> first;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (!(*holds)[i]) continue;
    // Where its conditions hold, the faces of a region are no nearer than the features: f(lo) > 0.
    const Polynomial f = regions[i].f;
    const int at_hi = f.sign_at(Dyadic::of(hi));
    const SignChanges changes = sign_changes_over(f, Dyadic::of(lo), Dyadic::of(hi));
    if (changes.count == 0 && at_hi > 0) continue;
    if (changes.count != 1 || at_hi >= 0) return std::nullopt;
    const TimeEnclosure time = enclose_single_root(f, lo, hi, guess);
    if (!first || time < *first) first = time;
  }
  return first;
}

class NearTest : public ElementaryTest {
 public:
  explicit NearTest(double d) : d_(d) {}
  double separation() const override { return d_; }
  bool is_apart_along_an_axis(const FourPoints& query) const override {
    return separated_along_an_axis(query, d_);
  }
  ContactResult test(const FourPoints& query, Want want) const override {
    const NearResult filtered = filter_near(query, d_);
    if (filtered.decision == Decision::no) return {false, {}, ContactRung::filter};
    if (filtered.decision == Decision::yes) {
      if (filtered.hi == 0 || want == Want::yes_no) return {true, {0, 0}, ContactRung::filter};
      return {true,
              exact_near_time_between(query, d_, filtered.lo, filtered.hi, filtered.time_guess),
              ContactRung::filter};
    }
    const auto first = exact_near_time(query, d_);
    return {first.has_value(), first.value_or(TimeEnclosure{}), ContactRung::unbounded};
  }

 private:
  double d_;
};

}  // namespace

std::optional<TimeEnclosure> exact_near_time(const FourPoints& query, double d) {
  const IntegerQuery integers(query, d);
  if (near_at_start(integers)) return TimeEnclosure{0, 0};
  const Places<Polynomial> x = integers.over_step();
  const Polynomial squared = Polynomial::constant(integers.squared_distance);
  const NearRegions<Polynomial> regions(x, query.first_group, squared);
  std::optional<TimeEnclosure> first;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const auto region = regions[i];
    if (region.f.is_zero()) continue;
    for (const RealRoot& root : roots_in_unit_interval(region.f)) {
      if (first && *first <= root.enclosure()) break;
      if (holds_at(root, region)) first = root.enclosure();
    }
  }
  return first;
}

TimeEnclosure exact_near_time_between(const FourPoints& query, double d, double lo, double hi,
                                      double guess) {
  if (const auto time = time_in_piece(query, d, lo, hi, guess)) return *time;
  return *exact_near_time(query, d);
}

ContactResult test_near(const FourPoints& query, double d, Want want) {
  const NearTest near(d);
  if (near.is_apart_along_an_axis(query)) return {false, {}, ContactRung::axis};
  return near.test(query, want);
}

std::shared_ptr<const ElementaryTest> make_near_test(double d) {
  return std::make_shared<NearTest>(d);
}

}  // namespace assay::detector
