#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "oracle/distance/feature_distance.h"
#include "oracle/referee/static_check.h"
#include "properties/queries/query_methods.h"

namespace assay::properties {

namespace {

using detector::Decision;
using detector::MovingPoint;
using detector::TimeEnclosure;
using detector::Want;

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
