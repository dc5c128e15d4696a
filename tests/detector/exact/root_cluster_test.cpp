// Roots that share a gap between doubles, made from the roots themselves: each must be found, in
// order, and the work must grow with the logarithm of the bits that separate them.
#include "detector/exact/real_root.h"
#include "detector/exact/root_isolation.h"
#include "tests/test.h"

namespace assay::detector {
namespace {

// numerator / denominator
struct RationalRoot {
  Integer numerator, denominator;
  friend RationalRoot operator+(const RationalRoot& a, const RationalRoot& b) {
    return {a.numerator * b.denominator + b.numerator * a.denominator,
            a.denominator * b.denominator};
  }
  friend bool operator<(const RationalRoot& a, const RationalRoot& b) {
    return a.numerator * b.denominator < b.numerator * a.denominator;
  }
};

RationalRoot fraction(int numerator, int denominator) { return {numerator, denominator}; }
RationalRoot dyadic_root(int numerator, int bits) {
  return {numerator, Integer(1) << static_cast<unsigned>(bits)};
}
RationalRoot double_root(double time) {
  const Binary b = binary_of(time);
  return {b.mantissa, Integer(1) << static_cast<unsigned>(-b.exponent)};
}

Polynomial vanishing_at_root(const RationalRoot& r) {
  return Polynomial::linear(-r.numerator, r.denominator - r.numerator);
}

Polynomial product_over(const std::vector<RationalRoot>& roots) {
  Polynomial f = Polynomial::constant(3);
  for (const auto& r : roots) f = f * vanishing_at_root(r);
  return f;
}

// The adjacent doubles around a time that is no double itself.
TimeEnclosure gap_around(const RationalRoot& r) {
  return roots_in_unit_interval(vanishing_at_root(r)).front().enclosure();
}

// Of all roots in their one gap. Returns the number of parts that were counted over.
int expect_isolated(const std::vector<RationalRoot>& roots, const Polynomial& others) {
  const Polynomial f = product_over(roots) * others;
  const TimeEnclosure gap = gap_around(roots.front());
  std::vector<IsolatedRoot> found;
  const int counted = isolate_in_gap(f, gap, Roots::all, found);
  EXPECT_EQ(found.size(), roots.size());
  if (found.size() != roots.size()) return counted;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    EXPECT_EQ(found[i].doubles, gap);
    const Polynomial there = vanishing_at_root(roots[i]);
    if (found[i].is_time()) {
      EXPECT_EQ(there.sign_at(found[i].lo), 0) << i;
    } else {
      EXPECT_EQ(there.sign_at(found[i].lo), -1) << i;
      EXPECT_EQ(there.sign_at(found[i].hi), 1) << i;
    }
  }
  // And as the roots of the whole interval, in the order given.
  const auto all = roots_in_unit_interval(f);
  std::size_t next = 0;
  for (const auto& root : all) {
    if (next < roots.size() && root.sign_of(vanishing_at_root(roots[next])) == 0) {
      EXPECT_EQ(root.enclosure(), gap);
      for (std::size_t i = 0; i < roots.size(); ++i) {
        EXPECT_EQ(root.sign_of(vanishing_at_root(roots[i])), i < next ? 1 : i > next ? -1 : 0);
      }
      ++next;
    }
  }
  EXPECT_EQ(next, roots.size());
  return counted;
}

// 4 log2(s) steps of at most six counts, for each cluster of clusters, and some to begin with.
int most_counts(int bits, int clusters) {
  return clusters * (24 * static_cast<int>(std::ceil(std::log2(bits))) + 24);
}

const Polynomial nothing_else = Polynomial::constant(1);

struct Place {
  const char* name;
  RationalRoot root;
};

std::vector<Place> places() {
  return {{"next to 0", dyadic_root(1, 1100)},
          {"next to 1", double_root(1 - 0x1p-53) + dyadic_root(1, 58)},
          {"next to 0.3", double_root(0.3) + dyadic_root(1, 60)},
          {"in the middle of a gap", fraction(1, 3)},
          {"behind a power of two", double_root(0.25) + dyadic_root(3, 59)}};
}

TEST(RootCluster, TakesFewStepsForAnyDistance) {
  for (const auto& place : places()) {
    int most = 0;
    for (const int bits : {60, 61, 75, 100, 300, 1000, 1999, 2000}) {
      const int below = place.root.denominator > (Integer(1) << 1000u) ? 1100 : 0;
      const std::vector<RationalRoot> two = {place.root, place.root + dyadic_root(1, below + bits)};
      const int counted = expect_isolated(two, nothing_else);
      EXPECT_LE(counted, most_counts(bits, 1)) << place.name << ", 2^-" << bits;
      most = std::max(most, counted);
    }
    std::printf("%s: at most %d counts\n", place.name, most);
  }
}

TEST(RootCluster, TellsThreeRootsAtTwoScalesApart) {
  for (const auto& place : places()) {
    int most = 0;
    const int below = place.root.denominator > (Integer(1) << 1000u) ? 1100 : 0;
    for (const auto& [near, far] : {std::pair{2000, 70}, {2000, 1000}, {300, 299}, {900, 80}}) {
      for (const bool first : {false, true}) {
        const RationalRoot a = place.root, c = a + dyadic_root(1, below + far);
        const RationalRoot b = (first ? a : c) + dyadic_root(first ? 1 : -1, below + near);
        const int counted = expect_isolated({a, b, c}, nothing_else);
        EXPECT_LE(counted, most_counts(near, 2)) << place.name << " " << near << " " << far;
        most = std::max(most, counted);
      }
    }
    std::printf("%s: at most %d counts\n", place.name, most);
  }
}

// What cannot be seen between doubles but is near: roots at the ends of the gap, in the next one,
// two complex ones beside the cluster.
TEST(RootCluster, OtherRootsNearbyDoNotMatter) {
  const RationalRoot a = double_root(0.3) + dyadic_root(1, 60);
  const Polynomial ends =
      vanishing_at_root(double_root(0.3)) * vanishing_at_root(double_root(std::nextafter(0.3, 1)));
  const Polynomial before = vanishing_at_root(double_root(0.3) + dyadic_root(-1, 70));
  // (t - a)^2 + 2^-400, in integers
  const Polynomial t_a = vanishing_at_root(a + dyadic_root(1, 300));
  const Integer d = a.denominator << 300u;
  const Polynomial complex =
      Polynomial::constant(Integer(1) << 400u) * t_a * t_a + Polynomial::constant(d * d);
  for (const Polynomial& others : {ends, before, complex}) {
    for (const int bits : {70, 500, 2000}) {
      const int counted = expect_isolated({a, a + dyadic_root(1, bits)}, others);
      EXPECT_LE(counted, most_counts(bits, 2)) << bits;
    }
  }
}

// A root where a part is split is a root to report, in its place.
TEST(RootCluster, ReportsRootsAtSplits) {
  const double lo = 0.5, hi = std::nextafter(0.5, 1);
  const RationalRoot half = double_root(lo), middle = half + dyadic_root(1, 54);
  ASSERT_EQ(gap_around(middle), (TimeEnclosure{lo, hi}));
  for (const int bits : {55, 56, 57, 90, 400}) {
    expect_isolated({middle + dyadic_root(-1, bits), middle, middle + dyadic_root(1, bits)},
                    nothing_else);
    expect_isolated({middle, middle + dyadic_root(1, bits)}, nothing_else);
    expect_isolated({half + dyadic_root(1, bits), half + dyadic_root(3, bits)}, nothing_else);
  }
}

TEST(RootCluster, AnyRootWillDo) {
  const RationalRoot a = fraction(1, 3);
  const Polynomial f = product_over({a, a + dyadic_root(1, 500), a + dyadic_root(1, 400)});
  std::vector<IsolatedRoot> found;
  isolate_in_gap(f, gap_around(a), Roots::any, found);
  EXPECT_EQ(found.size(), 1u);
  EXPECT_TRUE(has_root_in_unit_interval(f));
}

}  // namespace
}  // namespace assay::detector
