// Changes of a query that must not matter to the oracle, on the families of the self-test.
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "properties/changes/changes.h"
#include "properties/queries/self_check.h"
#include "properties/random.h"
#include "tests/asked.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using detector::Point;
using detector::Want;

// Changes of a query under which the oracle's answer, and mostly its first time, are known.

// Says what is wrong; an empty text if the law holds; nothing if the change cannot be applied to
// this query without rounding. `pick` chooses among variants of the change.
using Broken = std::optional<std::string>;
struct Invariance {
  const char* name;
  Broken (*broken)(const Query& query, const MethodAnswer& answer, std::uint64_t pick);
};

Broken compare_answers(const Query& changed, const MethodAnswer& expected) {
  const MethodAnswer answer = oracle_answer({changed}, Want::first_time);
  if (answer.decision != expected.decision) return "another answer";
  if (answer.first != expected.first) return "another first time";
  return "";
}

Broken order_of_points(const Query& query, const MethodAnswer& answer, std::uint64_t pick) {
  Query q = query;
  auto& x = q.points;
  if (q.first_group == 1) {
    std::rotate(x.begin() + 1, x.begin() + 1 + static_cast<std::ptrdiff_t>(pick % 3), x.end());
    if (pick % 2 == 0) std::swap(x[2], x[3]);
  } else {
    if (pick % 2 == 0) std::swap(x[0], x[1]);
    if (pick / 2 % 2 == 0) std::swap(x[2], x[3]);
    if (pick % 4 == 3 || pick / 4 % 2 == 0) {
      std::swap(x[0], x[2]);
      std::swap(x[1], x[3]);
    }
  }
  return compare_answers(q, answer);
}

Broken axes(const Query& query, const MethodAnswer& answer, std::uint64_t pick) {
  std::array<std::size_t, 3> order = {0, 1, 2};
  for (std::uint64_t i = pick % 6; i > 0; --i) std::next_permutation(order.begin(), order.end());
  const std::uint64_t mirrored = pick / 6 % 8;
  Query q = query;
  auto change = [&](const Point& from, Point& to) {
    for (std::size_t k = 0; k < 3; ++k) {
      to[k] = (mirrored >> k) % 2 == 0 ? from[order[k]] : -from[order[k]];
    }
  };
  for (std::size_t i = 0; i < 4; ++i) {
    change(query.points[i].t0, q.points[i].t0);
    change(query.points[i].t1, q.points[i].t1);
  }
  return compare_answers(q, answer);
}

Broken powers_of_two(const Query& query, const MethodAnswer& answer, std::uint64_t pick) {
  constexpr std::array exponents = {-900, -300, -60, -1, 1, 7, 60, 290, 900};
  const int exponent = exponents[pick % exponents.size()];
  Query q = query;
  for (double* c : numbers_of(q)) {
    if (!scales_exactly(*c, exponent)) return {};
  }
  return compare_answers(q, answer);
}

Broken translation(const Query& query, const MethodAnswer& answer, std::uint64_t pick) {
  constexpr std::array steps = {1.0, -3.0, 0x1p-3, 0x1p20, -0x1p45, 0x1p-60};
  Point by;
  for (double& c : by) {
    c = steps[pick % steps.size()];
    pick /= steps.size();
  }
  Query q = query;
  const auto numbers = numbers_of(q);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!adds_exactly(*numbers[i], by[i % 3], *numbers[i])) return {};
  }
  return compare_answers(q, answer);
}

Broken time_reversed(const Query& query, const MethodAnswer& answer, std::uint64_t) {
  Query q = query;
  for (MovingPoint& p : q.points) std::swap(p.t0, p.t1);
  const MethodAnswer back = oracle_answer({q}, Want::first_time);
  if (back.decision != answer.decision) return "another answer";
  // The first time of the reversed query is 1 - (last time), and the last time is not before the
  // first.
  if (back.first && answer.first->lo + back.first->lo > 1) return "last contact before the first";
  return "";
}

// A time t of the second half is 2 t - 1 in the half, which is exact for doubles t in [1/2, 1].
bool same_in_second_half(const TimeEnclosure& whole, const TimeEnclosure& half) {
  const double lo = 2 * whole.lo - 1, hi = 2 * whole.hi - 1;
  if (whole.lo == whole.hi) return half.lo == lo && half.hi == lo;
  // The time lies strictly between two doubles. The enclosure in the half is finer, so it lies
  // within.
  return lo <= half.lo && half.hi <= hi;
}

Broken halves(const Query& query, const MethodAnswer& answer, std::uint64_t) {
  Query first = query, second = query;
  for (std::size_t i = 0; i < 4; ++i) {
    const MovingPoint& p = query.points[i];
    for (std::size_t k = 0; k < 3; ++k) {
      double middle = 0;
      if (!adds_exactly(p.t0[k], p.t1[k], middle)) return {};
      if (std::ldexp(std::ldexp(middle, -1), 1) != middle) return {};
      first.points[i].t1[k] = second.points[i].t0[k] = std::ldexp(middle, -1);
    }
  }
  const MethodAnswer early = oracle_answer({first}, Want::first_time);
  const MethodAnswer late = early.first ? early : oracle_answer({second}, Want::first_time);
  if (late.decision != answer.decision) return "the halves answer otherwise";
  if (!answer.first) return "";
  const TimeEnclosure& t = *answer.first;
  if (early.first) {
    constexpr double doubling_is_exact_from = 0x1p-1000;
    if (t.lo < doubling_is_exact_from && t.lo != t.hi) return "";
    if (early.first->lo != 2 * t.lo || early.first->hi != 2 * t.hi) {
      return "another time in the first half";
    }
    return "";
  }
  if (t.lo < 0.5 || !same_in_second_half(t, *late.first)) {
    return "another time in the second half";
  }
  return "";
}

// The changes: vertices permuted within their groups (and edges exchanged), axes permuted and
// mirrored, powers of two, time reversed, translation, the two halves of the step joined.
constexpr std::array invariances = {
    Invariance{"order of points", order_of_points}, Invariance{"axes", axes},
    Invariance{"powers of two", powers_of_two},     Invariance{"time reversed", time_reversed},
    Invariance{"translation", translation},         Invariance{"halves", halves},
};

// Of each query the change that its number chooses, or the next one that can be applied.
TEST(Invariances, OfTheOracleHoldOnTheFamiliesOfTheSelfTest) {
  const auto families = self_test_families(ASSAY_SOURCE_DIR "/corpus").value();
  const auto queries = tests::asked("ASSAY_CASES", 10'000), seed = tests::asked("ASSAY_SEED", 1);
  std::map<std::string, std::uint64_t> applied;
  for (const auto& family : families) {
    if (!family.query) continue;
    for (std::uint64_t index = 0; index < family.indices(queries); ++index) {
      const auto asked = family.query(seed, index);
      if (!asked || asked->within) continue;
      const auto answer = oracle_answer(*asked, Want::first_time);
      const std::uint64_t pick = Random(~seed, index).next();
      for (std::size_t i = 0; i < invariances.size(); ++i) {
        const Invariance& law = invariances[(pick + i) % invariances.size()];
        const auto broken = law.broken(asked->query, answer, pick / invariances.size());
        if (!broken) continue;
        ++applied[law.name];
        EXPECT_EQ(*broken, "") << law.name << ", " << family.name << ":" << seed << ":" << index;
        break;
      }
    }
  }
  for (const auto& [name, count] : applied) fmt::print("{:16} {}\n", name, count);
  EXPECT_EQ(applied.size(), invariances.size());
}

}  // namespace
}  // namespace assay::properties
