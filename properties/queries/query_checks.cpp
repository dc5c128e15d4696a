#include "properties/queries/query_checks.h"

#include <fmt/format.h>

#include <exception>

#include "properties/queries/query_invariances.h"

namespace assay::properties {
namespace {

std::string text(const detector::TimeEnclosure& t) {
  return fmt::format("[{:a}, {:a}]", t.lo, t.hi);
}

std::string text(const MethodAnswer& answer) {
  if (answer.decision == detector::Decision::open) return "cannot tell";
  if (answer.decision == detector::Decision::no) return "no contact";
  return answer.first ? "contact at " + text(*answer.first) : "contact";
}

MethodAnswer as_method(const oracle::ContactAnswer& answer) {
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
  const auto timed = ask_oracle(query, detector::Want::first_time);
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
  const auto laws = invariances();
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const Invariance& law = laws[(pick + i) % laws.size()];
    const auto broken = law.broken(query, timed, pick / laws.size());
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
                                text(as_method(ask_oracle(query, detector::Want::first_time))));
  for (const QueryMethod& method : query_methods()) {
    out += fmt::format("{}: {}\n", method.name, text(method.answer(query)));
  }
  return out;
}

}  // namespace assay::properties
