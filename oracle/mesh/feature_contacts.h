// Triangle pairs whose features meet, by tests that the caller chooses (at rest or over a step).
#pragma once

#include <functional>

#include "oracle/mesh/feature_pairs.h"

namespace assay::oracle {

// Exact tests of two features, each given by its vertices: whether they meet.
struct FeatureTests {
  std::function<bool(std::int32_t, const Face&)> vertex_face;
  std::function<bool(const Edge&, const Edge&)> edge_edge;
  std::function<bool(const Edge&, const Face&)> piercing;  // empty: not asked
};

struct PairVisitor {
  // Says whether a contact of these two triangles matters. Two features are tested only if it does
  // for some pair of triangles that hold them. With several jobs both functions are called from
  // several threads.
  std::function<bool(std::int32_t of_a, std::int32_t of_b)> wanted;
  // Called for each wanted pair in contact; often several times, because different features meet.
  std::function<void(std::int32_t of_a, std::int32_t of_b, int worker)> meet;
};

// Finds the pairs in contact, a triangle of a with one of b, as detector/README.md, The laws,
// defines contact: closed faces of the two triangles that share no vertex meet. If a and b are the
// same object, triangles with the same three vertices are in contact too.
void for_each_contact(const FeatureIndex& a, const FeatureIndex& b, const FeatureTests& tests,
                      const Workers& workers, const PairVisitor& visitor);

}  // namespace assay::oracle
