#include "properties/vectors/mesh_facts.h"

#include <algorithm>
#include <set>

#include "oracle/mesh/loops.h"
#include "properties/judging/cause.h"
#include "properties/judging/judged_run.h"
#include "properties/reducer/case_edits.h"
#include "properties/search/focus.h"
#include "properties/search/gap.h"
#include "properties/vectors/query_facts.h"

namespace assay::properties {
namespace {

using detector::FeatureKind;
using detector::FourPoints;
using detector::PairContact;
using oracle::StepJudgement;

FourPoints query_of_vertices(const detector::SteppedMesh& motion, const std::int32_t* vertices,
                             int first_group) {
  FourPoints query;
  query.first_group = first_group;
  for (std::size_t i = 0; i < 4; ++i) query.points[i] = motion.path(vertices[i]);
  return query;
}

// Whether all features of two triangles that share no vertex touch at most.
bool pair_only_touches(const corpus::Case& c, const detector::SteppedMesh& motion,
                       const PairContact& contact) {
  if (contact.feature.kind == FeatureKind::piercing) return false;
  if (contact.feature.kind == FeatureKind::same_vertices) return true;
  const auto corner = [&](std::int32_t t, int k) { return c.triangles(t, k % 3); };
  const auto passes = [&](const std::array<std::int32_t, 4>& vertices, int first_group) {
    const std::set<std::int32_t> distinct(vertices.begin(), vertices.end());
    if (distinct.size() < 4) return false;
    const auto query = query_of_vertices(motion, vertices.data(), first_group);
    return contact_facts(query).result == VectorResult::collision;
  };
  const auto [a, b] = contact.pair;
  for (int i = 0; i < 3; ++i) {
    if (passes({corner(a, i), corner(b, 0), corner(b, 1), corner(b, 2)}, 1)) return false;
    if (passes({corner(b, i), corner(a, 0), corner(a, 1), corner(a, 2)}, 1)) return false;
    for (int j = 0; j < 3; ++j) {
      if (passes({corner(a, i), corner(a, i + 1), corner(b, j), corner(b, j + 1)}, 2)) return false;
    }
  }
  return true;
}

const PairContact& first_of(const StepJudgement& judgement) {
  return *std::min_element(judgement.pairs.begin(), judgement.pairs.end(),
                           [](const auto& a, const auto& b) { return a.time < b.time; });
}

VectorFacts facts_of(const corpus::Case& c, const detector::SteppedMesh& motion,
                     const StepJudgement& judgement) {
  VectorFacts facts;
  if (judgement.pairs.empty()) return facts;
  const bool touches =
      std::all_of(judgement.pairs.begin(), judgement.pairs.end(),
                  [&](const auto& contact) { return pair_only_touches(c, motion, contact); });
  facts.result = touches ? VectorResult::acceptable : VectorResult::collision;
  facts.first = judgement.first;
  auto& pairs = facts.pairs.emplace();
  for (const auto& contact : judgement.pairs) pairs.push_back({contact.pair, contact.time});
  facts.polynomial = {"0", "1"};
  const auto& feature = first_of(judgement).feature;
  if (judgement.first.hi > 0) {
    const int first_group = feature.kind == FeatureKind::vertex_face ? 1 : 2;
    facts.polynomial =
        contact_facts(query_of_vertices(motion, feature.vertices.data(), first_group)).polynomial;
  }
  return facts;
}

bool shares_a_vertex(const corpus::Case& c, detector::TrianglePair pair) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (c.triangles(pair.a, i) == c.triangles(pair.b, j)) return true;
    }
  }
  return false;
}

// Two triangles in the same places all the time.
bool has_duplicates(const corpus::Case& c) {
  std::set<std::vector<detector::Point>> places;
  for (Eigen::Index t = 0; t < c.triangles.rows(); ++t) {
    std::vector<detector::Point> of_one;
    for (const auto& frame : c.frames) {
      std::array<detector::Point, 3> corners;
      for (int k = 0; k < 3; ++k)
        corners[static_cast<std::size_t>(k)] = detector::point_of(frame, c.triangles(t, k));
      std::sort(corners.begin(), corners.end());
      of_one.insert(of_one.end(), corners.begin(), corners.end());
    }
    if (!places.insert(of_one).second) return true;
  }
  return false;
}

// Whether a step has no contact, and would have one if the holes of the mesh were closed.
bool goes_through_holes(const corpus::Case& c, std::span<const StepJudgement> truth) {
  if (oracle::unmatched_edges(c.triangles).empty()) return false;
  corpus::Case closed = close_loops(c, 0);
  if (!is_valid(closed)) return false;
  const auto judged = judge_case(closed);
  for (std::size_t s = 0; s < truth.size() && s < judged.size(); ++s) {
    if (truth[s].pairs.empty() && !judged[s].pairs.empty()) return true;
  }
  return false;
}

std::set<VectorFlag> mesh_flags(const corpus::Case& c, std::span<const StepJudgement> truth) {
  using enum VectorFlag;
  constexpr std::size_t many = 50;
  std::set<VectorFlag> flags;
  for (const auto& step : truth) {
    if (step.pairs.size() >= many) flags.insert(many_contacts);
    const bool shared = std::any_of(step.pairs.begin(), step.pairs.end(), [&](const auto& contact) {
      return shares_a_vertex(c, contact.pair);
    });
    if (shared) flags.insert(shared_vertex);
  }
  for (std::int32_t t = 0; t < c.triangles.rows(); ++t) {
    const bool is_flat = std::any_of(c.frames.begin(), c.frames.end(), [&](const auto& frame) {
      return has_no_area(c.triangles, t, frame);
    });
    if (is_flat) flags.insert(no_area);
  }
  if (has_duplicates(c)) flags.insert(duplicate);
  if (truth.size() > 1) flags.insert(sequence);
  if (goes_through_holes(c, truth)) flags.insert(through_hole);
  return flags;
}

}  // namespace

std::optional<Vector> mesh_vector(corpus::Case c, VectorQuestion question,
                                  VectorPrecision precision) {
  const auto steps = corpus::steps_of(c);
  const auto truth = judge_case(c);
  if (question == VectorQuestion::limit &&
      (steps.size() != 1 || (!truth[0].pairs.empty() && truth[0].first.lo == 0)))
    return std::nullopt;
  Vector vector;
  vector.question = question;
  auto flags = mesh_flags(c, truth);
  for (std::size_t s = 0; s < steps.size(); ++s) {
    const detector::SteppedMesh motion{start_of(c, steps[s]), end_of(c, steps[s])};
    vector.steps.push_back(facts_of(c, motion, truth[s]));
    std::vector<detector::MovingPoint> points;
    for (Eigen::Index v = 0; v < motion.size(); ++v)
      points.push_back(motion.path(static_cast<std::int32_t>(v)));
    flags.merge(number_flags_of(points, precision));
  }
  vector.hard = {name_of(Hardness::distance), 0};  // of a mesh without two features
  Random random("focus");
  if (const auto focus = focus_of(c, truth, {}, random)) {
    const auto query = query_at(c, *focus);
    const auto facts = contact_facts(query);
    flags.merge(flags_of(query, facts, 0, precision));
    vector.hard = hardness_of(query, facts, 0);
  }
  vector.flags.assign(flags.begin(), flags.end());
  c.expected = {};
  c.options.clear();
  vector.c = std::move(c);
  return vector;
}

}  // namespace assay::properties
