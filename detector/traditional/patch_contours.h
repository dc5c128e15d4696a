// The contour of a patch: the boundary of its triangles as one closed walk of vertices.
//
// The boundary of a set of triangles consists of their directed edges after opposite ones have
// cancelled. A patch has a contour if this boundary is one walk that passes no vertex twice. So
// the following have no contour: a set that is not connected through its edges (each part would
// bring its own walk, see moving_contour.h), a closed surface, a set with a hole, one that is
// pinched at a vertex, and one that passes an edge twice in one direction.
#pragma once

#include <span>
#include <vector>

#include "detector/boxes/bounding_volume_tree.h"

namespace assay::detector {

// The vertices of a contour in the order of the walk, which runs along the triangles' own edges in
// their direction. Empty if a patch has no contour.
using Contour = std::span<const std::int32_t>;

// A directed edge: 2 times the number of the edge, plus 1 if it runs from the higher vertex to the
// lower.
using DirectedEdge = std::int32_t;

// Makes the contour of a set of triangles from its boundary.
class ContourMaker {
 public:
  explicit ContourMaker(const Topology& mesh)
      : mesh_(mesh), next_(mesh.vertex_triangles.starts.size(), none) {}
  virtual ~ContourMaker() = default;
  // Appends the contour to `out`, or nothing if there is none.
  virtual void append(std::span<const DirectedEdge> boundary, std::vector<std::int32_t>& out);

 protected:
  std::int32_t from(DirectedEdge e) const { return mesh_.edges[at(e / 2)][e % 2 ? 1 : 0]; }
  std::int32_t to(DirectedEdge e) const { return mesh_.edges[at(e / 2)][e % 2 ? 0 : 1]; }

 private:
  static constexpr std::int32_t none = -1;
  const Topology& mesh_;
  std::vector<std::int32_t> next_;  // by vertex
};

// The contours of all nodes of a tree, where a node stands for the patch of the triangles below
// it. Memory: about 50 bytes a triangle on even meshes.
class PatchContours {
 public:
  // O(M log M); more if partial boundaries are long. If `pace` was stopped they are of no use.
  PatchContours(const Topology& mesh, const BoundingVolumeTree& tree, ContourMaker& maker,
                PacedStop* pace = nullptr);

  // The contour of the node, empty if it has none.
  Contour of(std::int32_t node) const {
    const Range& range = ranges_[static_cast<std::size_t>(node)];
    return {vertices_.data() + range.begin, static_cast<std::size_t>(range.count)};
  }

 private:
  struct Builder;
  struct Range {
    std::uint32_t begin = 0, count = 0;
  };
  std::vector<Range> ranges_;
  std::vector<std::int32_t> vertices_;
};

// Joins the contours of two patches along the edges that they share.
class ContourUnion {
 public:
  explicit ContourUnion(std::size_t vertex_count) : place_(vertex_count, none) {}
  // The contour of both patches together, empty if they have none. They have one if they share one
  // run of edges, oppositely directed, and no vertex beside it. Valid until the next call.
  // O(length).
  Contour join(Contour a, Contour b);

 private:
  static constexpr std::int32_t none = -1;
  std::vector<std::int32_t> place_;  // by vertex: where `a` passes it
  std::vector<std::int32_t> joined_;
};

// A few patches of a mesh, spread over it, of which a step asks how many can be proved free (L13).
//
// They depend on the mesh alone and not on a tree. So what a step decides by them does not depend
// on the positions that the detector was made with.
struct SamplePatch {
  std::vector<std::int32_t> triangles;
  std::vector<std::int32_t> contour;  // empty if it has none
};

struct SamplePatches {
  std::vector<SamplePatch> small, medium, large;
};

// 4 to 32 patches of 12 triangles, half as many of 36 and a quarter as many of 96. A patch is
// smaller where its component ends. O(M) to clear marks, and 20 us at most.
SamplePatches sample_patches(const Topology& mesh, ContourMaker& maker);

}  // namespace assay::detector
