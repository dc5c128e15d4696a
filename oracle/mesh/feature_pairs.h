// Candidate feature pairs of two meshes (or of one with itself): those whose boxes meet and that
// share no vertex. The exact test of each is the caller's.
#pragma once

#include <functional>

#include "oracle/mesh/box_tree.h"
#include "oracle/mesh/mesh_features.h"
#include "oracle/parallel_chunks.h"

namespace assay::oracle {

using BoxOfVertices = std::function<Box(std::span<const std::int32_t>)>;

// The features of one mesh, found by their boxes. The trees are built when first asked for.
class FeatureIndex {
 public:
  FeatureIndex(const detector::TrianglesView& triangles, BoxOfVertices box_of);

  const MeshFeatures& features() const { return features_; }
  Box box_of(std::span<const std::int32_t> vertices) const { return box_of_(vertices); }
  const BoxTree& faces() const;
  const BoxTree& edges() const;

 private:
  template <class Features>
  std::unique_ptr<BoxTree> tree_of(const Features& features) const;

  MeshFeatures features_;
  BoxOfVertices box_of_;
  mutable std::unique_ptr<BoxTree> faces_, edges_;
};

// The place of each feature in its list of the MeshFeatures; worker as in parallel_chunks.h.
using VisitFeatures = std::function<void(std::size_t item, std::size_t other, int worker)>;

struct Workers {
  int jobs = 1;
  StopGate* gate = nullptr;  // no further pair once it has stopped
};

// Vertices of a with faces of b.
void for_each_vertex_face(const FeatureIndex& a, const FeatureIndex& b, const Workers& workers,
                          const VisitFeatures& visit);
// Edges of a with edges of b; each pair once when a and b are the same object.
void for_each_edge_edge(const FeatureIndex& a, const FeatureIndex& b, const Workers& workers,
                        const VisitFeatures& visit);
// Edges of a with faces of b.
void for_each_edge_face(const FeatureIndex& a, const FeatureIndex& b, const Workers& workers,
                        const VisitFeatures& visit);

}  // namespace assay::oracle
