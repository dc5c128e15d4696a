#include "properties/queries/query_methods.h"

#include "detector/contact/contact_exact.h"
#include "detector/contact/elementary.h"
#include "detector/distance/nearness.h"
#include "oracle/distance/feature_distance.h"
#include "oracle/referee/referee.h"
#include "properties/queries/distance_queries.h"

namespace assay::properties {
namespace {

using detector::Arithmetic;
using detector::Want;

detector::Decision decision(bool contact) {
  return contact ? detector::Decision::yes : detector::Decision::no;
}

// The answer with its time, if there is a contact.
MethodAnswer timed(bool contact, const detector::TimeEnclosure& time) {
  if (!contact) return {detector::Decision::no, {}};
  return {detector::Decision::yes, time};
}

MethodAnswer oracle_yes_no(const Query& query) {
  const auto answer = oracle::contact_of(query, Want::yes_no);
  return {decision(answer.contact), {}, static_cast<int>(answer.rung)};
}

MethodAnswer algebraic_kernel(const Query& query) {
  const auto first = oracle::first_time_by_kernel(query);
  return {decision(first.has_value()), first};
}

template <Arithmetic arithmetic>
MethodAnswer detector_yes_no(const Query& query) {
  const auto answer = detector::test_contact(query, Want::yes_no, arithmetic);
  return {decision(answer.contact), {}, static_cast<int>(answer.rung)};
}

MethodAnswer detector_timed(const Query& query) {
  const auto answer = detector::test_contact(query, Want::first_time);
  return timed(answer.contact, answer.time);
}

MethodAnswer detector_integers(const Query& query) {
  const auto answer = detector::exact_contact(query);
  return timed(answer.contact, answer.time);
}

MethodAnswer referee(const Query& query) { return {oracle::referee(query), {}}; }

// The limits are small, because a query that is not settled soon is mostly a touch, which no
// amount of work settles.
MethodAnswer second_referee(const Query& query) { return {oracle::referee(query, {60, 100}), {}}; }

MethodAnswer oracle_within(const Query& query, double d) {
  const auto answer = oracle::first_time_within(query, {d, 0}, Want::yes_no);
  return {decision(answer.near), {}, static_cast<int>(answer.rung)};
}

// No time is asked for, so that any bracket of it will do.
MethodAnswer referee_within(const Query& query, double d) {
  return {ask_distance_referee({query, {d, 0}, {}}, {.bits = 0}).within, {}};
}

MethodAnswer detector_within(const Query& query, double d) {
  if (d == 0) return detector_yes_no<Arithmetic::exact>(query);
  const auto answer = detector::test_near(query, d, Want::yes_no);
  return {decision(answer.contact), {}, static_cast<int>(answer.rung)};
}

constexpr QueryMethod methods[] = {
    {"oracle, yes or no", oracle_yes_no},
    {"algebraic kernel", algebraic_kernel},
    {"detector, yes or no", detector_yes_no<Arithmetic::exact>},
    {"detector, timed", detector_timed},
    {"detector, integers alone", detector_integers},
    {"second referee", second_referee},
};

constexpr QueryMethod named[] = {
    {.name = "oracle",
     .answer = oracle_yes_no,
     .rungs = {"axis", "interval", "quadratic", "", ""},
     .within = oracle_within},
    {.name = "referee", .answer = referee, .is_referee = true, .within = referee_within},
    {.name = "detector-exact",
     .answer = detector_yes_no<Arithmetic::exact>,
     .rungs = {"axis", "filter", "fixed", "unbounded", ""},
     .within = detector_within},
    {"detector-bounded",
     detector_yes_no<Arithmetic::bounded>,
     {"axis", "filter", "", "", "open"},
     {Claim::free_sound}},
    {"detector-double",
     detector_yes_no<Arithmetic::double_precision>,
     {"axis", "filter", "", "", ""},
     {}},
    {"detector-float",
     detector_yes_no<Arithmetic::single_precision>,
     {"axis", "filter", "", "", ""},
     {}},
};

}  // namespace

std::span<const QueryMethod> query_methods() { return methods; }

std::span<const QueryMethod> named_methods() { return named; }
const QueryMethod& oracle_method() { return named[0]; }
const QueryMethod& detector_method() { return named[2]; }

}  // namespace assay::properties
