#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>
#include <vector>

#include "oracle/referee/rational_bracket.h"
#include "oracle/referee/referee.h"
#include "oracle/referee/static_check.h"
#include "reports/bench/compared/comparison.h"

namespace assay::reports {
namespace {

using detector::FeatureKind;
using detector::PairContact;

// The time that lies this many eighths of the way from a double to the next, if 62 bits can hold
// it.
std::optional<oracle::RationalTime> between(double lo, double hi, int eighths) {
  constexpr int bits = 62;
  const double from = std::ldexp(lo, bits), way = std::ldexp(hi - lo, bits - 3);
  if (lo < 0x1p-7 || way != std::floor(way)) return std::nullopt;
  return oracle::RationalTime{
      static_cast<std::int64_t>(from) + eighths * static_cast<std::int64_t>(way),
      std::int64_t{1} << bits};
}

// The fraction with the least denominator between two neighbouring doubles of (0, 1). If the exact
// time is a fraction of small whole numbers, such as 1/3, this is it. It is computed by continued
// fractions in long doubles. If these do not suffice, the result is some other fraction, which
// then witnesses nothing.
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

class StepWitness {
 public:
  StepWitness(const corpus::Case& c, const corpus::CaseStep& step, bool takes_triangles)
      : c_(c), motion_{start_of(c, step), end_of(c, step)}, takes_triangles_(takes_triangles) {}

  // Whether the features of the contact, or its triangles, meet at some time before `told`. If no
  // time was told, whether they meet at all.
  bool meets_before(const PairContact& contact, std::optional<double> told) const {
    const double end = told.value_or(1), first = contact.time.hi;
    if (by_referee(contact.feature, told ? std::nextafter(end, 0.) : 1)) return true;
    std::vector<oracle::StaticTime> times = {contact.time.lo, first};
    for (const double share : {1. / 1024, 1. / 16, 1. / 2})
      times.emplace_back(first + (end - first) * share);
    if (!told) times.emplace_back(1.);
    if (contact.time.lo < contact.time.hi) {
      times.emplace_back(simplest_between(contact.time.lo, contact.time.hi));
      for (int eighth = 7; eighth > 0; --eighth) {
        if (const auto time = between(contact.time.lo, contact.time.hi, eighth))
          times.emplace_back(*time);
      }
    }
    const bool is_seen = std::any_of(times.begin(), times.end(), [&](const auto& time) {
      if (oracle::compare(time, 0) < 0 || oracle::compare(time, end) > 0) return false;
      if (told && oracle::compare(time, *told) >= 0) return false;
      return meet_at(contact, time);
    });
    return is_seen || by_bracket(contact.feature, std::nextafter(contact.time.lo, 0.), end);
  }

 private:
  detector::MovingPoint path(std::int32_t v) const { return motion_.path(v); }

  using Query = std::variant<detector::VertexFace, detector::EdgeEdge>;

  // Returns nothing for a contact of whole triangles.
  std::optional<Query> query_of(const detector::Feature& feature) const {
    const auto& v = feature.vertices;
    if (feature.kind == FeatureKind::vertex_face)
      return detector::VertexFace{path(v[0]), {path(v[1]), path(v[2]), path(v[3])}};
    if (feature.kind == FeatureKind::edge_edge)
      return detector::EdgeEdge{{path(v[0]), path(v[1])}, {path(v[2]), path(v[3])}};
    return std::nullopt;
  }

  // Whether the referee proves a contact of these features up to a time.
  bool by_referee(const detector::Feature& feature, double until) const {
    const auto query = query_of(feature);
    if (!query || until <= 0) return false;
    const oracle::RefereeOptions options{.until = until};
    return std::visit([&](const auto& q) { return oracle::referee(q, options); }, *query) ==
           detector::Decision::yes;
  }

  // Whether the bracket proves a contact of these features between two times.
  bool by_bracket(const detector::Feature& feature, double from, double until) const {
    const auto query = query_of(feature);
    if (!query || from < 0 || from >= until) return false;
    return std::visit([&](const auto& q) { return oracle::meet_between(q, from, until); }, *query);
  }

  // Asks whether the triangles meet at this time, if triangles are taken, or else whether the
  // features do. A feature is given as a triangle too, which may be a point or a segment.
  bool meet_at(const PairContact& contact, const oracle::StaticTime& time) const {
    if (takes_triangles_ && oracle::triangles_meet(motion_, c_.triangles, contact.pair, time))
      return true;
    const auto& v = contact.feature.vertices;
    detector::Triangles two(2, 3);
    if (contact.feature.kind == FeatureKind::vertex_face) {
      two << v[0], v[0], v[0], v[1], v[2], v[3];
    } else if (contact.feature.kind == FeatureKind::edge_edge) {
      two << v[0], v[1], v[1], v[2], v[3], v[3];
    } else {
      return false;
    }
    return oracle::triangles_meet(motion_, two, {0, 1}, time);
  }

  const corpus::Case& c_;
  const detector::SteppedMesh motion_;
  bool takes_triangles_;
};

}  // namespace

bool is_confirmed(const corpus::Case& c, std::size_t s, const properties::StepDiff& diff,
                  const detector::StepResult& result, const properties::Contract& contract) {
  const StepWitness witness(c, corpus::steps_of(c)[s],
                            contract.features == properties::TestedFeatures::both);
  if (diff.answered_free)
    return diff.first_contact && witness.meets_before(*diff.first_contact, std::nullopt);
  if (diff.late_first)
    return diff.first_contact && witness.meets_before(*diff.first_contact, result.first.lo);
  return std::any_of(diff.missing.begin(), diff.missing.end(), [&](const PairContact& pair) {
    return witness.meets_before(pair, std::nullopt);
  });
}

}  // namespace assay::reports
