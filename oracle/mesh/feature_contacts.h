// Triangle pairs whose features meet, by tests that the caller chooses (at rest or over a step).
#pragma once

#include <functional>

#include "oracle/mesh/feature_pairs.h"

namespace assay::oracle {

// Exact tests of features given by their vertices.
struct FeatureTests {
  std::function<bool(std::int32_t, const Face&)> vertex_face;
  std::function<bool(const Edge&, const Edge&)> edge_edge;
  std::function<bool(const Edge&, const Face&)> piercing;  // empty: not asked
};

struct PairVisitor {
  // Features are tested only where some pair of their triangles is wanted. Both are called from
  // several threads when there are several jobs.
  std::function<bool(std::int32_t of_a, std::int32_t of_b)> wanted;
  // A pair may be met many times, by different features.
  std::function<void(std::int32_t of_a, std::int32_t of_b, int worker)> meet;
};

// Contact as detector/README.md, The laws, defines it: closed faces of the two triangles that share
// no vertex meet. With a and b the same object, triangles with the same three vertices are in
// contact too.
void for_each_contact(const FeatureIndex& a, const FeatureIndex& b, const FeatureTests& tests,
                      const Workers& workers, const PairVisitor& visitor);

}  // namespace assay::oracle
