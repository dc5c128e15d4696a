#include "properties/vectors/methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "oracle/distance/feature_distance.h"
#include "oracle/mesh/step.h"
#include "oracle/referee/second_opinion.h"
#include "properties/judging/case_check.h"
#include "properties/queries/distance_checks.h"
#include "properties/queries/query_checks.h"
#include "properties/threads.h"
#include "properties/vectors/mesh_facts.h"
#include "properties/vectors/query_facts.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {
namespace {

using detector::FourPoints;

constexpr const char* referee_name = "referee";

// What the methods say of one case.
struct MethodsSay {
  bool referee_is_open = false;
  std::optional<std::string> contradiction;
};

MethodsSay ask_of_contact(const FourPoints& query, std::string_view id) {
  QueryTally tally;
  MethodsSay say;
  say.contradiction = check_query({query, {}}, Random::hash(id), tally);
  say.referee_is_open = tally.open > 0;
  return say;
}

DistanceAnswer distance_by_oracle(const DistanceQuery& query) {
  const auto answer = oracle::first_time_within(query.motion, query.distance);
  return {answer.near, answer.first};
}

MethodsSay ask_of_distance(const FourPoints& query, double d) {
  DistanceTally tally;
  MethodsSay say;
  say.contradiction = check_distance({query, {d, 0}, {}}, distance_by_oracle, tally);
  say.referee_is_open = tally.open > 0;
  return say;
}

// With the facts as those that are expected, so that the detector is held to them.
MethodsSay ask_of_mesh(const Vector& v) {
  MethodsSay say;
  corpus::Case c = v.c;
  const auto steps = corpus::steps_of(c);
  for (std::size_t s = 0; s < steps.size(); ++s) {
    const auto& facts = v.steps[s];
    corpus::ExpectedStep expected;
    expected.answer =
        facts.result == VectorResult::free ? detector::Answer::free : detector::Answer::collision;
    expected.first_time = facts.first;
    expected.pairs = facts.pairs;
    c.expected.steps.push_back(expected);
    if (facts.result != VectorResult::free) c.expected.answer = detector::Answer::collision;

    const detector::SteppedMesh motion{start_of(c, steps[s]), end_of(c, steps[s])};
    const auto judgement = oracle::judge_step(motion, c.triangles, {});
    const auto second = oracle::second_opinion(motion, c.triangles, judgement, {});
    say.referee_is_open = say.referee_is_open || second.open > 0;
    if (!second.contradictions.empty())
      say.contradiction = fmt::format("step {}: the referee contradicts the oracle", s + 1);
  }
  if (!c.expected.answer) c.expected.answer = detector::Answer::free;
  const auto checked = check_case(c);
  if (!checked.failed.empty()) say.contradiction = checked.failed.front();
  return say;
}

MethodsSay ask_methods(const Vector& v) {
  const auto query = query_of(v.c);
  if (!query) return ask_of_mesh(v);
  return v.question == VectorQuestion::distance ? ask_of_distance(*query, v.distance)
                                                : ask_of_contact(*query, v.c.id);
}

// What the case states and is not so.
std::optional<std::string> wrong_fact(const Vector& v, const VectorGroup& group) {
  const auto made = query_of(v.c) ? query_vector(v.c, v.distance, group.precision)
                                  : mesh_vector(v.c, v.question, group.precision);
  if (!made) return "is no question about a limit";
  Vector again = *made;
  if (v.has(VectorFlag::split_invariant)) {
    again.flags.push_back(VectorFlag::split_invariant);
    std::sort(again.flags.begin(), again.flags.end());
  }
  for (std::size_t s = 0; s < v.steps.size(); ++s) {
    const auto& told = v.steps[s];
    auto& found = again.steps[s];
    // Pairs that are not stated are not wrong.
    if (!told.pairs) found.pairs.reset();
    if (told.pairs && !found.pairs) found.pairs.emplace();
    if (told == found) continue;
    const auto time = [](const VectorFacts& facts) {
      return facts.first ? fmt::format("[{}, {}]", facts.first->lo, facts.first->hi) : "none";
    };
    const auto pairs = [](const VectorFacts& facts) {
      return facts.pairs ? facts.pairs->size() : 0;
    };
    return fmt::format("step {}: states {}, first time {}, {} pairs; is {}, {}, {}{}", s + 1,
                       name_of(told.result), time(told), pairs(told), name_of(found.result),
                       time(found), pairs(found),
                       told.polynomial != found.polynomial ? "; another polynomial" : "");
  }
  if (v.flags != again.flags) return "states other flags than it has";
  if (v.hard != again.hard) return "states another hardness than it has";
  return std::nullopt;
}

// What is wrong with the halves of a step: one is missing, they are not its halves, or the whole
// has a contact and no half has one, or the other way round.
std::optional<std::string> wrong_halves(const Vector& whole, const VectorGroup& group) {
  std::vector<const Vector*> halves;
  for (const auto& v : group.cases) {
    if (v.split_of == whole.c.id) halves.push_back(&v);
  }
  const bool is_split = whole.has(VectorFlag::split_invariant) && whole.split_of.empty();
  if (!is_split) return halves.empty() ? std::nullopt : std::optional("has halves unsaid");
  if (halves.size() != 2) return "has not two halves";
  const auto &first = halves[0]->c.frames, &second = halves[1]->c.frames;
  if (first[0] != whole.c.frames[0] || first[1] != second[0] || second[1] != whole.c.frames[1] ||
      first[1] - first[0] != second[1] - second[0])
    return "its halves are none";
  const auto meets = [](const Vector& v) { return v.result() != VectorResult::free; };
  if (meets(whole) != (meets(*halves[0]) || meets(*halves[1])))
    return "another result whole than in halves";
  return std::nullopt;
}

std::vector<std::pair<VectorGroup*, Vector*>> cases_of(VectorSet& set) {
  std::vector<std::pair<VectorGroup*, Vector*>> cases;
  for (auto& group : set.groups) {
    for (auto& v : group.cases) cases.emplace_back(&group, &v);
  }
  return cases;
}

}  // namespace

void say_open_methods(VectorSet& set, int jobs) {
  const auto cases = cases_of(set);
  for_each_in_threads(cases.size(), jobs, [&](std::size_t i) {
    auto& v = *cases[i].second;
    v.open.clear();
    if (ask_methods(v).referee_is_open) v.open.push_back(referee_name);
  });
}

std::vector<VectorContradiction> contradictions_of(const VectorSet& set, int jobs) {
  VectorSet copy = set;
  const auto cases = cases_of(copy);
  std::vector<std::optional<std::string>> wrong(cases.size());
  for_each_in_threads(cases.size(), jobs, [&](std::size_t i) {
    const auto& [group, v] = cases[i];
    wrong[i] = wrong_fact(*v, *group);
    if (!wrong[i]) wrong[i] = wrong_halves(*v, *group);
    if (wrong[i]) return;
    const auto say = ask_methods(*v);
    wrong[i] = say.contradiction;
    if (!wrong[i] && say.referee_is_open != !v->open.empty())
      wrong[i] = "states wrongly whether a method stays open";
  });
  std::vector<VectorContradiction> contradictions;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (wrong[i]) contradictions.push_back({cases[i].second->c.id, *wrong[i]});
  }
  return contradictions;
}

FourPoints neighbour_of(FourPoints query, VectorPrecision precision, Random& random) {
  const bool is_float = precision == VectorPrecision::float32;
  for (int changes = random.between(1, 3); changes > 0; --changes) {
    auto& point = query.points[static_cast<std::size_t>(random.below(4))];
    double& x = (random.one_in(2) ? point.t0 : point.t1)[static_cast<std::size_t>(random.below(3))];
    const bool is_up = random.one_in(2);
    const double towards = is_up ? INFINITY : -INFINITY;
    const double moved = is_float ? static_cast<double>(std::nextafter(static_cast<float>(x),
                                                                       static_cast<float>(towards)))
                                  : std::nextafter(x, towards);
    if (std::isfinite(moved)) x = moved;
  }
  return query;
}

NeighbourTally check_neighbours(const VectorSet& set, std::uint64_t count, int jobs) {
  struct Asked {
    FourPoints query;
    double distance;
    VectorPrecision precision;
    std::string id;
  };
  std::vector<Asked> asked;
  for (const auto& group : set.groups) {
    for (const auto& v : group.cases) {
      if (const auto query = query_of(v.c))
        asked.push_back({*query, v.distance, group.precision, v.c.id});
    }
  }
  NeighbourTally tally;
  if (asked.empty()) return tally;
  std::mutex mutex;
  for_each_in_threads(count, jobs, [&](std::size_t i) {
    const auto& one = asked[i % asked.size()];
    const auto id = fmt::format("{}:{}", one.id, i / asked.size());
    Random random(id);
    const auto query = neighbour_of(one.query, one.precision, random);
    const auto say =
        one.distance > 0 ? ask_of_distance(query, one.distance) : ask_of_contact(query, id);
    const std::lock_guard lock(mutex);
    ++tally.queries;
    tally.open += say.referee_is_open ? 1 : 0;
    if (say.contradiction) tally.contradictions.push_back({"neighbour " + id, *say.contradiction});
  });
  std::sort(tally.contradictions.begin(), tally.contradictions.end(),
            [](const auto& a, const auto& b) { return a.id < b.id; });
  return tally;
}

}  // namespace assay::properties
