#include "properties/queries/query_methods.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "detector/contact/elementary.h"
#include "detector/contact/rungs.h"
#include "detector/distance/nearness.h"
#include "oracle/distance/feature_distance.h"
#include "oracle/referee/referee.h"

namespace assay::properties {
namespace {

using detector::Arithmetic;
using detector::Decision;
using detector::Want;

template <class Rung>
MethodAnswer answer_of(bool is_met, const detector::TimeEnclosure& first, Rung rung, Want want) {
  MethodAnswer answer{is_met ? Decision::yes : Decision::no, {}, static_cast<int>(rung)};
  if (is_met && want == Want::first_time) answer.first = first;
  return answer;
}

MethodAnswer oracle_yes_no(const AskedQuery& asked) { return oracle_answer(asked, Want::yes_no); }

MethodAnswer algebraic_kernel(const AskedQuery& asked) {
  const auto first = oracle::first_time_by_kernel(asked.query);
  return {first ? Decision::yes : Decision::no, first};
}

template <Arithmetic arithmetic, Want want = Want::yes_no>
MethodAnswer by_detector(const AskedQuery& asked) {
  const double d = asked.within ? asked.within->first : 0;
  const auto answer = d == 0 ? detector::test_contact(asked.query, want, arithmetic)
                             : detector::test_near(asked.query, d, want);
  return answer_of(answer.contact, answer.time, answer.rung, want);
}

MethodAnswer detector_integers(const AskedQuery& asked) {
  const auto answer = detector::exact_contact(asked.query);
  return answer_of(answer.contact, answer.time, answer.rung, Want::first_time);
}

oracle::DistanceVerdict ask_distance_referee(const AskedQuery& asked,
                                             const oracle::DistanceRefereeOptions& options) {
  const auto& x = asked.query.points;
  if (asked.query.first_group == 2)
    return oracle::distance_referee(detector::EdgeEdge{{x[0], x[1]}, {x[2], x[3]}}, *asked.within,
                                    options);
  return oracle::distance_referee(detector::VertexFace{x[0], {x[1], x[2], x[3]}}, *asked.within,
                                  options);
}

// Of a distance no time is asked for, so that any bracket of it will do.
MethodAnswer referee(const AskedQuery& asked) {
  if (!asked.within) return {oracle::referee(asked.query)};
  return {ask_distance_referee(asked, {.bits = 0}).within};
}

// The limits are small, because a query that is not settled soon is mostly a touch, which no
// amount of work settles.
MethodAnswer second_referee(const AskedQuery& asked) {
  return {oracle::referee(asked.query, {60, 100})};
}

MethodAnswer distance_referee(const AskedQuery& asked) {
  const auto verdict = ask_distance_referee(asked, {});
  return {.decision = verdict.within, .proof = verdict};
}

// What comes within 0 is in contact.
MethodAnswer contact_at_no_distance(const AskedQuery& asked) {
  if (asked.within->first != -asked.within->second) return {};
  return oracle_answer({asked.query}, Want::first_time);
}

// The least distance is the least double that the features come within.
MethodAnswer least_distance(const AskedQuery& asked) {
  const double least = oracle::least_distance(asked.query);
  const auto is_within = [&](double distance) {
    return oracle::first_time_within(asked.query, {distance, 0}, Want::yes_no).near;
  };
  if (std::isfinite(least) && !is_within(least))
    throw std::logic_error("farther apart than the least distance");
  if (least > 0 && is_within(std::nextafter(least, 0.0)))
    throw std::logic_error("nearer than the least distance");
  // The sum is rounded, so only what lies beyond the rounding tells.
  const double sum = asked.within->first + asked.within->second;
  if (least > std::nextafter(sum, std::numeric_limits<double>::infinity())) return {Decision::no};
  if (std::isfinite(sum) && least < std::nextafter(sum, 0.0)) return {Decision::yes};
  return {};
}

constexpr QueryMethod methods[] = {
    {.name = "oracle, yes or no",
     .answer = oracle_yes_no,
     .checks = QueryChecks::contacts,
     .word = "oracle",
     .knows_distance = true,
     .rungs = {"axis", "interval", "quadratic", "", ""}},
    {.name = "referee",
     .answer = referee,
     .is_referee = true,
     .word = "referee",
     .knows_distance = true},
    {"algebraic kernel", algebraic_kernel, QueryChecks::contacts},
    {.name = "detector, yes or no",
     .answer = by_detector<Arithmetic::exact>,
     .checks = QueryChecks::contacts,
     .word = "detector-exact",
     .knows_distance = true,
     .rungs = {"axis", "filter", "fixed", "unbounded", ""}},
    {"detector, timed", by_detector<Arithmetic::exact, Want::first_time>, QueryChecks::contacts},
    {"detector, integers alone", detector_integers, QueryChecks::contacts},
    {"second referee", second_referee, QueryChecks::contacts, 1, true},
    {.name = "bounded arithmetic",
     .answer = by_detector<Arithmetic::bounded>,
     .word = "detector-bounded",
     .rungs = {"axis", "filter", "", "", "open"},
     .claims = {Claim::free_sound}},
    {.name = "plain doubles",
     .answer = by_detector<Arithmetic::double_precision>,
     .word = "detector-double",
     .rungs = {"axis", "filter", "", "", ""},
     .claims = {}},
    {.name = "plain floats",
     .answer = by_detector<Arithmetic::single_precision>,
     .word = "detector-float",
     .rungs = {"axis", "filter", "", "", ""},
     .claims = {}},
    {"distance referee", distance_referee, QueryChecks::distances, 1, true},
    {"contact", contact_at_no_distance, QueryChecks::distances},
    {"least distance", least_distance, QueryChecks::distances, 16},
};

}  // namespace

MethodAnswer oracle_answer(const AskedQuery& asked, Want want) {
  if (asked.within) {
    const auto answer = oracle::first_time_within(asked.query, *asked.within, want);
    return answer_of(answer.near, answer.first, answer.rung, want);
  }
  const auto answer = oracle::contact_of(asked.query, want);
  return answer_of(answer.contact, answer.first, answer.rung, want);
}

std::span<const QueryMethod> query_methods() { return methods; }
const QueryMethod* method_of(std::string_view word) {
  const auto found = std::ranges::find_if(
      methods, [&](const QueryMethod& method) { return method.word && method.word == word; });
  return found == std::end(methods) ? nullptr : found;
}

}  // namespace assay::properties
