#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <utility>

#include "oracle/distance/feature_distance.h"
#include "oracle/referee/static_check.h"
#include "properties/changes/changes.h"
#include "properties/queries/query_methods.h"

namespace assay::properties {

namespace {

using detector::Decision;
using detector::MovingPoint;
using detector::Point;
using detector::TimeEnclosure;
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

std::string text(const TimeEnclosure& t) { return fmt::format("[{:a}, {:a}]", t.lo, t.hi); }
std::string text(const oracle::RationalTime& t) {
  return fmt::format("{}/{}", t.numerator, t.denominator);
}

std::string text(const MethodAnswer& answer, const AskedQuery& asked) {
  const auto& proof = answer.proof;
  const std::string met = asked.within ? "near" : "contact";
  if (answer.decision == Decision::open)
    return proof ? "cannot tell, not near up to " + text(proof->after) : "cannot tell";
  if (answer.decision == Decision::no) return asked.within ? "never near" : "no contact";
  if (proof) return fmt::format("near in ({}, {}]", text(proof->after), text(proof->by));
  return answer.first ? met + " at " + text(*answer.first) : met;
}

// Whether the first time is 0, as the referee has proved.
bool is_at_start(const oracle::DistanceVerdict& proof) {
  return proof.within == Decision::yes && proof.by.numerator == 0;
}

// Whether the enclosed time, lo itself or one strictly between lo and hi, surely lies outside of
// what is proved.
bool is_outside(const TimeEnclosure& time, const oracle::DistanceVerdict& proof) {
  const int end = oracle::compare(proof.by, time.lo);
  const bool is_after =
      proof.within == Decision::yes && (end < 0 || (end == 0 && time.lo < time.hi));
  return is_after || (!is_at_start(proof) && oracle::compare(proof.after, time.hi) >= 0);
}

bool misses(const MethodAnswer& answer, double met_at) {
  return answer.decision == Decision::no || (answer.first && answer.first->lo > met_at) ||
         (answer.proof && !is_at_start(*answer.proof) &&
          oracle::compare(answer.proof->after, met_at) >= 0);
}

std::optional<std::string> not_as_known(const AskedQuery& asked) {
  const auto& known = asked.known;
  if (!known) return {};
  for (const auto want : {Want::yes_no, Want::first_time}) {
    const auto answer = oracle_answer(asked, want);
    if (answer.decision != known->decision || (answer.first && answer.first != known->first))
      return fmt::format("`{}`: not the answer or time that is known", asked.name);
    const auto name_of = [](int rung) {
      return method_of("oracle")->rungs[static_cast<std::size_t>(rung)];
    };
    if (answer.rung != known->rung)
      return fmt::format("`{}`: rung {} decided, {} must", asked.name, name_of(answer.rung),
                         name_of(known->rung));
  }
  return {};
}

std::optional<std::string> first_contradiction(const AskedQuery& asked, std::uint64_t pick,
                                               QueryTally& tally,
                                               std::span<const QueryMethod> methods) {
  const MethodAnswer of_oracle = oracle_answer(asked, Want::first_time);
  tally.contacts += of_oracle.decision == Decision::yes ? 1 : 0;
  tally.rungs.add(static_cast<oracle::Rung>(of_oracle.rung));
  const auto oracle_text = [&] {
    return "oracle: " + text(of_oracle, asked) +
           (asked.met_at ? fmt::format("; made to meet at {:a}", *asked.met_at) : "");
  };
  if (contradicts(of_oracle, of_oracle, asked)) return oracle_text();
  const auto checks = asked.within ? QueryChecks::distances : QueryChecks::contacts;
  bool open = false;
  for (const QueryMethod& method : methods) {
    if (method.checks != checks || pick % static_cast<std::uint64_t>(method.one_in) != 0) continue;
    const MethodAnswer answer = method.answer(asked);
    open = open || (method.is_referee && answer.decision == Decision::open);
    if (contradicts(answer, of_oracle, asked))
      return fmt::format("{}: {}; {}", method.name, text(answer, asked), oracle_text());
  }
  tally.open += open ? 1 : 0;
  if (asked.within) return {};
  for (std::size_t i = 0; i < invariances.size(); ++i) {
    const Invariance& law = invariances[(pick + i) % invariances.size()];
    const auto broken = law.broken(asked.query, of_oracle, pick / invariances.size());
    if (!broken) continue;
    ++tally.invariances;
    if (broken->empty()) break;
    return fmt::format("oracle breaks the invariance `{}`: {}", law.name, *broken);
  }
  return not_as_known(asked);
}

}  // namespace

bool contradicts(const MethodAnswer& answer, const MethodAnswer& of_oracle,
                 const AskedQuery& asked) {
  const bool are_decided =
      answer.decision != Decision::open && of_oracle.decision != Decision::open;
  return (are_decided && answer.decision != of_oracle.decision) ||
         (answer.first && of_oracle.first && answer.first != of_oracle.first) ||
         (answer.proof && of_oracle.first && is_outside(*of_oracle.first, *answer.proof)) ||
         (asked.met_at && misses(answer, *asked.met_at));
}

std::optional<std::string> check_query(const AskedQuery& asked, std::uint64_t pick,
                                       QueryTally& tally, std::span<const QueryMethod> methods) {
  ++tally.queries;
  std::optional<std::string> wrong;
  try {
    wrong = first_contradiction(asked, pick, tally, methods);
  } catch (const std::exception& thrown) {
    wrong = fmt::format("a method threw: {}", thrown.what());
  }
  tally.contradictions += wrong ? 1 : 0;
  return wrong;
}

std::string exact_text(const MovingPoint& path) {
  const auto& [x, y] = path;
  return fmt::format("t=0 ({:a}, {:a}, {:a})  t=1 ({:a}, {:a}, {:a})", x[0], x[1], x[2], y[0], y[1],
                     y[2]);
}

std::string exact_text(const AskedQuery& asked) {
  std::string out = asked.name.empty() ? "" : asked.name + "\n";
  if (const auto& d = asked.within)
    out += fmt::format("distance {:a} + {:a}\n", d->first, d->second);
  out += asked.query.first_group == 1 ? "vertex-face: vertex, then three corners\n"
                                      : "edge-edge: two ends, then two ends\n";
  for (const auto& path : asked.query.points) out += "  " + exact_text(path) + "\n";
  return out;
}

std::string answers_text(const AskedQuery& asked) {
  const auto of_oracle = text(oracle_answer(asked, Want::first_time), asked);
  if (asked.within)
    return fmt::format("oracle: {}\nleast distance: {:a}\n", of_oracle,
                       oracle::least_distance(asked.query));
  std::string out = fmt::format("oracle, timed: {}\n", of_oracle);
  for (const QueryMethod& method : query_methods()) {
    if (method.checks == QueryChecks::contacts)
      out += fmt::format("{}: {}\n", method.name, text(method.answer(asked), asked));
  }
  return out;
}

}  // namespace assay::properties
