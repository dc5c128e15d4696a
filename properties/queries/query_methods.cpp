#include "properties/queries/query_methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <stdexcept>

#include "detector/contact/elementary.h"
#include "detector/contact/rungs.h"
#include "detector/distance/nearness.h"
#include "oracle/distance/feature_distance.h"
#include "oracle/referee/referee.h"
#include "oracle/referee/static_check.h"

namespace assay::properties {
namespace {

using detector::Decision;

template <class Rung>
MethodAnswer answer_of(bool is_met, const TimeEnclosure& first, Rung rung, Want want) {
  MethodAnswer answer{is_met ? Decision::yes : Decision::no, {}, static_cast<int>(rung)};
  if (is_met && want == Want::first_time) answer.first = first;
  return answer;
}

MethodAnswer oracle_yes_no(const QueryTask& task) { return oracle_answer(task, Want::yes_no); }

MethodAnswer algebraic_kernel(const QueryTask& task) {
  const auto first = oracle::first_time_by_kernel(task.query);
  return {first ? Decision::yes : Decision::no, first};
}

template <Arithmetic arithmetic, Want want = Want::yes_no>
MethodAnswer by_detector(const QueryTask& task) {
  const double d = task.within ? task.within->first : 0;
  const auto answer = d == 0 ? detector::test_contact(task.query, want, arithmetic)
                             : detector::test_near(task.query, d, want);
  return answer_of(answer.contact, answer.time, answer.rung, want);
}

MethodAnswer detector_integers(const QueryTask& task) {
  const auto answer = detector::exact_contact(task.query);
  return answer_of(answer.contact, answer.time, answer.rung, Want::first_time);
}

// Asks the referee. For a distance no time is asked for, so any bracket of it will do.
MethodAnswer referee(const QueryTask& task) {
  if (!task.within) return {oracle::referee(task.query)};
  return {oracle::distance_referee(task.query, *task.within, {.bits = 0}).within};
}

// Asks the second referee, with small limits: a query that is not settled soon is mostly a touch,
// which no amount of work settles.
MethodAnswer second_referee(const QueryTask& task) {
  return {oracle::referee(task.query, {60, 100})};
}

MethodAnswer distance_referee(const QueryTask& task) {
  const auto verdict = oracle::distance_referee(task.query, *task.within);
  return {.decision = verdict.within, .proof = verdict};
}

// Asks for contact, because features that come within 0 are in contact.
MethodAnswer contact_at_no_distance(const QueryTask& task) {
  if (task.within->first != -task.within->second) return {};
  return oracle_answer({task.query}, Want::first_time);
}

// Asks for the least distance: the least double that the features come within.
MethodAnswer least_distance(const QueryTask& task) {
  const double least = oracle::least_distance(task.query);
  const auto is_within = [&](double distance) {
    return oracle::first_time_within(task.query, {distance, 0}, Want::yes_no).contact;
  };
  if (std::isfinite(least) && !is_within(least))
    throw std::logic_error("farther apart than the least distance");
  if (least > 0 && is_within(std::nextafter(least, 0.0)))
    throw std::logic_error("nearer than the least distance");
  // The sum is rounded, so only a least distance beyond the rounding tells.
  const double sum = task.within->first + task.within->second;
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

MethodAnswer oracle_answer(const QueryTask& task, Want want) {
  const auto answer = task.within ? oracle::first_time_within(task.query, *task.within, want)
                                  : oracle::contact_of(task.query, want);
  return answer_of(answer.contact, answer.first, answer.rung, want);
}

std::span<const QueryMethod> query_methods() { return methods; }
const QueryMethod* method_of(std::string_view word) {
  const auto place = std::ranges::find_if(
      methods, [&](const QueryMethod& method) { return method.word && method.word == word; });
  return place == std::end(methods) ? nullptr : place;
}

namespace {

using detector::Decision;

std::string text(const TimeEnclosure& t) { return fmt::format("[{:a}, {:a}]", t.lo, t.hi); }
std::string text(const oracle::RationalTime& t) {
  return fmt::format("{}/{}", t.numerator, t.denominator);
}

std::string text(const MethodAnswer& answer, const QueryTask& task) {
  const auto& proof = answer.proof;
  const std::string relation = task.within ? "near" : "contact";
  if (answer.decision == Decision::open)
    return proof ? "cannot tell, but not near up to " + text(proof->after) : "cannot tell";
  if (answer.decision == Decision::no) return task.within ? "never near" : "no contact";
  if (proof) return fmt::format("near in ({}, {}]", text(proof->after), text(proof->by));
  return answer.first ? relation + " at " + text(*answer.first) : relation;
}

// Returns whether the first time is 0, as the referee has proved.
bool is_at_start(const oracle::DistanceVerdict& proof) {
  return proof.within == Decision::yes && proof.by.numerator == 0;
}

// Returns whether the enclosed time, lo itself or one strictly between lo and hi, surely lies
// outside of the proved times.
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

std::optional<std::string> not_as_known(const QueryTask& task) {
  const auto& truth = task.truth;
  if (!truth) return {};
  for (const auto want : {Want::yes_no, Want::first_time}) {
    const auto answer = oracle_answer(task, want);
    if (answer.decision != truth->decision || (answer.first && answer.first != truth->first))
      return fmt::format("`{}`: the answer or the time is wrong", task.name);
    const auto name_of = [](int rung) {
      return method_of("oracle")->rungs[static_cast<std::size_t>(rung)];
    };
    if (answer.rung != truth->rung)
      return fmt::format("`{}`: rung {} decided, but rung {} must", task.name, name_of(answer.rung),
                         name_of(truth->rung));
  }
  return {};
}

std::optional<std::string> first_contradiction(const QueryTask& task, std::uint64_t pick,
                                               QueryTally& tally,
                                               std::span<const QueryMethod> methods) {
  const MethodAnswer of_oracle = oracle_answer(task, Want::first_time);
  tally.contacts += of_oracle.decision == Decision::yes ? 1 : 0;
  tally.rungs.add(static_cast<oracle::Rung>(of_oracle.rung));
  const auto oracle_text = [&] {
    return "oracle: " + text(of_oracle, task) +
           (task.met_at ? fmt::format("; made to meet at {:a}", *task.met_at) : "");
  };
  if (contradicts(of_oracle, of_oracle, task)) return oracle_text();
  const auto checks = task.within ? QueryChecks::distances : QueryChecks::contacts;
  bool open = false;
  for (const QueryMethod& method : methods) {
    if (method.checks != checks || pick % static_cast<std::uint64_t>(method.one_in) != 0) continue;
    const MethodAnswer answer = method.answer(task);
    open = open || (method.is_referee && answer.decision == Decision::open);
    if (contradicts(answer, of_oracle, task))
      return fmt::format("{}: {}; {}", method.name, text(answer, task), oracle_text());
  }
  tally.open += open ? 1 : 0;
  return not_as_known(task);
}

}  // namespace

bool contradicts(const MethodAnswer& answer, const MethodAnswer& of_oracle, const QueryTask& task) {
  const bool are_decided =
      answer.decision != Decision::open && of_oracle.decision != Decision::open;
  return (are_decided && answer.decision != of_oracle.decision) ||
         (answer.first && of_oracle.first && answer.first != of_oracle.first) ||
         (answer.proof && of_oracle.first && is_outside(*of_oracle.first, *answer.proof)) ||
         (task.met_at && misses(answer, *task.met_at));
}

std::optional<std::string> check_query(const QueryTask& task, std::uint64_t pick, QueryTally& tally,
                                       std::span<const QueryMethod> methods) {
  ++tally.queries;
  std::optional<std::string> wrong;
  try {
    wrong = first_contradiction(task, pick, tally, methods);
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

std::string exact_text(const QueryTask& task) {
  std::string out = task.name.empty() ? "" : task.name + "\n";
  if (const auto& d = task.within)
    out += fmt::format("distance {:a} + {:a}\n", d->first, d->second);
  out += task.query.first_group == 1 ? "vertex-face: vertex, then three corners\n"
                                     : "edge-edge: the ends of one edge, then of the other\n";
  for (const auto& path : task.query.points) out += "  " + exact_text(path) + "\n";
  return out;
}

std::string answers_text(const QueryTask& task) {
  const auto of_oracle = text(oracle_answer(task, Want::first_time), task);
  if (task.within)
    return fmt::format("oracle: {}\nleast distance: {:a}\n", of_oracle,
                       oracle::least_distance(task.query));
  std::string out = fmt::format("oracle, timed: {}\n", of_oracle);
  for (const QueryMethod& method : query_methods()) {
    if (method.checks == QueryChecks::contacts)
      out += fmt::format("{}: {}\n", method.name, text(method.answer(task), task));
  }
  return out;
}

}  // namespace assay::properties
