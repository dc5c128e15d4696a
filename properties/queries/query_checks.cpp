#include "properties/queries/query_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <utility>

namespace assay::properties {

namespace {

using detector::MovingPoint;
using detector::Point;
using detector::TimeEnclosure;
using detector::Want;
using oracle::ContactAnswer;

// Changes of a query under which the oracle's answer, and mostly its first time, are known.

// Says what is wrong; an empty text if the law holds; nothing if the change cannot be applied to
// this query without rounding. `pick` chooses among variants of the change.
using Broken = std::optional<std::string>;
struct Invariance {
  const char* name;
  Broken (*broken)(const Query& query, const ContactAnswer& answer, std::uint64_t pick);
};

Broken compare_answers(const Query& changed, const ContactAnswer& expected) {
  const ContactAnswer answer = oracle::contact_of(changed, Want::first_time);
  if (answer.contact != expected.contact) return "another answer";
  if (answer.contact && answer.first != expected.first) return "another first time";
  return "";
}

Broken order_of_points(const Query& query, const ContactAnswer& answer, std::uint64_t pick) {
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

Broken axes(const Query& query, const ContactAnswer& answer, std::uint64_t pick) {
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

// Changes every coordinate. Returns false if one change is not exact.
template <class Change>
bool change_exactly(Query& q, const Change& change) {
  for (MovingPoint& p : q.points) {
    for (Point* end : {&p.t0, &p.t1}) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (!change((*end)[k], k)) return false;
      }
    }
  }
  return true;
}

Broken powers_of_two(const Query& query, const ContactAnswer& answer, std::uint64_t pick) {
  constexpr std::array exponents = {-900, -300, -60, -1, 1, 7, 60, 290, 900};
  const int exponent = exponents[pick % exponents.size()];
  Query q = query;
  const bool exact = change_exactly(q, [&](double& c, std::size_t) {
    const double scaled = std::ldexp(c, exponent);
    const bool same = std::isfinite(scaled) && std::ldexp(scaled, -exponent) == c;
    c = scaled;
    return same;
  });
  if (!exact) return {};
  return compare_answers(q, answer);
}

// Whether a + b is a double; then `sum` is it. This is the TwoSum of Knuth, whose error term is
// exact.
bool adds_exactly(double a, double b, double& sum) {
  sum = a + b;
  if (!std::isfinite(sum)) return false;
  const double b_used = sum - a, a_used = sum - b_used;
  return (a - a_used) + (b - b_used) == 0;
}

Broken translation(const Query& query, const ContactAnswer& answer, std::uint64_t pick) {
  constexpr std::array steps = {1.0, -3.0, 0x1p-3, 0x1p20, -0x1p45, 0x1p-60};
  Point by;
  for (double& c : by) {
    c = steps[pick % steps.size()];
    pick /= steps.size();
  }
  Query q = query;
  if (!change_exactly(q, [&](double& c, std::size_t k) { return adds_exactly(c, by[k], c); })) {
    return {};
  }
  return compare_answers(q, answer);
}

Broken time_reversed(const Query& query, const ContactAnswer& answer, std::uint64_t) {
  Query q = query;
  for (MovingPoint& p : q.points) std::swap(p.t0, p.t1);
  const ContactAnswer back = oracle::contact_of(q, Want::first_time);
  if (back.contact != answer.contact) return "another answer";
  // The first time of the reversed query is 1 - (last time), and the last time is not before the
  // first.
  if (back.contact && answer.first.lo + back.first.lo > 1) return "last contact before the first";
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

Broken halves(const Query& query, const ContactAnswer& answer, std::uint64_t) {
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
  const ContactAnswer early = oracle::contact_of(first, Want::first_time);
  const ContactAnswer late = early.contact ? early : oracle::contact_of(second, Want::first_time);
  if (late.contact != answer.contact) return "the halves answer otherwise";
  if (!answer.contact) return "";
  if (early.contact) {
    constexpr double doubling_is_exact_from = 0x1p-1000;
    const TimeEnclosure& t = answer.first;
    if (t.lo < doubling_is_exact_from && t.lo != t.hi) return "";
    if (early.first.lo != 2 * t.lo || early.first.hi != 2 * t.hi) {
      return "another time in the first half";
    }
    return "";
  }
  if (answer.first.lo < 0.5 || !same_in_second_half(answer.first, late.first)) {
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

std::string text(const TimeEnclosure& t) { return fmt::format("[{:a}, {:a}]", t.lo, t.hi); }

std::string text(const MethodAnswer& answer) {
  if (answer.decision == detector::Decision::open) return "cannot tell";
  if (answer.decision == detector::Decision::no) return "no contact";
  return answer.first ? "contact at " + text(*answer.first) : "contact";
}

MethodAnswer as_method(const ContactAnswer& answer) {
  if (!answer.contact) return {detector::Decision::no, {}};
  return {detector::Decision::yes, answer.first};
}

bool contradicts(const MethodAnswer& a, const MethodAnswer& b) {
  if (a.decision == detector::Decision::open || b.decision == detector::Decision::open)
    return false;
  return a.decision != b.decision || (a.first && b.first && *a.first != *b.first);
}

std::optional<std::string> first_contradiction(const GeneratedQuery& made, std::uint64_t pick,
                                               QueryTally& tally) {
  const Query& query = made.query;
  const auto timed = oracle::contact_of(query, Want::first_time);
  const MethodAnswer expected = as_method(timed);
  tally.contacts += timed.contact ? 1 : 0;
  tally.rungs.add(timed.rung);
  if (made.contact_at && (!timed.contact || timed.first.lo > *made.contact_at)) {
    return fmt::format("oracle: {}, but made to meet at {:a}", text(expected), *made.contact_at);
  }
  bool open = false;
  for (const QueryMethod& method : query_methods()) {
    const MethodAnswer answer = method.answer(query);
    open = open || answer.decision == detector::Decision::open;
    if (contradicts(answer, expected)) {
      return fmt::format("{}: {}; oracle: {}", method.name, text(answer), text(expected));
    }
  }
  tally.open += open ? 1 : 0;
  for (std::size_t i = 0; i < invariances.size(); ++i) {
    const Invariance& law = invariances[(pick + i) % invariances.size()];
    const auto broken = law.broken(query, timed, pick / invariances.size());
    if (!broken) continue;
    ++tally.invariances;
    if (broken->empty()) break;
    return fmt::format("oracle breaks the invariance `{}`: {}", law.name, *broken);
  }
  return {};
}

}  // namespace

QueryTally& QueryTally::operator+=(const QueryTally& other) {
  queries += other.queries;
  contacts += other.contacts;
  contradictions += other.contradictions;
  open += other.open;
  invariances += other.invariances;
  rungs += other.rungs;
  return *this;
}

std::optional<std::string> check_query(const GeneratedQuery& made, std::uint64_t pick,
                                       QueryTally& tally) {
  ++tally.queries;
  std::optional<std::string> wrong;
  try {
    wrong = first_contradiction(made, pick, tally);
  } catch (const std::exception& thrown) {
    wrong = fmt::format("a method threw: {}", thrown.what());
  }
  tally.contradictions += wrong ? 1 : 0;
  return wrong;
}

std::string exact_text(const Query& query) {
  std::string out = query.first_group == 1 ? "vertex-face: vertex, then three corners\n"
                                           : "edge-edge: two ends, then two ends\n";
  for (const auto& p : query.points) {
    out += fmt::format("  t=0 ({:a}, {:a}, {:a})  t=1 ({:a}, {:a}, {:a})\n", p.t0[0], p.t0[1],
                       p.t0[2], p.t1[0], p.t1[1], p.t1[2]);
  }
  return out;
}

std::string answers_text(const Query& query) {
  std::string out = fmt::format("oracle, timed: {}\n",
                                text(as_method(oracle::contact_of(query, Want::first_time))));
  for (const QueryMethod& method : query_methods()) {
    out += fmt::format("{}: {}\n", method.name, text(method.answer(query)));
  }
  return out;
}

}  // namespace assay::properties
