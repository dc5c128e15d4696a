// Finds the triangles of the mesh that the ghosts touch (L11).
#pragma once

#include <span>
#include <vector>

#include "detector/boxes/moving_box.h"
#include "detector/contact/elementary.h"
#include "detector/mesh/paced_stop.h"
#include "detector/mesh/step_counts.h"
#include "detector/mesh/surface.h"
#include "detector/search/pair_search.h"

namespace assay::detector {

// Tests, feature by feature, whether two triangles of the surface meet: mesh triangles or ghosts.
class FacePairTest {
 public:
  using Corners = std::array<std::int32_t, 3>;

  // Corners are vertices of `motion`. With piercing_at_start, two triangles also meet if an edge of
  // one pierces the other at t=0. This needs a test of its own, because their features need not
  // meet during the step.
  FacePairTest(const SteppedMesh& motion, const ElementaryTest& elementary, bool piercing_at_start)
      : motion_(motion), elementary_(elementary), pierces_too_(piercing_at_start) {}

  // Returns whether, at some time of the step, a closed face of `a` meets a closed face of `b` and
  // the two faces share no vertex. A face is a vertex, an edge or the triangle. Makes up to 15
  // elementary tests; axis order decides most of them.
  bool meet(const Corners& a, const Corners& b, GhostCounts& counts) const;

 private:
  MovingPoint path(std::int32_t v) const { return motion_.path(v); }
  bool contact(const FourPoints& query, GhostCounts& counts) const;
  bool pierces(const Corners& edges_of, const Corners& face) const;

  SteppedMesh motion_;
  const ElementaryTest& elementary_;
  bool pierces_too_;
};

// A small bounding volume tree for one hole, over the moving ghosts of its fan.
//
// The leaves have the order of the fan along its loop, so nothing needs to be sorted. Node n has
// the children 2n+1 and 2n+2; the last nodes are the leaves.
class HoleTree {
 public:
  // REQUIRES one or more ghosts of one loop, in the order of the loop. Their corners are vertices
  // of `motion`. The boxes can be compared with other boxes of the same grid. Takes 50 ns a ghost.
  HoleTree(const Topology& all, std::span<const std::int32_t> ghosts, const FloatGrid& grid,
           const SteppedMesh& motion);

  static constexpr std::size_t root = 0;
  bool is_leaf(std::size_t node) const { return node + 1 >= ghosts_.size(); }
  std::size_t child(std::size_t node) const { return 2 * node + 1; }  // the second is the next node
  std::int32_t first_ghost() const { return ghosts_.front(); }
  std::int32_t ghost(std::size_t leaf) const { return ghosts_[leaf + 1 - ghosts_.size()]; }
  const MovingBox& box(std::size_t node) const { return boxes_[node]; }

  // Calls visit(ghost) for the ghosts whose box is not apart from `box`, until a call returns true.
  // Returns whether a call returned true.
  template <class Visit>
  bool any_near(const MovingBox& box, Visit visit) const {
    return any_near(root, box, visit);
  }

 private:
  template <class Visit>
  bool any_near(std::size_t node, const MovingBox& box, Visit& visit) const {
    if (apart(boxes_[node], box)) return false;
    if (is_leaf(node)) return visit(ghost(node));
    return any_near(child(node), box, visit) || any_near(child(node) + 1, box, visit);
  }

  std::span<const std::int32_t> ghosts_;
  std::vector<MovingBox> boxes_;
};

// Returns a tree for each hole of the component that has these ghosts.
std::vector<HoleTree> make_hole_trees(const Topology& all, std::span<const std::int32_t> ghosts,
                                      const FloatGrid& grid, const SteppedMesh& motion);

// For sweeps at rest: whether a pair is left out if the triangle is on one side of the ghost's
// plane. Such a pair does not make the triangle `near` either. With `strict` the triangle has to be
// strictly on one side. With `grazing` it may also, within rounding errors, touch the plane from
// one side without lying in it; so `grazing` can leave out triangles that a ghost touches.
enum class ByPlanes : std::uint8_t { no, strict, grazing };

// The input of a sweep and its options.
struct GhostSweep {
  const Surface& surface;
  const BoundingVolumeTree& tree;  // of the mesh, refitted to the step
  SteppedMesh motion;              // rows: vertices of the mesh, then apexes
  const ElementaryTest& elementary;
  // Whether an edge that pierces a triangle at t=0 counts too. This must be true if no state is
  // known at t=0.
  bool piercing_at_start = false;
  // If not null, the sweep sets (*near)[t] to 1 for each triangle t whose moving box is not apart
  // from the box of a ghost.
  std::vector<std::uint8_t>* near = nullptr;
  // If not null, a list to which the sweep appends, once, each triangle for which it sets touched.
  std::vector<std::int32_t>* found = nullptr;
  ByPlanes by_planes = ByPlanes::no;
  // The stop function is called at the first pair, and then after each such amount of work
  // (GhostCounts::work), which is about every millisecond.
  std::uint64_t work_between_stops = PacedStop::usual_interval;
  // If not null, these workers sweep different parts of the mesh (BoundaryHandler::sweep).
  const Workers* workers = nullptr;
};

// Sets touched[t] of each mesh triangle t that a ghost of the hole touches at any time in [0,1].
// A triangle and a ghost touch if closed faces of the two that share no vertex meet; triangles next
// to the loop and degenerate ghosts are no exceptions. Only triangles of the hole's own component
// are looked at. A triangle for which `touched` is set already is not tested again. REQUIRES a hole
// tree of this step and of the grid of sweep.tree.
// Descends the hole's tree against the component's part of the mesh's tree, with up to 15
// elementary tests for each pair whose boxes meet. Returns false if `stop` returned true.
bool sweep_hole(const GhostSweep& sweep, const HoleTree& hole, const StopFunction& stop,
                std::vector<std::uint8_t>& touched, GhostCounts& counts);

// Does the same for the triangles below one node of the mesh's tree. REQUIRES that these triangles
// are of the hole's component. Sweeps below several nodes may run at the same time if none of these
// nodes is above another and sweep.found is null.
bool sweep_hole_below(std::int32_t node, const GhostSweep& sweep, const HoleTree& hole,
                      const StopFunction& stop, std::vector<std::uint8_t>& touched,
                      GhostCounts& counts);

}  // namespace assay::detector
