#include "oracle/instant/nearness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "oracle/instant/instant.h"
#include "oracle/instant/instant_contacts.h"
#include "oracle/mesh/feature_distance.h"
#include "oracle/mesh/feature_pairs.h"
#include "oracle/query/contact.h"

namespace assay::oracle {

namespace {

// The box, widened by the distance, so that the boxes of two features that are nearer meet.
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
  const FeatureTests tests = {
      [&](std::int32_t v, const Face& f) {
        return vertex_meets_face(points, v, f) ||
               (distance > 0 && vertex_nearer_than(places, v, f, distance));
      },
      [&](const Edge& a, const Edge& b) {
        return edges_meet(points, a, b) ||
               (distance > 0 && edges_nearer_than(places, a, b, distance));
      },
      [&](const Edge& e, const Face& f) { return edge_pierces_face(points, e, f); }};
  const MeshFeatures features = mesh_features(triangles);
  const FeatureIndex mesh(features, [&](std::span<const std::int32_t> vertices) {
    const Box box = instant.box_of(vertices);
    return distance > 0 ? widened(box, distance) : box;
  });
  std::optional<detector::TrianglePair> found;
  StopGate gate([&] { return found.has_value(); });
  for_each_contact(mesh, mesh, tests, {1, &gate},
                   {[&](std::int32_t s, std::int32_t t) {
                      return !found && s != t && counts(std::min(s, t), std::max(s, t));
                    },
                    [&](std::int32_t s, std::int32_t t, int) {
                      if (!found) found = {std::min(s, t), std::max(s, t)};
                    }});
  return found;
}

}  // namespace assay::oracle
