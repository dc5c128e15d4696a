#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "oracle/mesh/feature_pairs.h"
#include "oracle/referee/referee.h"
#include "oracle/referee/static_check.h"
#include "reports/bench/compared/comparison.h"

namespace assay::reports {
namespace {

using detector::FeatureKind, detector::PairContact;

// Returns the time this many eighths of the way from a double to the next, if 62 bits can hold it.
std::optional<oracle::RationalTime> between(double lo, double hi, int eighths) {
  constexpr int bits = 62;
  const double from = std::ldexp(lo, bits), way = std::ldexp(hi - lo, bits - 3);
  if (lo < 0x1p-7 || way != std::floor(way)) return std::nullopt;
  return oracle::RationalTime{
      static_cast<std::int64_t>(from) + eighths * static_cast<std::int64_t>(way),
      std::int64_t{1} << bits};
}

// Returns the fraction with the least denominator between two neighbouring doubles of (0, 1). If
// the exact time is a fraction of small whole numbers, such as 1/3, the result is that time. It is
// computed by continued fractions in long doubles. If these do not suffice, the result is some
// other fraction, which then witnesses nothing.
oracle::RationalTime simplest_between(double lo, double hi) {
  constexpr std::int64_t largest = std::int64_t{1} << 30;
  std::int64_t p0 = 0, q0 = 1, p1 = 1, q1 = 0;
  long double x = (static_cast<long double>(lo) + hi) / 2;
  for (int i = 0; i < 40; ++i) {
    const long double whole = std::floor(x);
    const auto part = static_cast<std::int64_t>(whole);
    const std::int64_t p = part * p1 + p0, q = part * q1 + q0;
    if (q > largest || part > largest) break;
    p0 = p1, q0 = q1, p1 = p, q1 = q;
    const long double value = static_cast<long double>(p) / static_cast<long double>(q);
    if ((value > lo && value < hi) || x == whole) break;
    x = 1 / (x - whole);
  }
  return {p1, std::max<std::int64_t>(q1, 1)};
}

struct StepWitness {
  const detector::SteppedMesh motion;
  const detector::TrianglesView triangles;
  bool takes_triangles;

  // Returns whether the features of the contact, or its triangles, meet at some time before
  // `answer_time`, or at any time if that is empty.
  bool meets_before(const PairContact& contact, std::optional<double> answer_time) const {
    const double end = answer_time.value_or(1), first = contact.time.hi;
    const double until = answer_time ? std::nextafter(end, 0.) : 1;
    const auto query = query_of(contact.feature);
    if (query && until > 0 && oracle::referee(*query, {.until = until}) == detector::Decision::yes)
      return true;
    std::vector<oracle::StaticTime> times = {contact.time.lo, first};
    for (const double share : {1. / 1024, 1. / 16, 1. / 2})
      times.emplace_back(first + (end - first) * share);
    if (!answer_time) times.emplace_back(1.);
    if (contact.time.lo < contact.time.hi) {
      times.emplace_back(simplest_between(contact.time.lo, contact.time.hi));
      for (int eighth = 7; eighth > 0; --eighth) {
        if (const auto time = between(contact.time.lo, contact.time.hi, eighth))
          times.emplace_back(*time);
      }
    }
    const bool is_seen = std::any_of(times.begin(), times.end(), [&](const auto& time) {
      if (oracle::compare(time, 0) < 0 || oracle::compare(time, end) > 0) return false;
      if (answer_time && oracle::compare(time, *answer_time) >= 0) return false;
      return meet_at(contact, time);
    });
    const double from = std::nextafter(contact.time.lo, 0.);
    return is_seen || (query && from >= 0 && from < end && oracle::meet_between(*query, from, end));
  }

  // Returns nothing for a contact of whole triangles.
  std::optional<detector::FourPoints> query_of(const detector::Feature& feature) const {
    if (feature.kind != FeatureKind::vertex_face && feature.kind != FeatureKind::edge_edge)
      return std::nullopt;
    return oracle::points_of(motion, feature);
  }

  // Returns whether the features, or the whole triangles if these are taken, meet at this time. A
  // feature is given as a triangle too, which may be a point or a segment.
  bool meet_at(const PairContact& contact, const oracle::StaticTime& time) const {
    if (takes_triangles && oracle::triangles_meet(motion, triangles, contact.pair, time))
      return true;
    if (!query_of(contact.feature)) return false;
    const auto& v = contact.feature.vertices;
    const std::size_t of_face = contact.feature.kind == FeatureKind::vertex_face ? 1 : 0;
    detector::Triangles two(2, 3);
    two << v[0], v[1 - of_face], v[1 - of_face], v[2 - of_face], v[3 - of_face], v[3];
    return oracle::triangles_meet(motion, two, {0, 1}, time);
  }
};

}  // namespace

bool is_confirmed(const corpus::Case& c, std::size_t s, const properties::StepDiff& diff,
                  const detector::StepResult& result, const properties::Contract& contract) {
  const auto step = corpus::steps_of(c)[s];
  const StepWitness witness{{start_of(c, step), end_of(c, step)},
                            c.triangles,
                            contract.features == properties::TestedFeatures::both};
  const auto answer_time = diff.answered_free ? std::nullopt : std::optional(result.first.lo);
  if (diff.answered_free || diff.late_first)
    return diff.first_contact && witness.meets_before(*diff.first_contact, answer_time);
  return std::any_of(diff.missing.begin(), diff.missing.end(), [&](const PairContact& pair) {
    return witness.meets_before(pair, std::nullopt);
  });
}

}  // namespace assay::reports
