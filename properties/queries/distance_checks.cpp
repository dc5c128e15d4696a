#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "oracle/referee/static_check.h"
#include "properties/queries/distance_queries.h"

namespace assay::properties {

namespace {

using detector::Decision;
using oracle::DistanceVerdict;
using oracle::RationalTime;

bool is_zero(const RationalTime& t) { return t.numerator == 0; }

std::string text(const RationalTime& t) { return fmt::format("{}/{}", t.numerator, t.denominator); }

std::string text(const DistanceVerdict& verdict) {
  switch (verdict.within) {
    case Decision::no:
      return "never near";
    case Decision::yes:
      return is_zero(verdict.by)
                 ? "near at 0"
                 : "near in (" + text(verdict.after) + ", " + text(verdict.by) + "]";
    default:
      return "cannot tell, not near up to " + text(verdict.after);
  }
}

std::string text(const DistanceAnswer& answer) {
  return answer.is_near ? fmt::format("near at [{:a}, {:a}]", answer.first.lo, answer.first.hi)
                        : "never near";
}

// Whether the enclosed time, lo itself or one strictly between lo and hi, is surely not after t, or
// surely after it.
bool is_surely_not_after(const detector::TimeEnclosure& time, const RationalTime& t) {
  return oracle::compare(t, time.hi) >= 0;
}
bool is_surely_after(const detector::TimeEnclosure& time, const RationalTime& t) {
  const int sign = oracle::compare(t, time.lo);
  return sign < 0 || (sign == 0 && time.lo < time.hi);
}

}  // namespace

DistanceTally& DistanceTally::operator+=(const DistanceTally& other) {
  queries += other.queries;
  near += other.near;
  far += other.far;
  open += other.open;
  contradictions += other.contradictions;
  cells += other.cells;
  most_cells = std::max(most_cells, other.most_cells);
  return *this;
}

DistanceVerdict ask_distance_referee(const DistanceQuery& query,
                                     const oracle::DistanceRefereeOptions& options) {
  const auto& x = query.motion.points;
  if (query.motion.first_group == 1) {
    return oracle::distance_referee(detector::VertexFace{x[0], {x[1], x[2], x[3]}}, query.distance,
                                    options);
  }
  return oracle::distance_referee(detector::EdgeEdge{{x[0], x[1]}, {x[2], x[3]}}, query.distance,
                                  options);
}

std::optional<std::string> contradiction(const DistanceQuery& query,
                                         const DistanceVerdict& verdict) {
  if (!query.near_at) return {};
  const bool is_late =
      verdict.within == Decision::no || (oracle::compare(verdict.after, *query.near_at) >= 0 &&
                                         !(verdict.within == Decision::yes && is_zero(verdict.by)));
  if (!is_late) return {};
  return fmt::format("referee: {}, but made to be near at {:a}", text(verdict), *query.near_at);
}

std::optional<std::string> contradiction(const DistanceQuery& query, const DistanceAnswer& answer,
                                         const DistanceVerdict& verdict) {
  if (query.near_at && (!answer.is_near || answer.first.lo > *query.near_at)) {
    return fmt::format("method: {}, but made to be near at {:a}", text(answer), *query.near_at);
  }
  bool refuted = false;
  switch (verdict.within) {
    case Decision::no:
      refuted = answer.is_near;
      break;
    case Decision::yes:
      refuted = !answer.is_near || is_surely_after(answer.first, verdict.by) ||
                (!is_zero(verdict.by) && is_surely_not_after(answer.first, verdict.after));
      break;
    case Decision::open:
      // `after` is 0 also where nothing at all is proved but that t=0 is not near.
      refuted = answer.is_near && is_surely_not_after(answer.first, verdict.after);
      break;
  }
  if (!refuted) return {};
  return fmt::format("method: {}; referee: {}", text(answer), text(verdict));
}

std::optional<std::string> check_distance(const DistanceQuery& query, const DistanceMethod& method,
                                          DistanceTally& tally) {
  ++tally.queries;
  std::optional<std::string> wrong;
  try {
    const DistanceVerdict verdict = ask_distance_referee(query);
    ++(verdict.within == Decision::yes  ? tally.near
       : verdict.within == Decision::no ? tally.far
                                        : tally.open);
    tally.cells += verdict.cells;
    tally.most_cells = std::max(tally.most_cells, verdict.cells);
    wrong = contradiction(query, verdict);
    if (!wrong && method) wrong = contradiction(query, method(query), verdict);
  } catch (const std::exception& thrown) {
    wrong = fmt::format("a method threw: {}", thrown.what());
  }
  tally.contradictions += wrong ? 1 : 0;
  return wrong;
}

}  // namespace assay::properties
