#include "properties/search/moves.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "detector/mesh/topology.h"
#include "oracle/distance/feature_distance.h"
#include "properties/changes/changes.h"
#include "properties/random.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {

namespace {

using Vertices = std::array<std::int32_t, 4>;
using Row = Eigen::RowVector3d;

constexpr double looked_at[] = {0, 0.5, 1};

class NearestFeatures {
 public:
  NearestFeatures(const Case& c, std::size_t step) : c_(c) { focus_.step = step; }

  void look_at(std::int32_t a, std::int32_t b) {
    const auto corner = [&](std::int32_t t, int k) { return c_.triangles(t, k % 3); };
    for (int i = 0; i < 3; ++i) {
      take({corner(a, i), corner(b, 0), corner(b, 1), corner(b, 2)}, 1);
      take({corner(b, i), corner(a, 0), corner(a, 1), corner(a, 2)}, 1);
      for (int j = 0; j < 3; ++j)
        take({corner(a, i), corner(a, i + 1), corner(b, j), corner(b, j + 1)}, 2);
    }
  }

  std::optional<Focus> focus() const {
    return nearest_ < std::numeric_limits<double>::infinity() ? std::optional(focus_)
                                                              : std::nullopt;
  }

 private:
  void take(const Vertices& vertices, int first_group) {
    auto ascending = vertices;
    std::ranges::sort(ascending);
    if (std::ranges::adjacent_find(ascending) != ascending.end()) return;
    Focus candidate = focus_;
    candidate.vertices = vertices;
    candidate.first_group = first_group;
    const auto query = query_at(c_, candidate);
    for (const double t : looked_at) {
      const double squared = oracle::closest_places(query, t).squared;
      if (!(squared < nearest_)) continue;
      nearest_ = squared;
      candidate.time = t;
      focus_ = candidate;
    }
  }

  const Case& c_;
  Focus focus_;
  double nearest_ = std::numeric_limits<double>::infinity();
};

// Sets the vertices of the feature at their places in FourPoints. An edge that pierces a face gives
// its first end.
void set_feature(Focus& focus, const Feature& feature) {
  const auto& v = feature.vertices;
  const bool is_piercing = feature.kind == FeatureKind::piercing;
  focus.vertices =
      is_piercing ? Vertices{v[0], v[2], v[3], v[4]} : Vertices{v[0], v[1], v[2], v[3]};
  focus.first_group = feature.kind == FeatureKind::edge_edge ? 2 : 1;
}

constexpr double times_of_signs[] = {0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1};

Row row_of(const Point& p) { return {p[0], p[1], p[2]}; }
Row row_at(const MovingPoint& p, double t) {
  return row_of(p.t0) + t * (row_of(p.t1) - row_of(p.t0));
}

// How far a triangle is positive, and how far it is negative, from 0 to 1. Each number is a
// weighted mean of two shares: a quarter is the share of times and corners with this sign, and the
// rest the share of times at which one corner has it, the corner that has it most often.
struct Shares {
  double positive = 0, negative = 0;
};

Shares shares_of(const SteppedMesh& motion, const ViewPrimitive& view,
                 const std::array<std::int32_t, 3>& corners) {
  std::array<int, 3> positive{}, negative{};
  for (const double t : times_of_signs) {
    std::array<Row, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = row_at(motion.path(corners[k]), t);
    const Row normal = (p[1] - p[0]).cross(p[2] - p[0]);
    const Row q0 = row_at(view.q0, t), way = row_at(view.q1, t) - q0;
    const double length = way.squaredNorm();
    for (std::size_t k = 0; k < 3; ++k) {
      const double along = length > 0 ? std::clamp((p[k] - q0).dot(way) / length, 0.0, 1.0) : 0;
      const double value = (p[k] - q0 - along * way).dot(normal);
      positive[k] += value > 0 ? 1 : 0;
      negative[k] += value < 0 ? 1 : 0;
    }
  }
  constexpr double times = std::size(times_of_signs);
  const auto share = [&](const std::array<int, 3>& of) {
    return 0.75 * std::max({of[0], of[1], of[2]}) / times +
           0.25 * (of[0] + of[1] + of[2]) / (3 * times);
  };
  return {share(positive), share(negative)};
}

}  // namespace

std::optional<Focus> focus_of(const Case& c, std::span<const StepJudgement> truth,
                              const Contract& contract, Random& random) {
  for (std::size_t s = 0; s < truth.size(); ++s) {
    const auto first = truth_of(c, truth[s], contract).first;
    if (!first || first->feature.kind == FeatureKind::same_vertices) continue;
    Focus focus;
    focus.step = s;
    focus.time = first->time.lo;
    focus.contact = first;
    for (const auto& contact : truth[s].pairs) {
      if (contact.time == first->time) focus.pairs.push_back(contact.pair);
    }
    set_feature(focus, first->feature);
    return focus;
  }
  const auto steps = steps_of(c);
  const auto triangles = static_cast<int>(c.triangles.rows());
  if (steps.empty() || triangles < 2) return std::nullopt;
  const auto step = static_cast<std::size_t>(random.below(static_cast<int>(steps.size())));
  if (const auto query = query_of(c)) {
    const int first_group = query->first_group;
    return Focus{step, {0, 1, 2, 3}, first_group, 0.5, std::nullopt, {}};
  }
  NearestFeatures nearest(c, step);
  constexpr int pairs_looked_at = 4;
  for (int i = 0; i < (triangles == 2 ? 1 : pairs_looked_at); ++i) {
    const int a = random.below(triangles);
    const int b = (a + random.between(1, triangles - 1)) % triangles;
    nearest.look_at(a, b);
  }
  return nearest.focus();
}

FourPoints query_at(const Case& c, const Focus& focus) {
  const auto step = steps_of(c)[focus.step];
  const SteppedMesh motion{start_of(c, step), end_of(c, step)};
  FourPoints query;
  query.first_group = focus.first_group;
  for (std::size_t i = 0; i < 4; ++i) query.points[i] = motion.path(focus.vertices[i]);
  return query;
}

void set_query(Case& c, const Focus& focus, const FourPoints& query) {
  const auto step = steps_of(c)[focus.step];
  for (std::size_t i = 0; i < 4; ++i) set_path(c, step, focus.vertices[i], query.points[i]);
}

TrianglePair pair_in_focus(const Case& c, const Focus& focus) {
  if (focus.contact) return focus.contact->pair;
  const auto holder = [&](std::int32_t vertex) {
    std::int32_t t = 0;
    while (t + 1 < c.triangles.rows() && !(c.triangles.row(t).array() == vertex).any()) ++t;
    return t;
  };
  return {holder(focus.vertices.front()), holder(focus.vertices.back())};
}

bool is_within_a_component(const Case& c, const Focus& focus) {
  if (focus.pairs.empty()) return false;
  const auto component =
      detector::make_topology(c.triangles, c.frames.front().rows()).component_of_triangle;
  return std::ranges::all_of(focus.pairs, [&](const auto& pair) {
    return component[detector::at(pair.a)] == component[detector::at(pair.b)];
  });
}

double seen_alike(const Case& c, const Focus& focus) {
  const auto view = view_of_step(c, focus.step);
  if (!view || focus.pairs.empty()) return 0;
  const auto step = steps_of(c)[focus.step];
  const SteppedMesh motion{start_of(c, step), end_of(c, step)};
  double positive = 1, negative = 1;
  for (const auto& pair : focus.pairs) {
    for (const auto t : {pair.a, pair.b}) {
      const auto shares =
          shares_of(motion, *view, {c.triangles(t, 0), c.triangles(t, 1), c.triangles(t, 2)});
      positive = std::min(positive, shares.positive);
      negative = std::min(negative, shares.negative);
    }
  }
  return std::max(positive, negative);
}

std::span<const Move> moves() {
  static const std::vector<Move> all = [] {
    std::vector<Move> list;
    for (const auto& some : {feature_moves(), step_moves(), mesh_moves(), view_moves()})
      list.insert(list.end(), some.begin(), some.end());
    return list;
  }();
  return all;
}

}  // namespace assay::properties
