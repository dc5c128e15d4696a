#include "oracle/instant/instant.h"

#include <cassert>
#include <cmath>
#include <limits>

#include "oracle/mesh/feature_distance.h"
#include "oracle/query/contact.h"

namespace assay::oracle {

using detector::Feature;
using detector::FeatureKind;

namespace {

mpq_class times_power_of_two(mpq_class x, int exponent) {
  const auto shift = static_cast<mp_bitcnt_t>(std::abs(exponent));
  if (exponent >= 0) {
    mpq_mul_2exp(x.get_mpq_t(), x.get_mpq_t(), shift);
  } else {
    mpq_div_2exp(x.get_mpq_t(), x.get_mpq_t(), shift);
  }
  return x;
}

// Sets lo = hi = x if x is a double. Otherwise lo and hi become the two neighbours of the double to
// which GMP truncates x (a number too small for a double becomes 0 or a smallest double), so they
// enclose x.
void enclose(const mpq_class& x, double& lo, double& hi) {
  lo = hi = x.get_d();
  if (mpq_class(lo) == x) return;
  constexpr double largest = std::numeric_limits<double>::max();
  lo = std::nextafter(lo, -largest);
  hi = std::nextafter(hi, largest);
}

}  // namespace

Instant::Instant(const detector::PositionsView& x) : Instant({x, x}, RationalTime{0, 1}) {}

Instant::Instant(const detector::SteppedMesh& motion, const RationalTime& t) {
  assert(motion.vertices_t0.rows() == motion.vertices_t1.rows());
  assert(t.denominator > 0 && t.numerator >= 0 && t.numerator <= t.denominator);
  assert(t.denominator < (std::int64_t{1} << 31));
  const auto count = static_cast<std::int32_t>(motion.size());
  std::vector<detector::MovingPoint> paths;
  paths.reserve(count);
  // At t=0 and t=1 the other end is not used: it must not make the integers longer.
  const bool at_start = t.numerator == 0, at_end = t.numerator == t.denominator;
  for (std::int32_t v = 0; v < count; ++v) {
    paths.push_back(
        {at_end ? motion.end(v) : motion.start(v), at_start ? motion.start(v) : motion.end(v)});
  }
  const IntegerScale scale(paths);
  exponent_ = scale.exponent();
  const bool at_rest = at_start || at_end;
  if (!at_rest) denominator_ = static_cast<long>(t.denominator);
  const long to_end = static_cast<long>(t.numerator);
  const long to_start = static_cast<long>(t.denominator - t.numerator);

  points_.resize(count);
  boxes_.resize(count);
  for (std::int32_t v = 0; v < count; ++v) {
    const detector::MovingPoint& p = paths[v];
    for (int k = 0; k < 3; ++k) {
      if (at_rest || p.t0[k] == p.t1[k]) {
        points_[v][k] = scale(p.t0[k]) * denominator_;
        boxes_[v].min[k] = boxes_[v].max[k] = p.t0[k];
        continue;
      }
      points_[v][k] = scale(p.t0[k]) * to_start + scale(p.t1[k]) * to_end;
      mpq_class place(points_[v][k], denominator_);
      place.canonicalize();
      enclose(times_power_of_two(place, exponent_), boxes_[v].min[k], boxes_[v].max[k]);
    }
  }
}

mpq_class Instant::in_units(const mpq_class& coordinate) const {
  return times_power_of_two(coordinate, -exponent_) * denominator_;
}

namespace {

BoxOfVertices boxes_at(const Instant& instant) {
  return [&](std::span<const std::int32_t> vertices) { return instant.box_of(vertices); };
}

}  // namespace

std::vector<std::uint8_t> touched_at(const Instant& instant,
                                     const detector::TrianglesView& triangles,
                                     const detector::TrianglesView& ghosts,
                                     const std::vector<std::int32_t>& component) {
  const auto count = static_cast<std::size_t>(triangles.rows());
  const MeshFeatures mesh_parts = mesh_features(triangles), fan_parts = mesh_features(ghosts);
  const FeatureIndex mesh(mesh_parts, boxes_at(instant)), fans(fan_parts, boxes_at(instant));
  const auto meet = [&](const Feature& feature) {
    return features_meet(instant.points(), feature);
  };
  std::vector<std::uint8_t> touched(count);
  for_each_contact(mesh, mesh, meet, {},
                   {[&](std::int32_t s, std::int32_t t) {
                      return s != t && component[s] == component[t] && !(touched[s] && touched[t]);
                    },
                    [&](std::int32_t s, std::int32_t t, int) { touched[s] = touched[t] = 1; }});
  for_each_contact(mesh, fans, meet, {},
                   {[&](std::int32_t t, std::int32_t g) {
                      return !touched[t] && component[t] == component[count + g];
                    },
                    [&](std::int32_t t, std::int32_t, int) { touched[t] = 1; }});
  return touched;
}

namespace {

// The four points of a query at one time, with the notation and the rule of contact_events.h.
struct Rest {
  std::array<const IntegerPoint*, 4> x;
  int first_group;
};

int sign_for(const Rest& q, int i, const Integer& lam) {
  return i < q.first_group ? sgn(lam) : -sgn(lam);
}

// Returns whether the groups meet if all points lie on one line. They miss each other when they are
// strictly ordered along an axis along which the points differ.
bool meet_on_a_line(const Rest& q) {
  for (int k = 0; k < 3; ++k) {
    bool differ = false, before = true, after = true;
    for (int i = 0; i < q.first_group; ++i) {
      for (int j = q.first_group; j < 4; ++j) {
        const int order = cmp((*q.x[i])[k], (*q.x[j])[k]);
        differ |= order != 0;
        before &= order < 0;
        after &= order > 0;
      }
    }
    if (differ) return !before && !after;
  }
  return true;  // all four coincide
}

bool meet(const Rest& q) {
  const IntegerPoint u1 = *q.x[1] - *q.x[0], u2 = *q.x[2] - *q.x[0], u3 = *q.x[3] - *q.x[0];
  const IntegerPoint lam1 = cross(u2, u3);
  if (dot(u1, lam1) != 0) return false;
  const IntegerPoint lam2 = cross(u3, u1), lam3 = cross(u1, u2);
  for (int k = 0; k < 3; ++k) {
    const Integer lam0 = -(lam1[k] + lam2[k] + lam3[k]);
    const std::array<int, 4> signs = {sign_for(q, 0, lam0), sign_for(q, 1, lam1[k]),
                                      sign_for(q, 2, lam2[k]), sign_for(q, 3, lam3[k])};
    bool some_above = false, some_below = false;
    for (const int s : signs) {
      some_above |= s > 0;
      some_below |= s < 0;
    }
    if (some_above || some_below) return !(some_above && some_below);
  }
  return meet_on_a_line(q);
}

}  // namespace

bool features_meet(StaticPoints x, const Feature& feature) {
  const auto& v = feature.vertices;
  if (feature.kind != FeatureKind::piercing)
    return meet({{&x[v[0]], &x[v[1]], &x[v[2]], &x[v[3]]},
                 feature.kind == FeatureKind::vertex_face ? 1 : 2});
  const auto sign = [&](int o, int a, int b, int c) {
    return sgn(dot(x[v[a]] - x[v[o]], cross(x[v[b]] - x[v[o]], x[v[c]] - x[v[o]])));
  };
  constexpr int e0 = 0, e1 = 1, f0 = 2, f1 = 3, f2 = 4;
  if (sign(f0, f1, f2, e0) * sign(f0, f1, f2, e1) >= 0) return false;
  const int s = sign(e0, e1, f0, f1);
  return s != 0 && s == sign(e0, e1, f1, f2) && s == sign(e0, e1, f2, f0);
}

namespace {

// Returns the box, widened by the distance, so that the boxes of two features that are nearer meet.
Box widened(Box box, double distance) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    box.min[k] = std::nextafter(box.min[k] - distance, -infinity);
    box.max[k] = std::nextafter(box.max[k] + distance, infinity);
  }
  return box;
}

}  // namespace

std::optional<detector::TrianglePair> any_nearer_than(const detector::PositionsView& x,
                                                      const detector::TrianglesView& triangles,
                                                      double distance, const WantedPair& counts) {
  const Instant instant(x);
  const StaticPoints points = instant.points();
  std::vector<detector::Point> places;
  for (std::int32_t v = 0; v < x.rows(); ++v) places.push_back(detector::point_of(x, v));
  const auto is_near = [&](const Feature& feature) {
    if (features_meet(points, feature)) return true;
    if (distance == 0 || feature.kind == FeatureKind::piercing) return false;
    const auto& v = feature.vertices;
    return feature.kind == FeatureKind::vertex_face
               ? vertex_nearer_than(places, v[0], {v[1], v[2], v[3]}, distance)
               : edges_nearer_than(places, {v[0], v[1]}, {v[2], v[3]}, distance);
  };
  const MeshFeatures features = mesh_features(triangles);
  const FeatureIndex mesh(features, [&](std::span<const std::int32_t> vertices) {
    const Box box = instant.box_of(vertices);
    return distance > 0 ? widened(box, distance) : box;
  });
  std::optional<detector::TrianglePair> found;
  StopGate gate([&] { return found.has_value(); });
  for_each_contact(mesh, mesh, is_near, {1, &gate},
                   {[&](std::int32_t s, std::int32_t t) {
                      return !found && s != t && counts(std::min(s, t), std::max(s, t));
                    },
                    [&](std::int32_t s, std::int32_t t, int) {
                      if (!found) found = {std::min(s, t), std::max(s, t)};
                    }});
  return found;
}

// Returns whether two triangles cross. The differences of their places fill a convex body, and they
// cross when 0 is inside of it. Its sides are normal to a triangle or to an edge of each. If it is
// flat, all normals here are normal to its plane, or 0.
bool triangles_cross(const detector::PositionsView& x, const detector::TrianglesView& triangles,
                     const detector::TrianglePair& pair) {
  std::array<detector::MovingPoint, 6> places;
  for (int i = 0; i < 6; ++i) {
    const auto place = detector::point_of(x, triangles(i < 3 ? pair.a : pair.b, i % 3));
    places[i] = {place, place};
  }
  const IntegerScale scale(places);
  std::array<IntegerPoint, 6> corner;
  for (int i = 0; i < 6; ++i) {
    for (int k = 0; k < 3; ++k) corner[i][k] = scale(places[i].t0[k]);
  }
  const auto edge = [&](int first, int i) {
    return corner[first + (i + 1) % 3] - corner[first + i];
  };
  bool has_side = false;
  const auto is_inside_of_side = [&](const IntegerPoint& normal) {
    if (normal == IntegerPoint{}) return true;
    has_side = true;
    std::array<Integer, 6> height;
    for (int i = 0; i < 6; ++i) height[i] = dot(normal, corner[i]);
    const auto [a_low, a_high] = std::minmax({height[0], height[1], height[2]});
    const auto [b_low, b_high] = std::minmax({height[3], height[4], height[5]});
    return a_high > b_low && a_low < b_high;
  };
  if (!is_inside_of_side(cross(edge(0, 0), edge(0, 1))) ||
      !is_inside_of_side(cross(edge(3, 0), edge(3, 1))))
    return false;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (!is_inside_of_side(cross(edge(0, i), edge(3, j)))) return false;
    }
  }
  return has_side;
}

}  // namespace assay::oracle
