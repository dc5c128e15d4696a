#include "properties/judging/contracted_case.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "oracle/distance/feature_distance.h"
#include "properties/changes/changes.h"
#include "properties/judging/agreement.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {

namespace {

// Returns a pair of triangles that is too near for the contract when a step starts with the mesh at
// x. Only pairs that count, and that the detector tests, are looked at.
std::optional<TrianglePair> pair_too_near(const PositionsView& x, const Case& c,
                                          const Contract& contract) {
  const double distance = contract.start == StartRule::apart ? contract.start_distance : 0;
  const auto own = tested_pairs(contract, c.frames.front());
  return oracle::any_nearer_than(x, c.triangles, distance,
                                 counted_under(contract, c.triangles, {&own, counted_of(c)}));
}

// Makes the relation one that the detector can see: as coarse as its coordinates. If the detector
// takes no relation, every pair counts, and only the bodies are left, because they name triangles.
// Returns whether this is possible.
bool contract_relation(Case& c, const Contract& contract) {
  if (c.counted && !contract.takes_relations) {
    CountedPairs names;
    names.body = std::move(c.counted->pairs.body);
    c.counted.reset();
    if (!names.body.empty()) c.counted.emplace(corpus::CaseRelation{std::move(names), {}});
  }
  if (!c.counted || contract.coordinates == Coordinates::float64) return true;
  auto& [pairs, steps] = *c.counted;
  const auto all = pairs;
  const auto round = [](double& x) { return std::isfinite(x = static_cast<float>(x)); };
  bool is_finite = round(pairs.rest_distance);
  for (auto& place : pairs.rest) {
    for (double& x : place) is_finite = round(x) && is_finite;
  }
  if (pairs != all) steps.clear();
  return is_finite;
}

// Returns why the contract does not take the mesh at these places, which are rounded already; empty
// if it does.
std::string why_no_frame(const PositionsView& x, const std::vector<Edge>& edges,
                         const Contract& contract) {
  if (!x.allFinite()) return "a coordinate is beyond float32";
  return beyond_range(x, edges, contract);
}

// Returns the exact end of a displacement; nothing if it is no double.
std::optional<Positions> exact_end(const Positions& x, const Positions& to) {
  const Positions way = displacement(x, to), end = x + way;
  // If the sum is rounded, it does not give back both parts when the other part is subtracted.
  if (!end.allFinite() || end - x != way || end - way != x) return std::nullopt;
  return end;
}

// Gives each step a start and an end of its own: the end is the exact sum of the start and of the
// displacement that leads nearest to the end in `original`. Steps whose sum is no double, or is
// beyond the contract's range, are left out. Returns false if all are. A mesh at rest stays the
// first frame, if the contract depends on it.
bool hold_displacements(Case& c, Case original, const Contract& contract) {
  std::vector<std::size_t> exact;
  auto steps = steps_of(c);
  for (std::size_t s = 0; s < steps.size(); ++s) {
    const auto end = exact_end(start_of(c, steps[s]), end_of(original, steps[s]));
    if (end && beyond_range(*end, edges_of(c), contract).empty()) exact.push_back(s);
  }
  if (exact.empty()) return false;
  if (exact.size() < steps.size()) {
    c = with_steps(c, exact, contract);
    original = with_steps(original, exact, contract);
    steps = steps_of(c);
  }
  std::vector<Positions> frames;
  std::vector<CaseStep> script;
  if (contract.rest_distance > 0) frames.push_back(c.frames.front());
  for (const auto& step : steps) {
    const auto& x = start_of(c, step);
    const auto place = static_cast<std::int32_t>(frames.size());
    script.push_back({place, place + 1, step.commit});
    frames.push_back(x);
    frames.push_back(*exact_end(x, end_of(original, step)));
  }
  if (frames == c.frames && script == steps) return true;
  c.frames = std::move(frames);
  c.script = std::move(script);
  if (c.script == corpus::consecutive_steps(c.frames.size())) c.script.clear();
  c.view.reset();
  c.ghosts.reset();
  if (c.expected.answer != Answer::error) c.expected = {};
  return true;
}

// Returns whether a caller can stop at x_t0 + share (x_t1 - x_t0): each x_t1 - x_t0 is a number of
// the contract's coordinates.
bool ways_are_finite(const Case& c, const Contract& contract) {
  const auto steps = steps_of(c);
  return std::ranges::all_of(steps, [&](const CaseStep& step) {
    const Positions way = end_of(c, step) - start_of(c, step);
    return contract.coordinates == Coordinates::float32 ? way.cast<float>().allFinite()
                                                        : way.allFinite();
  });
}

}  // namespace

Case with_steps(const Case& c, const std::vector<std::size_t>& places, const Contract& contract) {
  const auto steps = steps_of(c);
  Case out = c;
  out.expected.steps.clear();
  if (out.expected.answer != Answer::error) out.expected.answer.reset();
  if (out.counted) out.counted->steps.clear();
  Numbers frames;
  std::vector<CaseStep> script;
  if (contract.rest_distance > 0) frames.push_back(0);
  for (const std::size_t place : places) {
    script.push_back(steps[place]);
    frames.insert(frames.end(), {steps[place].from, steps[place].to});
    if (place < c.expected.steps.size()) out.expected.steps.push_back(c.expected.steps[place]);
    if (c.counted && place < c.counted->steps.size())
      out.counted->steps.push_back(c.counted->steps[place]);
  }
  take_frames(out, frames, std::move(script));
  return out;
}

double extent_of(const Case& c) {
  const auto& x = c.frames.front();
  return x.rows() == 0 ? 0 : (x.colwise().maxCoeff() - x.colwise().minCoeff()).maxCoeff();
}

std::vector<Edge> edges_of(const Case& c) {
  if (const auto query = says_query(c) ? query_of(c) : std::nullopt) {
    if (query->first_group == 1) return {{1, 2}, {2, 3}, {3, 1}};
    return {{0, 1}, {2, 3}};
  }
  std::vector<Edge> edges;
  for (Eigen::Index t = 0; t < c.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) edges.push_back({c.triangles(t, k), c.triangles(t, (k + 1) % 3)});
  }
  return edges;
}

std::optional<Case> contract_case(const Case& c, const Contract& contract) {
  Case out = c;
  const auto edges = edges_of(c);
  if (!contract_relation(out, contract)) return std::nullopt;
  for (auto& frame : out.frames) {
    Positions positions = round_to(frame, contract.coordinates);
    // Facts about other coordinates need not hold for these.
    if (positions != frame && out.expected.answer != Answer::error) {
      out.expected = {};
      if (out.counted) out.counted->steps.clear();
    }
    frame = std::move(positions);
    if (!why_no_frame(frame, edges, contract).empty()) return std::nullopt;
  }
  if (contract.motion == MotionGiven::displacement && !hold_displacements(out, c, contract))
    return std::nullopt;
  if (contract.limit_gives == LimitGives::start_plus && !ways_are_finite(out, contract))
    return std::nullopt;
  if (says_query(out)) {
    const auto query = query_of(out);
    return query && takes(contract, *query) ? std::optional(out) : std::nullopt;
  }
  if (contract.start == StartRule::any) return out;
  const auto steps = steps_of(out);
  std::map<std::int32_t, bool> may_start;  // by frame
  std::vector<std::size_t> places;
  for (std::size_t s = 0; s < steps.size(); ++s) {
    const auto [entry, is_new] = may_start.try_emplace(steps[s].from, false);
    if (is_new) entry->second = !pair_too_near(start_of(out, steps[s]), out, contract).has_value();
    if (entry->second) places.push_back(s);
  }
  if (places.empty()) return std::nullopt;
  if (places.size() == steps.size()) return out;
  return with_steps(out, places, contract);
}

std::string why_left_out(const Case& c, const Contract& contract) {
  const auto edges = edges_of(c);
  std::size_t number = 0;
  for (const auto& frame : c.frames) {
    ++number;
    const auto why = why_no_frame(round_to(frame, contract.coordinates), edges, contract);
    if (!why.empty()) return fmt::format("frame {} of {}: {}", number, c.frames.size(), why);
  }
  const std::string distance = contract.start == StartRule::apart
                                   ? fmt::format("nearer than {}", contract.start_distance)
                                   : "in contact";
  const std::string start = contract.start == StartRule::apart ? "apart" : "free";
  if (says_query(c)) {
    const auto query = query_of(c);
    if (!query) return "its options call it a query, but its mesh is not that of a query";
    Contract of_any_start = contract;
    of_any_start.start = StartRule::any;
    if (!takes(of_any_start, *query))
      return fmt::format("features {}: this query is {}", name_of(contract.features),
                         query_word(*query));
    return fmt::format("start {}: the two features start {}", start, distance);
  }
  const auto steps = steps_of(c);
  const auto x = round_to(start_of(c, steps.front()), contract.coordinates);
  Case contracted_case = c;
  for (auto& frame : contracted_case.frames) frame = round_to(frame, contract.coordinates);
  if (Case displaced = contracted_case;
      contract.motion == MotionGiven::displacement && !hold_displacements(displaced, c, contract))
    return "motion displacement: in every step, an exact end is no double, or beyond the range";
  if (contract.limit_gives == LimitGives::start_plus && !ways_are_finite(contracted_case, contract))
    return "stops at start-plus: a vertex moves farther than the largest number";
  if (!contract_relation(contracted_case, contract)) return "a rest position is beyond float32";
  const auto pair = pair_too_near(x, contracted_case, contract);
  if (!pair) return "";
  return fmt::format(
      "start {}: triangles {} and {} are {} where {}", start, pair->a, pair->b, distance,
      steps.size() > 1 ? "step 1 starts; no other step is taken" : "the step starts");
}

bool start_apart(const FourPoints& q, double distance) {
  // Two triangles of the two features. Where a feature is a point or a segment, so is its triangle.
  // The triangles are then as near to each other as the features.
  const bool is_vertex_face = q.first_group == 1;
  const std::array<std::size_t, 6> corners = is_vertex_face
                                                 ? std::array<std::size_t, 6>{0, 0, 0, 1, 2, 3}
                                                 : std::array<std::size_t, 6>{0, 1, 1, 2, 3, 3};
  std::vector<Point> x;
  for (const auto corner : corners) x.push_back(q.points[corner].t0);
  const Triangles triangles{{0, 1, 2}, {3, 4, 5}};
  return !oracle::any_nearer_than(as_rows<Positions>(x), triangles, distance,
                                  [](std::int32_t, std::int32_t) { return true; });
}

StepJudgement judge_query(const FourPoints& query, const Contract& contract) {
  StepJudgement judgement;
  judgement.complete = true;
  judgement.feature_candidates = 1;
  // The two features as a pair, if they meet.
  const auto pairs_of = [&](const oracle::ContactAnswer& answer) {
    std::vector<detector::PairContact> pairs;
    if (answer.contact) pairs.push_back({{0, 1}, answer.first, features_of(query)});
    return pairs;
  };
  const auto answer = contract.separation > 0
                          ? oracle::first_time_within(query, {contract.separation, 0})
                          : oracle::contact_of(query, detector::Want::first_time);
  judgement.rungs.add(answer.rung);
  judgement.pairs = pairs_of(answer);
  if (contract.margin > 0)
    judgement.within_slack =
        pairs_of(oracle::first_time_within(query, {contract.separation, contract.margin}));
  judgement.asked_pairs = judgement.pairs;
  judgement.answer = judgement.pairs.empty() ? Answer::free : Answer::collision;
  if (!judgement.pairs.empty()) judgement.first = judgement.pairs.front().time;
  return judgement;
}

bool takes(const Contract& contract, const FourPoints& query) {
  const bool is_vertex_face = query.first_group == 1;
  if (contract.features == TestedFeatures::vertex_face && !is_vertex_face) return false;
  if (contract.features == TestedFeatures::edge_edge && is_vertex_face) return false;
  if (contract.start == StartRule::any) return true;
  return start_apart(query, contract.start == StartRule::apart ? contract.start_distance : 0);
}

Contract on_queries(const Contract& contract) {
  Contract own = contract;
  own.adjacency = Adjacency::all;
  own.rings = 0;
  own.rest_distance = 0;
  return own;
}

}  // namespace assay::properties
