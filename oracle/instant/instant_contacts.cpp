#include "oracle/instant/instant_contacts.h"

#include <algorithm>
#include <atomic>

#include "oracle/instant/static_contact.h"
#include "oracle/mesh/feature_contacts.h"

namespace assay::oracle {

namespace {

using detector::TrianglePair;

FeatureTests tests_at(const Instant& instant) {
  const StaticPoints x = instant.points();
  return {[x](std::int32_t v, const Face& f) { return vertex_meets_face(x, v, f); },
          [x](const Edge& a, const Edge& b) { return edges_meet(x, a, b); },
          [x](const Edge& e, const Face& f) { return edge_pierces_face(x, e, f); }};
}

BoxOfVertices boxes_at(const Instant& instant) {
  return [&](std::span<const std::int32_t> vertices) { return instant.box_of(vertices); };
}

}  // namespace

std::vector<TrianglePair> contacts_at(const Instant& instant,
                                      const detector::TrianglesView& triangles, int jobs) {
  const MeshFeatures features = mesh_features(triangles);
  const FeatureIndex mesh(features, boxes_at(instant));
  std::vector<std::vector<TrianglePair>> found(std::max(jobs, 1));
  for_each_contact(mesh, mesh, tests_at(instant), {jobs},
                   {[](std::int32_t s, std::int32_t t) { return s != t; },
                    [&](std::int32_t s, std::int32_t t, int worker) {
                      found[worker].push_back({std::min(s, t), std::max(s, t)});
                    }});
  std::vector<TrianglePair> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

bool any_contact_at(const Instant& instant, const detector::TrianglesView& triangles, int jobs) {
  const MeshFeatures features = mesh_features(triangles);
  const FeatureIndex mesh(features, boxes_at(instant));
  std::atomic<bool> found = false;
  StopGate gate([&] { return found.load(); });
  for_each_contact(mesh, mesh, tests_at(instant), {jobs, &gate},
                   {[&](std::int32_t s, std::int32_t t) { return s != t && !found; },
                    [&](std::int32_t, std::int32_t, int) { found = true; }});
  return found;
}

std::vector<std::uint8_t> touched_at(const Instant& instant,
                                     const detector::TrianglesView& triangles,
                                     const detector::TrianglesView& ghosts,
                                     const std::vector<std::int32_t>& component, int jobs) {
  const auto count = static_cast<std::size_t>(triangles.rows());
  const MeshFeatures mesh_parts = mesh_features(triangles), fan_parts = mesh_features(ghosts);
  const FeatureIndex mesh(mesh_parts, boxes_at(instant)), fans(fan_parts, boxes_at(instant));
  const FeatureTests tests = tests_at(instant);
  // Elements are only ever set to 1, so the order of threads does not matter.
  std::vector<std::atomic<std::uint8_t>> touched(count);
  for_each_contact(mesh, mesh, tests, {jobs},
                   {[&](std::int32_t s, std::int32_t t) {
                      return s != t && component[s] == component[t] && !(touched[s] && touched[t]);
                    },
                    [&](std::int32_t s, std::int32_t t, int) { touched[s] = touched[t] = 1; }});
  for_each_contact(mesh, fans, tests, {jobs},
                   {[&](std::int32_t t, std::int32_t g) {
                      return !touched[t] && component[t] == component[count + g];
                    },
                    [&](std::int32_t t, std::int32_t, int) { touched[t] = 1; }});
  return {touched.begin(), touched.end()};
}

}  // namespace assay::oracle
