// The contour of a patch: the boundary of its triangles as one closed walk of vertices.
//
// The boundary of a set of triangles are its directed edges, with opposite ones cancelled. A patch
// has a contour when that boundary is one walk that passes no vertex twice. So a set that is not
// connected through its edges has none (each part would bring its own walk, see moving_contour.h),
// nor have a closed surface, a set with a hole, one that is pinched at a vertex, or one with an
// edge passed twice in one direction.
#pragma once

#include <span>
#include <vector>

#include "detector/search/bounding_volume_tree.h"

namespace assay::detector {

// Vertices in the order of the walk, which is that of the triangles' own edges.
using Contour = std::span<const std::int32_t>;

// A directed edge: 2 times its number, and 1 when it runs from the higher vertex to the lower.
using DirectedEdge = std::int32_t;

// From the boundary of a set to its contour.
class ContourMaker {
 public:
  explicit ContourMaker(const Topology& mesh)
      : mesh_(mesh), next_(mesh.vertex_triangles.starts.size(), none) {}
  virtual ~ContourMaker() = default;
  // Appends the contour to `out`, or nothing where there is none.
  virtual void append(std::span<const DirectedEdge> boundary, std::vector<std::int32_t>& out);

 protected:
  std::int32_t from(DirectedEdge e) const { return mesh_.edges[at(e / 2)][e % 2 ? 1 : 0]; }
  std::int32_t to(DirectedEdge e) const { return mesh_.edges[at(e / 2)][e % 2 ? 0 : 1]; }

 private:
  static constexpr std::int32_t none = -1;
  const Topology& mesh_;
  std::vector<std::int32_t> next_;  // by vertex
};

// Of the triangles below each node of a tree. Memory: about 50 bytes a triangle on even meshes.
class PatchContours {
 public:
  // O(M log M), more where partial boundaries are long. Of no use where `pace` was stopped.
  PatchContours(const Topology& mesh, const BoundingVolumeTree& tree, ContourMaker& maker,
                PacedStop* pace = nullptr);

  // Empty where the node has none.
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

// Two contours joined along what they share.
class ContourUnion {
 public:
  explicit ContourUnion(std::size_t vertex_count) : place_(vertex_count, none) {}
  // The contour of both patches together, empty when they have none: they must share one run of
  // edges, oppositely directed, and no vertex beside it. Valid until the next call. O(length).
  Contour join(Contour a, Contour b);

 private:
  static constexpr std::int32_t none = -1;
  std::vector<std::int32_t> place_;  // by vertex: where `a` passes it
  std::vector<std::int32_t> joined_;
};

}  // namespace assay::detector
