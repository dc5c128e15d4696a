// Candidate feature pairs of two meshes (or of one with itself): those whose boxes meet and that
// share no vertex. They are found in several threads and handed to a visitor one after the other,
// never stored. The exact test of each is the caller's.
#pragma once

#include <functional>

#include "oracle/mesh/box_tree.h"
#include "oracle/mesh/mesh_features.h"
#include "oracle/parallel_chunks.h"

namespace assay::oracle {

// The box of a feature: of one, two or three vertices.
using BoxOfVertices = std::function<Box(std::span<const std::int32_t>)>;

// Boxes over the whole step. With the same positions twice: boxes at rest. REQUIRES that the
// positions outlive it.
BoxOfVertices swept_boxes(const detector::PositionsView& x_t0, const detector::PositionsView& x_t1);

// The features of one mesh, found by their boxes. The trees are built when first asked for. One
// mesh may have several of these: for example, one with the boxes of the whole step and one with
// the boxes at t=0. REQUIRES that the features outlive it.
class FeatureIndex {
 public:
  FeatureIndex(const MeshFeatures& features, BoxOfVertices box_of);
  FeatureIndex(MeshFeatures&& features, BoxOfVertices box_of) = delete;

  const MeshFeatures& features() const { return features_; }
  Box box_of(std::span<const std::int32_t> vertices) const { return box_of_(vertices); }
  const BoxTree& faces() const;
  const BoxTree& edges() const;

 private:
  template <class Features>
  std::unique_ptr<BoxTree> tree_of(const Features& features) const;

  const MeshFeatures& features_;
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
// Edges of a with edges of b; each pair once, the lower edge first, when a and b are the same
// object.
void for_each_edge_edge(const FeatureIndex& a, const FeatureIndex& b, const Workers& workers,
                        const VisitFeatures& visit);
// Edges of a with faces of b.
void for_each_edge_face(const FeatureIndex& a, const FeatureIndex& b, const Workers& workers,
                        const VisitFeatures& visit);
// Faces of a with faces of b, shared vertices or not; each pair once, the lower face first, when a
// and b are the same object.
void for_each_face_face(const FeatureIndex& a, const FeatureIndex& b, const Workers& workers,
                        const VisitFeatures& visit);

}  // namespace assay::oracle
