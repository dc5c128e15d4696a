// The contour test over a step: proves that the projection of a patch's contour stays simple.
//
// **L13** *Let P be a set of triangles and d a direction with N(t).d > 0 for all triangles of P at
// every t of the step. Let P's boundary be one closed walk whose projection along d is a simple
// polygon at every t. Then no two triangles of P are in contact during the step.*
//
// Proof. At a time t project P along d. All triangles keep their orientation. So for almost every
// point y of the plane, the number of projected triangles that contain y is the winding number of
// the projected boundary around y (inner edges cancel). The winding number of a simple polygon
// around a point is 0 or 1 (and not -1, because counts are not negative). So the projected
// triangles do not overlap.
//
// Take P as a set of triangles joined at their common vertices. Suppose that two different points p
// and q of P have the same projection y. If p is not on the boundary, the triangles around p cover
// a whole neighbourhood of y: if they ended at an edge or at a vertex the count would change there,
// but it changes only at the boundary. The triangle of q covers some of that neighbourhood too. It
// is not one of the triangles around p, because the projection of a triangle is one to one. So
// there is an overlap, which was excluded. Hence p is on the boundary, and for the same reason q is
// on the boundary. But the projection of the boundary is one to one. So there are no such p and q.
// Two faces without a common vertex that meet would contain such points.
//
// A set P with such a boundary is connected and a manifold (Contour), so L13 need not require this.
//
// If doubles cannot tell whether the contour crosses itself, nothing is proved.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "detector/boxes/bounding_volume_tree.h"
#include "detector/exact/bernstein.h"

namespace assay::detector {

// The contour of a patch: the boundary of its triangles as one closed walk of vertices.
//
// The boundary of a set of triangles consists of their directed edges after opposite edges have
// cancelled. A patch has a contour if this boundary is one walk that passes no vertex twice. So the
// following have no contour: a set that is not connected through its edges (each part has a walk of
// its own), a closed surface, a set with a hole, a set that is pinched at a vertex, and a set that
// passes an edge twice in the same direction.

// The vertices of a contour in the order of the walk, which passes edges in the direction in which
// the triangles pass them. Empty if a patch has no contour.
using Contour = std::span<const std::int32_t>;

// A directed edge: 2 times the number of the edge, plus 1 if it runs from its higher to its lower
// vertex.
using DirectedEdge = std::int32_t;

// Makes the contour of a set of triangles from its boundary.
class ContourMaker {
 public:
  explicit ContourMaker(const Topology& mesh)
      : mesh_(mesh), next_(mesh.vertex_triangles.starts.size(), none) {}
  virtual ~ContourMaker() = default;
  // Appends the contour to `out`; appends nothing if there is no contour.
  virtual void append(std::span<const DirectedEdge> boundary, std::vector<std::int32_t>& out);

 protected:
  std::int32_t from(DirectedEdge e) const { return mesh_.edges[at(e / 2)][e % 2 ? 1 : 0]; }
  std::int32_t to(DirectedEdge e) const { return mesh_.edges[at(e / 2)][e % 2 ? 0 : 1]; }

 private:
  static constexpr std::int32_t none = -1;
  const Topology& mesh_;
  std::vector<std::int32_t> next_;  // by vertex
};

// The contours of all nodes of a tree. The patch of a node is the set of triangles below it.
// Memory: about 50 bytes a triangle on even meshes.
class PatchContours {
 public:
  // Takes O(M log M) time, and more if the boundaries of patches are long. If `pace` was stopped,
  // this object must not be used.
  PatchContours(const Topology& mesh, const BoundingVolumeTree& tree, ContourMaker& maker,
                PacedStop* pace = nullptr);

  // Returns the contour of the node; empty if it has no contour.
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
  // Returns the contour of the union of both patches; empty if it has no contour. The union has a
  // contour if the patches share one run of edges, oppositely directed, and no vertex outside that
  // run. The result is valid until the next call. O(length).
  Contour join(Contour a, Contour b);

 private:
  static constexpr std::int32_t none = -1;
  std::vector<std::int32_t> place_;  // by vertex: its index in `a`
  std::vector<std::int32_t> joined_;
};

// One of a few patches that are spread over a mesh. A step computes how many of these patches can
// be proved free (L13).
//
// The sample patches depend only on the mesh, not on a tree. So decisions of a step that use them
// do not depend on the positions with which the detector was made.
struct SamplePatch {
  std::vector<std::int32_t> triangles;
  std::vector<std::int32_t> contour;  // empty if the patch has no contour
};

struct SamplePatches {
  std::vector<SamplePatch> small, medium, large;
};

// Returns 4 to 32 patches of 12 triangles, half as many patches of 36, and a quarter as many of 96.
// A patch has fewer triangles if its component has no more. Takes O(M) to clear marks, and at most
// 20 us in addition.
SamplePatches sample_patches(const Topology& mesh, ContourMaker& maker);

// The directions d of a fixed set that a triangle faces over a whole step: N(t).d > 0 at every t.
//
// A normal cone of [VMT94] serves one purpose: to show that there is a direction d with N.d > 0 for
// all triangles of a patch. Instead of a cone, this file stores the set of these directions d, out
// of 50 fixed directions. The set of the union of two patches is the intersection of their sets.
// Such sets are exact, need no normalization, and lose nothing when patches are merged. A patch has
// a normal cone if its set is not empty.
//
// Bit 2i is the direction of axis i, and bit 2i+1 is the opposite direction.
using DirectionSet = std::uint64_t;

inline constexpr int facing_axes = 25;
inline constexpr int facing_directions = 2 * facing_axes;

// The coordinates of a direction are 0, 1, -1, 2 or -2, so products with them are exact.
using Direction = std::array<double, 3>;
Direction direction(int bit);

// Returns the directions that a triangle faces at every t of the step. Leaves out a direction if
// doubles cannot tell. The set is empty if the triangle has no area at some time. 0.1 us.
DirectionSet faced_directions(const std::array<MovingPoint, 3>& triangle);

// Returns the bit of the direction in `set` that is nearest to `vector`. REQUIRES that `set` is not
// empty.
int nearest_direction(DirectionSet set, const Vector& vector);

class MovingContour {
 public:
  explicit MovingContour(const SteppedMesh& motion) : motion_(motion) {}
  const SteppedMesh& motion() const { return motion_; }

  // Returns true only if it is proved that the contour, projected along the direction of this bit,
  // is a simple polygon at every t of the step. Takes O(length) if the contour is nearly convex, at
  // worst O(length^2).
  bool stays_simple(Contour contour, int direction_bit);

  // Returns the vector of the area that the contour encloses at t=0.5, up to rounding errors. The
  // result is used only to choose a direction.
  Vector area(Contour contour) const;

  // From now on, stays_simple() counts the work for long contours in `pace`. If `pace` is stopped,
  // stays_simple() returns false.
  void ask(PacedStop* pace) { pace_ = pace; }

 private:
  // Bounds along the two axes of the projection plane, at t=0 (elements 0, 1) and at t=1 (elements
  // 2, 3).
  struct Box {
    std::array<double, 4> lo, hi;
  };
  // The edges first, ..., first + count - 1 of the contour. The boxes of a chain begin at
  // boxes_[box]: its own box, then the boxes of its first half, then the boxes of its second half.
  struct Chain {
    std::size_t first, count, box;
    Chain first_half() const { return {first, count / 2, box + 1}; }
    Chain second_half() const {
      return {first + count / 2, count - count / 2, box + 2 * (count / 2)};
    }
  };
  struct Flat {  // the difference of two projected vertices, at t=0 and at t=1
    std::array<double, 2> t0, t1;
  };
  static bool apart(const Box& a, const Box& b);
  void make_boxes(const Chain& chain);
  bool is_simple(const Chain& chain) const;
  bool keeps_apart(const Chain& a, const Chain& b) const;
  bool edges_keep_apart(std::size_t i, std::size_t j) const;
  bool corner_stays_open(std::size_t i) const;  // the corner is that of the edges at vertex i
  Flat flat(std::int32_t p, std::int32_t q, std::array<double, 2>& magnitude) const;
  std::size_t next(std::size_t i) const { return i + 1 == contour_.size() ? 0 : i + 1; }

  const SteppedMesh motion_;
  PacedStop* pace_ = nullptr;
  // The contour of the present call of stays_simple().
  Contour contour_;
  Direction d_ = {0, 0, 0};
  std::array<Eigen::Index, 3> axis_ = {0, 0, 0};
  std::vector<Box> boxes_, points_;
};

}  // namespace assay::detector
