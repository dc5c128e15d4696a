#include "oracle/instant/layers.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "oracle/mesh/mesh_features.h"

namespace assay::oracle {

namespace {

using detector::Point;

// Directions of rays are (2^20, k, k^2), k = 1, 2, ... No plane through the origin holds three of
// them, so each edge of the cycle spoils at most two, and some direction meets no edge.
constexpr int run_exponent = 20;

IntegerPoint direction_vector(int k) {
  return {Integer(1) << run_exponent, Integer(k), Integer(k) * k};
}

double up(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }

// Returns the farthest that a ray in direction (2^20, s) rises over `run`, rounded up.
double rise(double run, double s) {
  constexpr double rounding_slack =
      1 + 0x1p-10;  // for the roundings of three operations: far below 2^-50
  return up(run * std::ldexp(s, -run_exponent) * rounding_slack);
}

}  // namespace

// A ray starts at point / weight in the units of the instant; the box of doubles `start` holds
// that place.
struct WindingField::Ray {
  IntegerPoint point;
  Integer weight;
  Box start;

  IntegerPoint to(const IntegerPoint& x) const {
    IntegerPoint v;
    for (int k = 0; k < 3; ++k) v[k] = x[k] * weight - point[k];
    return v;
  }
};

WindingField::WindingField(const Instant& instant, detector::Triangles cycle)
    : instant_(instant), cycle_(std::move(cycle)) {
  std::vector<Box> boxes;
  boxes.reserve(static_cast<std::size_t>(cycle_.rows()));
  for (Eigen::Index t = 0; t < cycle_.rows(); ++t) {
    boxes.push_back(instant_.box_of(std::array{cycle_(t, 0), cycle_(t, 1), cycle_(t, 2)}));
    if (t == 0) bounds_ = boxes[0];
    for (int k = 0; k < 3; ++k) {
      bounds_.min[k] = std::min(bounds_.min[k], boxes.back().min[k]);
      bounds_.max[k] = std::max(bounds_.max[k], boxes.back().max[k]);
    }
  }
  tree_ = std::make_unique<BoxTree>(boxes);
}

std::optional<int> WindingField::at(const Point& point) const {
  return at(RationalPoint{mpq_class(point[0]), mpq_class(point[1]), mpq_class(point[2])});
}

std::optional<int> WindingField::at(const RationalPoint& point) const {
  if (cycle_.rows() == 0) return 0;
  for (int k = 0; k < 3; ++k) {
    if (point[k] < mpq_class(bounds_.min[k]) || point[k] > mpq_class(bounds_.max[k])) return 0;
  }
  Ray ray;
  ray.weight = 1;
  RationalPoint scaled;
  for (int k = 0; k < 3; ++k) {
    scaled[k] = instant_.in_units(point[k]);
    ray.weight *= scaled[k].get_den();
    // get_d truncates, so the place lies from this double on and before the next one.
    const double d = point[k].get_d();
    ray.start.min[k] = std::nextafter(d, -std::numeric_limits<double>::infinity());
    ray.start.max[k] = up(d);
  }
  for (int k = 0; k < 3; ++k) {
    const mpq_class whole = scaled[k] * ray.weight;
    ray.point[k] = whole.get_num();
  }
  if (on_surface(ray)) return std::nullopt;
  for (int direction = 1;; ++direction) {
    if (const auto w = crossings(ray, direction, -1)) return w;
  }
}

Layer WindingField::layer_of(std::int32_t triangle) const {
  const std::array<std::int32_t, 3> corner = {cycle_(triangle, 0), cycle_(triangle, 1),
                                              cycle_(triangle, 2)};
  const auto& x = instant_.points();
  Ray ray;
  ray.weight = 3;
  ray.start = instant_.box_of(corner);
  for (int k = 0; k < 3; ++k) {
    ray.point[k] = x[corner[0]][k] + x[corner[1]][k] + x[corner[2]][k];
  }
  const IntegerPoint normal = cross(x[corner[1]] - x[corner[0]], x[corner[2]] - x[corner[0]]);
  for (int direction = 1;; ++direction) {
    const int side = sgn(dot(direction_vector(direction), normal));
    if (side == 0) continue;
    // Without the triangle itself the count is the winding number on the side of the ray.
    if (const auto w = crossings(ray, direction, triangle)) {
      return side > 0 ? Layer{*w + 1, *w} : Layer{*w, *w - 1};
    }
  }
}

// The sum of the crossings ahead, without those of triangle `skipped`. Nothing when the line of
// the ray meets an edge, or lies in the plane of a triangle.
std::optional<int> WindingField::crossings(const Ray& ray, int direction,
                                           std::int32_t skipped) const {
  const IntegerPoint d = direction_vector(direction);
  const double run = up(bounds_.max[0] - ray.start.min[0]);
  Box path = ray.start;
  path.max[0] = std::max(path.max[0], bounds_.max[0]);
  path.max[1] = up(path.max[1] + rise(run, direction));
  path.max[2] = up(path.max[2] + rise(run, static_cast<double>(direction) * direction));
  std::vector<std::int32_t> candidates;
  tree_->meeting(path, candidates);

  int w = 0;
  const auto& x = instant_.points();
  for (const std::int32_t t : candidates) {
    if (t == skipped) continue;
    const IntegerPoint a = ray.to(x[cycle_(t, 0)]), b = ray.to(x[cycle_(t, 1)]),
                       c = ray.to(x[cycle_(t, 2)]);
    const int ab = sgn(dot(d, cross(a, b))), bc = sgn(dot(d, cross(b, c))),
              ca = sgn(dot(d, cross(c, a)));
    if (std::min({ab, bc, ca}) < 0 && std::max({ab, bc, ca}) > 0) continue;
    if (ab != 0 && ab == bc && bc == ca) {
      // The line crosses the inside, and d.N has the sign ab. The crossing is ahead when a.N has
      // it too.
      if (sgn(dot(a, cross(b, c))) == ab) w += ab;
      continue;
    }
    const IntegerPoint normal = cross(b - a, c - a);
    const bool zero_area = normal[0] == 0 && normal[1] == 0 && normal[2] == 0;
    if (!zero_area) return std::nullopt;
  }
  return w;
}

bool WindingField::on_surface(const Ray& ray) const {
  std::vector<std::int32_t> candidates;
  tree_->meeting(ray.start, candidates);
  const IntegerPoint here = {0, 0, 0};
  for (const std::int32_t t : candidates) {
    std::array<IntegerPoint, 4> points = {here};
    for (int i = 0; i < 3; ++i) points[i + 1] = ray.to(instant_.points()[cycle_(t, i)]);
    if (features_meet(points, {detector::FeatureKind::vertex_face, {0, 1, 2, 3, -1}})) return true;
  }
  return false;
}

namespace {

// Disjoint sets; the representative is the lowest member.
class Classes {
 public:
  explicit Classes(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  std::int32_t lowest(std::int32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::int32_t a, std::int32_t b) {
    a = lowest(a), b = lowest(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::int32_t> parent_;
};

detector::Triangles stacked(const detector::TrianglesView& a, const detector::TrianglesView& b) {
  detector::Triangles all(a.rows() + b.rows(), 3);
  all << a, b;
  return all;
}

// Numbers the classes of those members that `counts` accepts, in the order of their lowest members.
// Gives the number of each member; -1 for the others. REQUIRES that no class holds both kinds.
template <class Counts>
std::vector<std::int32_t> numbered(Classes& classes, std::size_t size, const Counts& counts) {
  std::vector<std::int32_t> number(size, -1);
  std::int32_t next = 0;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(size); ++i) {
    if (!counts(i)) continue;
    const std::int32_t lowest = classes.lowest(i);
    number[i] = lowest == i ? next++ : number[lowest];
  }
  return number;
}

std::vector<std::int32_t> components(const MeshFeatures& all) {
  Classes classes(all.faces.size());
  for (std::size_t v = 0; v < all.vertices.size(); ++v) {
    const auto holders = all.triangles_of_vertex.of(v);
    for (const std::int32_t t : holders) classes.join(holders[0], t);
  }
  return numbered(classes, all.faces.size(), [](std::int32_t) { return true; });
}

// Returns whether the face has the directed edge from the lower to the higher vertex.
bool runs_upward(const Face& face, const Edge& edge) {
  for (int k = 0; k < 3; ++k) {
    if (face[k] == edge[0] && face[(k + 1) % 3] == edge[1]) return true;
  }
  return false;
}

std::vector<std::int32_t> pieces(const MeshFeatures& all,
                                 const std::vector<std::uint8_t>& touched) {
  const auto count = static_cast<std::int32_t>(touched.size());
  Classes classes(touched.size());
  for (std::size_t e = 0; e < all.edges.size(); ++e) {
    const auto holders = all.triangles_of_edge.of(e);
    if (holders.size() != 2) continue;
    const std::int32_t s = holders[0], t = holders[1];
    if (s >= count || t >= count || touched[s] || touched[t]) continue;
    const Edge& edge = all.edges[e];
    if (runs_upward(all.faces[s], edge) != runs_upward(all.faces[t], edge)) classes.join(s, t);
  }
  return numbered(classes, touched.size(), [&](std::int32_t t) { return !touched[t]; });
}

// Returns the layers of the untouched triangles. They are found once for each piece, in the winding
// numbers of its component.
std::vector<std::optional<Layer>> layers(const Instant& instant, const detector::Triangles& all,
                                         const LayerState& state) {
  std::vector<std::vector<Eigen::Index>> members;
  std::vector<std::int32_t> place;  // of each triangle in its component
  for (std::size_t t = 0; t < state.component.size(); ++t) {
    const auto c = static_cast<std::size_t>(state.component[t]);
    if (c >= members.size()) members.resize(c + 1);
    place.push_back(static_cast<std::int32_t>(members[c].size()));
    members[c].push_back(static_cast<Eigen::Index>(t));
  }
  std::vector<std::optional<Layer>> layer(state.touched.size());
  std::map<std::int32_t, Layer> layer_of_piece;
  for (const auto& component : members) {
    std::optional<WindingField> field;
    for (const Eigen::Index t : component) {
      if (t >= static_cast<Eigen::Index>(layer.size()) || state.touched[t]) continue;
      if (!layer_of_piece.count(state.piece[t])) {
        if (!field) field.emplace(instant, all(component, Eigen::all));
        layer_of_piece[state.piece[t]] = field->layer_of(place[t]);
      }
      layer[t] = layer_of_piece[state.piece[t]];
    }
  }
  return layer;
}

std::vector<std::optional<Layer>> common_layers(const LayerState& state) {
  struct Use {
    std::int32_t count = 0, lowest = 0;
  };
  std::vector<std::map<Layer, Use>> uses;
  for (std::size_t t = 0; t < state.component.size(); ++t) {
    const auto c = static_cast<std::size_t>(state.component[t]);
    if (c >= uses.size()) uses.resize(c + 1);
    if (t >= state.layer.size() || !state.layer[t]) continue;
    Use& use = uses[c][*state.layer[t]];
    if (use.count++ == 0) use.lowest = static_cast<std::int32_t>(t);
  }
  std::vector<std::optional<Layer>> common(uses.size());
  for (std::size_t c = 0; c < uses.size(); ++c) {
    Use best;
    for (const auto& [layer, use] : uses[c]) {
      if (use.count < best.count || (use.count == best.count && use.lowest > best.lowest)) continue;
      best = use;
      common[c] = layer;
    }
  }
  return common;
}

}  // namespace

LayerState layers_at(const Instant& instant, const detector::TrianglesView& triangles,
                     const detector::TrianglesView& ghosts) {
  assert(closes(triangles, ghosts));
  const detector::Triangles all = stacked(triangles, ghosts);
  const MeshFeatures features = mesh_features(all);
  LayerState state;
  state.component = components(features);
  state.touched = touched_at(instant, triangles, ghosts, state.component);
  for (std::size_t t = 0; t < state.touched.size(); ++t) {
    const Face& f = features.faces[t];
    if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) state.touched[t] = 1;  // has no normal
  }
  state.piece = pieces(features, state.touched);
  state.layer = layers(instant, all, state);
  state.common = common_layers(state);
  for (std::size_t t = 0; t < state.touched.size(); ++t) {
    state.clean.push_back(state.layer[t] && state.layer[t] == state.common[state.component[t]]);
  }
  return state;
}

}  // namespace assay::oracle
