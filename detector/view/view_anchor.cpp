#include "detector/view/view_anchor.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "detector/geometry/winding.h"
#include "detector/view/view_search.h"

namespace assay::detector {
namespace {

// With w the inverse-distance weights and y the offsets of the vertices from the point, the change
// of least sum(change^2 / w) that makes sum(y) zero and keeps the sum 1 is
//   change_i = w_i (a + b . y_i),   [ 1    m^T ] [a]   [ 0]
//                                   [ m    C   ] [b] = [-m],   m = sum w y,  C = sum w y y^T.

using Row = std::array<double, 5>;  // four unknowns and the right side

// Solves the rows by Gaussian elimination with full pivoting. Unknowns whose pivot is below `least`
// times the first pivot become 0.
std::array<double, 4> solve(std::array<Row, 4> rows, double least) {
  std::array<std::size_t, 4> column = {0, 1, 2, 3};
  std::size_t rank = 0;
  double first = 0;
  for (; rank < 4; ++rank) {
    std::size_t r = rank, c = rank;
    for (std::size_t i = rank; i < 4; ++i) {
      for (std::size_t k = rank; k < 4; ++k) {
        if (std::abs(rows[i][column[k]]) > std::abs(rows[r][column[c]])) r = i, c = k;
      }
    }
    std::swap(rows[rank], rows[r]);
    std::swap(column[rank], column[c]);
    const double pivot = rows[rank][column[rank]];
    if (rank == 0) first = std::abs(pivot);
    if (!(std::abs(pivot) > least * first)) break;
    for (std::size_t i = rank + 1; i < 4; ++i) {
      const double factor = rows[i][column[rank]] / pivot;
      for (std::size_t k = rank; k < 4; ++k) {
        rows[i][column[k]] -= factor * rows[rank][column[k]];
      }
      rows[i][4] -= factor * rows[rank][4];
    }
  }
  std::array<double, 4> x = {0, 0, 0, 0};
  for (std::size_t i = rank; i-- > 0;) {
    double sum = rows[i][4];
    for (std::size_t k = i + 1; k < rank; ++k) sum -= rows[i][column[k]] * x[column[k]];
    x[column[i]] = sum / rows[i][column[i]];
  }
  return x;
}

constexpr std::size_t direction_count = 54;

// Returns the number of the cell that the offset points to, on the surface of a cube with 3 x 3
// cells on each face.
std::size_t direction_of(const Point& y) {
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (std::abs(y[k]) > std::abs(y[axis])) axis = k;
  }
  const double third = std::abs(y[axis]) / 3;
  const auto cell = [third](double c) -> std::size_t { return c < -third ? 0 : c > third ? 2 : 1; };
  const std::size_t face = 2 * axis + (y[axis] < 0 ? 1 : 0);
  return 9 * face + 3 * cell(y[(axis + 1) % 3]) + cell(y[(axis + 2) % 3]);
}

double squared_length(const Point& y) { return y[0] * y[0] + y[1] * y[1] + y[2] * y[2]; }

struct Neighbour {
  std::int32_t vertex = -1;
  Point offset{};
  double distance2 = 0;
};

std::vector<Neighbour> neighbours_around(std::span<const std::int32_t> vertices,
                                         std::span<const Point> points, const Point& point) {
  std::array<Neighbour, direction_count> nearest;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Point y = {points[i][0] - point[0], points[i][1] - point[1], points[i][2] - point[2]};
    const double distance2 = squared_length(y);
    Neighbour& best = nearest[direction_of(y)];
    if (best.vertex < 0 || distance2 < best.distance2) best = {vertices[i], y, distance2};
  }
  std::vector<Neighbour> found;
  for (const auto& n : nearest) {
    if (n.vertex >= 0) found.push_back(n);
  }
  return found;
}

void correct(const std::vector<Neighbour>& around, std::vector<double>& weights) {
  std::array<Row, 4> rows{};
  for (std::size_t i = 0; i < around.size(); ++i) {
    const auto& y = around[i].offset;
    const std::array<double, 4> a = {1, y[0], y[1], y[2]};
    for (std::size_t r = 0; r < 4; ++r) {
      for (std::size_t c = 0; c < 4; ++c) rows[r][c] += weights[i] * a[r] * a[c];
    }
  }
  for (std::size_t r = 1; r < 4; ++r) rows[r][4] = -rows[r][0];
  constexpr double least_pivot = 1e-6;
  const auto x = solve(rows, least_pivot);
  std::vector<double> corrected = weights;
  double sum = 0, size = 0;
  for (std::size_t i = 0; i < around.size(); ++i) {
    const auto& y = around[i].offset;
    corrected[i] += weights[i] * (x[0] + x[1] * y[0] + x[2] * y[1] + x[3] * y[2]);
    sum += corrected[i];
    size += std::abs(corrected[i]);
  }
  constexpr double most = 8;  // a point far outside would swing with every vertex
  if (!(size < most && sum > 0.5)) return;
  for (double& w : corrected) w /= sum;
  weights = std::move(corrected);
}

// A search looks at some of the planes only: for points at a half, for lines at an eighth, but no
// fewer than `least`. The best places that it finds are then scored among all planes. If the search
// looked at all planes, lines alone would take as long as three to ten steps of Culling::bvh.
struct Thinning {
  std::size_t divisor, least;
  ViewPlanes of(const ViewPlanes& planes) const {
    return planes.thinned(std::max(planes.size() / divisor, least));
  }
};
constexpr Thinning for_points = {2, 384}, for_lines = {8, 128};

class AnchorChoice {
 public:
  AnchorChoice(const Topology& mesh, const Component& component, Eigen::Index vertex_count,
               const PositionsView& x, std::size_t most_planes, PacedStop* pace)
      : mesh_(mesh),
        component_(component),
        x_(x),
        pace_(pace),
        planes_(mesh, component, x, most_planes),
        few_(for_points.of(planes_)),
        fewer_(for_lines.of(planes_)) {
    own_ = static_cast<std::size_t>(
        std::lower_bound(component.vertices.begin(), component.vertices.end(), vertex_count) -
        component.vertices.begin());
  }

  ViewAnchor run(ViewKind kind) {
    const auto points = find_points();
    return kind == ViewKind::point ? best_point(points) : best_line(points);
  }

  ViewAnchor without_search(ViewKind kind) const {
    const auto own = planes_.points().first(own_);
    Point mean = {0, 0, 0};
    for (const auto& p : own) {
      for (std::size_t k = 0; k < 3; ++k) mean[k] += p[k] / static_cast<double>(own_);
    }
    if (kind == ViewKind::point) return {ViewKind::point, {weights(mean), {}}};
    const Point between = {(mean[0] + own[0][0]) / 2, (mean[1] + own[0][1]) / 2,
                           (mean[2] + own[0][2]) / 2};
    return {ViewKind::line, {weights(mean), weights(between)}};
  }

  ViewAnchor run() {
    const auto points = find_points();
    ViewAnchor point = best_point(points);
    const auto score_of_point = score_as_line(point);
    if (score_of_point == perfect()) return point;
    ViewAnchor line = best_line(points);
    const auto score_of_line = score_as_line(line);
    const bool is_worth_its_test = score_of_line - score_of_point >= perfect() / 16;
    return score_of_line == perfect() || is_worth_its_test ? line : point;
  }

 private:
  // A place from which all triangles are positive makes steps free (L5). If such a place was found
  // for the few planes but not for all planes, the search is repeated with all planes.
  std::vector<ScoredPoint> find_points() const {
    auto points = search_points(few_, pace_);
    const bool is_promised = points.front().score == perfect(few_);
    if (is_promised && planes_.score(points.front().q) != perfect()) {
      return search_points(planes_, pace_);
    }
    return points;
  }

  // Returns the best places of a search, ranked by their scores among all planes.
  template <class Scored, class Score>
  std::vector<Scored> held_against_all(const std::vector<Scored>& ranked, Score score,
                                       std::uint64_t work) const {
    constexpr std::size_t most_held = 8;
    std::vector<Scored> held;
    for (std::size_t i = 0; i < std::min(ranked.size(), most_held); ++i) {
      held.push_back(ranked[i]);
      held.back().score = score(ranked[i]);
      if (held.back().score == perfect() || (pace_ && pace_->after(work))) break;
    }
    std::stable_sort(held.begin(), held.end(),
                     [](const Scored& a, const Scored& b) { return a.score > b.score; });
    return held;
  }

  ViewAnchor best_point(const std::vector<ScoredPoint>& points) {
    const auto held = held_against_all(
        points, [&](const ScoredPoint& s) { return planes_.score(s.q); }, planes_.size() / 5);
    return choose<ScoredPoint>(held, [&](const ScoredPoint& s) {
      ViewAnchor anchor{ViewKind::point, {weights(s.q), {}}};
      return std::pair(planes_.score(placed(anchor, 0)), std::move(anchor));
    });
  }

  ViewAnchor best_line(const std::vector<ScoredPoint>& points) {
    const auto lines = search_lines(fewer_, points, pace_);
    const auto held = held_against_all(
        lines, [&](const ScoredLine& s) { return planes_.score(s.q0, s.q1); }, planes_.size());
    return choose<ScoredLine>(held, [&](const ScoredLine& s) {
      ViewAnchor anchor{ViewKind::line, {weights(s.q0), weights(s.q1)}};
      return std::pair(planes_.score(placed(anchor, 0), placed(anchor, 1)), std::move(anchor));
    });
  }

  // Returns the score as a line, for points too. This makes the scores of points and lines
  // comparable.
  std::int64_t score_as_line(const ViewAnchor& anchor) const {
    const int last = anchor.kind == ViewKind::line ? 1 : 0;
    return planes_.score(placed(anchor, 0), placed(anchor, last));
  }

  std::int64_t perfect() const { return perfect(planes_); }
  static std::int64_t perfect(const ViewPlanes& planes) {
    return (ViewPlanes::for_positive + ViewPlanes::for_margin) *
           static_cast<std::int64_t>(planes.size());
  }

  AffineWeights weights(const Point& q) const {
    return affine_weights(std::span(component_.vertices).first(own_), planes_.points().first(own_),
                          q);
  }

  // Returns the actual place of the anchor. It may differ from the place that was asked for if the
  // anchor's vertices do not span all directions.
  Point placed(const ViewAnchor& anchor, int end) const {
    return planes_.to_unit(combine(anchor.ends[end], x_));
  }

  bool is_inside(const ViewAnchor& anchor) const {
    return winding_number(mesh_, component_.triangles, x_, combine(anchor.ends[0], x_)) == 1;
  }

  // Counts the work of one look at each triangle and each vertex.
  bool has_to_end() const { return pace_ && pace_->after(8 * component_.triangles.size()); }

  // Returns the best of the first few, scored at their actual places, or one that is inside the
  // mesh and nearly as good.
  template <class Scored, class Make>
  ViewAnchor choose(const std::vector<Scored>& ranked, Make make) {
    constexpr std::size_t most_placed = 4;
    std::vector<std::pair<std::int64_t, ViewAnchor>> placed;
    for (std::size_t i = 0; i < ranked.size() && placed.size() < most_placed; ++i) {
      placed.push_back(make(ranked[i]));
      if (placed.back().first == ranked.front().score || has_to_end()) break;
    }
    const std::size_t first_left = placed.size();
    std::stable_sort(placed.begin(), placed.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    // If no point was found inside, no line inside is looked for.
    if (is_outside_) return placed[0].second;
    const std::int64_t least = placed[0].first - lost_for_inside();
    for (const auto& [score, anchor] : placed) {
      if (score < least || has_to_end()) break;
      if (is_inside(anchor)) return anchor;
    }
    for (std::size_t i = first_left; i < ranked.size(); ++i) {
      if (ranked[i].score < least || has_to_end()) break;
      auto [score, anchor] = make(ranked[i]);
      if (score >= least && is_inside(anchor)) return anchor;
    }
    is_outside_ = true;
    return placed[0].second;
  }

  std::int64_t lost_for_inside() const {
    return static_cast<std::int64_t>(planes_.size()) * ViewPlanes::for_positive / 20;
  }

  const Topology& mesh_;
  const Component& component_;
  const PositionsView& x_;
  PacedStop* pace_;
  ViewPlanes planes_;  // of as many triangles as the effort allows
  ViewPlanes few_, fewer_;
  bool is_outside_ = false;
  std::size_t own_ = 0;
};

std::size_t most_planes(Effort effort, const Component& component) {
  if (effort == Effort::brief) return 1024;
  if (effort != Effort::quick) return ViewPlanes::most_planes;
  return std::clamp<std::size_t>(component.triangles.size() / 8, 64, 1000);
}

}  // namespace

AffineWeights affine_weights(std::span<const std::int32_t> vertices, std::span<const Point> points,
                             const Point& point) {
  const std::vector<Neighbour> around = neighbours_around(vertices, points, point);
  constexpr double least_distance2 = 1e-12;
  double sum = 0;
  std::vector<double> weights;
  for (const auto& n : around) {
    weights.push_back(1 / std::max(n.distance2, least_distance2));
    sum += weights.back();
  }
  for (double& w : weights) w /= sum;
  correct(around, weights);
  AffineWeights affine;
  for (const auto& n : around) affine.vertices.push_back(n.vertex);
  affine.weights = std::move(weights);
  return affine;
}

Point combine(const AffineWeights& affine, const PositionsView& x) {
  // It sums offsets from one vertex, so that translating all vertices translates the point, up to
  // rounding.
  const Point base = point_of(x, affine.vertices[0]);
  Point q = base;
  for (std::size_t k = 0; k < 3; ++k) {
    double sum = 0;
    for (std::size_t i = 0; i < affine.vertices.size(); ++i) {
      const double c = x(affine.vertices[i], static_cast<Eigen::Index>(k));
      sum += affine.weights[i] * (c - base[k]);
    }
    q[k] = base[k] + sum;
    if (!std::isfinite(q[k])) q[k] = base[k];  // near the ends of the doubles
  }
  return q;
}

Effort effort_for(const Component& component, const Topology& mesh, Effort effort) {
  constexpr std::size_t few_components = 64, triangles_a_search = 16, small = 64;
  const bool too_many =
      mesh.components.size() > few_components + mesh.triangles.size() / triangles_a_search;
  return too_many && component.triangles.size() < small ? Effort::least : effort;
}

ViewAnchor make_view_anchor(ViewKind kind, const Topology& mesh, const Component& component,
                            Eigen::Index vertex_count, const PositionsView& x, Effort effort,
                            PacedStop* pace) {
  AnchorChoice choice(mesh, component, vertex_count, x, most_planes(effort, component), pace);
  return effort == Effort::least ? choice.without_search(kind) : choice.run(kind);
}

ViewAnchor choose_view_anchor(const Topology& mesh, const Component& component,
                              Eigen::Index vertex_count, const PositionsView& x, Effort effort,
                              PacedStop* pace) {
  AnchorChoice choice(mesh, component, vertex_count, x, most_planes(effort, component), pace);
  return effort == Effort::least ? choice.without_search(ViewKind::point) : choice.run();
}

ViewPrimitive place_view(const ViewAnchor& anchor, const SteppedMesh& motion) {
  const MovingPoint q0 = {combine(anchor.ends[0], motion.vertices_t0),
                          combine(anchor.ends[0], motion.vertices_t1)};
  if (anchor.kind == ViewKind::point) return {q0, q0};
  return {
      q0,
      {combine(anchor.ends[1], motion.vertices_t0), combine(anchor.ends[1], motion.vertices_t1)}};
}

}  // namespace assay::detector
