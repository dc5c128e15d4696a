// Wrong treatment of holes (L11): meshes taken as closed, apexes that jump, wrong sweeps of ghosts.

#include <algorithm>

#include "detector/contact/rungs.h"
#include "detector/geometry/winding.h"
#include "properties/faults/planting.h"

namespace assay::properties {

using namespace detector;  // whose stages the faults replace

namespace {

// Finds no loops if `is_closed` says so. It is given the number of triangles at each edge.
template <bool (*is_closed)(const std::vector<std::size_t>&)>
struct TakenAsClosed : BoundaryHandler {
  Surface close_up(const TrianglesView& triangles, Eigen::Index vertex_count,
                   PacedStop& pace) const override {
    Surface surface = BoundaryHandler::close_up(triangles, vertex_count, pace);
    if (pace.stopped()) return surface;
    std::vector<std::size_t> uses;
    for (std::size_t e = 0; e < surface.mesh.edges.size(); ++e) {
      uses.push_back(surface.mesh.edge_triangles.row(static_cast<std::int32_t>(e)).size());
    }
    if (!is_closed(uses)) return surface;
    surface.loops.clear();
    surface.with_ghosts = {};
    return surface;
  }
};

bool always(const std::vector<std::size_t>&) { return true; }
bool edges_used_evenly(const std::vector<std::size_t>& uses) {
  return std::ranges::all_of(uses, [](auto n) { return n % 2 == 0; });
}
bool no_edge_used_once(const std::vector<std::size_t>& uses) {
  return std::ranges::all_of(uses, [](auto n) { return n > 1; });
}

// Places the apexes as if the mesh rested where it is at one end of the step.
template <PositionsView SteppedMesh::*end>
struct ApexOfEnd : BoundaryHandler {
  std::vector<MovingPoint> place_apexes(const Surface& surface, const std::vector<ApexRule>& rules,
                                        const SteppedMesh& motion) const override {
    return BoundaryHandler::place_apexes(surface, rules, {motion.*end, motion.*end});
  }
};

// Each step chooses anew the rule that suits its start best, so an apex may jump between two
// steps.
struct ApexChosenAnew : BoundaryHandler {
  std::vector<MovingPoint> place_apexes(const Surface& surface, const std::vector<ApexRule>&,
                                        const SteppedMesh& motion) const override {
    BoundingVolumeTree tree(surface.mesh, motion.vertices_t0);
    const auto rules = choose_apexes(surface, tree, motion.vertices_t0, ElementaryTest());
    return BoundaryHandler::place_apexes(surface, rules, motion);
  }
};

struct AlwaysCentroid : BoundaryHandler {
  std::vector<ApexRule> choose_apexes(const Surface& surface, BoundingVolumeTree&,
                                      const PositionsView&, const ElementaryTest&,
                                      const StopFunction&) const override {
    return std::vector<ApexRule>(surface.loops.size(), detector::apex_rules[0]);
  }
};

}  // namespace

std::vector<Fault> boundary_faults() {
  return {
      {wrong<TakenAsClosed<always>>, "boundary/open-taken-as-closed", "L11", "D1_open_allplus", 12,
       "holes are not looked for: every mesh is taken as closed"},
      {wrong<TakenAsClosed<edges_used_evenly>>, "boundary/orientation-not-checked", "L12",
       "A5_one_face_flipped", 5,
       "a mesh is taken as closed if each edge has an even number of triangles, however oriented"},
      {wrong<TakenAsClosed<no_edge_used_once>>, "boundary/fin-taken-as-closed", "L12", "F_fin", 5,
       "a mesh is taken as closed if no edge has one triangle, even if some have three"},
      {wrong<ApexOfEnd<&SteppedMesh::vertices_t0>>, "boundary/apex-stays-behind", "L11",
       "F_apex_moves", 8, "an apex stays at its place of t=0 and jumps between two steps"},
      {wrong<ApexOfEnd<&SteppedMesh::vertices_t1>>, "boundary/apex-ahead", "L11", "F_apex_in_step",
       8, "an apex is at its place of t=1 and jumps between two steps"},
      {wrong<ApexChosenAnew>, "boundary/apex-chosen-anew", "L11", "F_apex_rule_kept", 13,
       "the rule of an apex is chosen anew at each step"},
      {wrong<AlwaysCentroid>, "boundary/always-centroid", "L11", "", 0,
       "every apex is the centroid of its loop", with_points, FaultStatus::equivalent,
       "L3 holds for every apex that moves continuously, so this choice changes only the time "
       "taken"},
  };
}

// Wrong sweeps of the ghosts: some left out, some half tested, some at the wrong place (L11).

namespace {

using Flags = std::vector<std::uint8_t>;
using GhostIndices = std::span<const std::int32_t>;
using Corners = std::array<std::int32_t, 3>;

std::ptrdiff_t common_vertices(const Corners& a, const Corners& b) {
  return std::ranges::count_if(a, [&](auto v) { return std::ranges::find(b, v) != b.end(); });
}

struct NothingSwept : BoundaryHandler {
  bool sweep(const GhostSweep&, GhostIndices, const StopFunction&, Flags&,
             GhostCounts&) const override {
    return true;
  }
};

struct OverlapAtEnds : BoundaryHandler {
  bool sweep(const GhostSweep& s, GhostIndices ghosts, const StopFunction& stop, Flags& touched,
             GhostCounts& counts) const override {
    const GhostSweep start{s.surface, s.tree, s.motion.at_start(), s.elementary, true};
    const GhostSweep end{
        s.surface, s.tree, {s.motion.vertices_t1, s.motion.vertices_t1}, s.elementary, true};
    return BoundaryHandler::sweep(start, ghosts, stop, touched, counts) &&
           BoundaryHandler::sweep(end, ghosts, stop, touched, counts);
  }
};

// The ghosts stand where they are at t=0, while the mesh goes past them.
struct GhostsNotMoved : BoundaryHandler {
  bool sweep(const GhostSweep& s, GhostIndices ghosts, const StopFunction&, Flags& touched,
             GhostCounts&) const override {
    for (const auto ghost : ghosts) {
      const auto component = s.surface.all().component_of_triangle[at(ghost)];
      for (const auto t : s.surface.mesh.components[at(component)].triangles) {
        if (!touched[at(t)]) touched[at(t)] = meet(s, ghost, t);
      }
    }
    return true;
  }

 private:
  static bool meet(const GhostSweep& s, std::int32_t ghost, std::int32_t triangle) {
    const Corners &g = s.surface.all().triangles[at(ghost)],
                  &t = s.surface.mesh.triangles[at(triangle)];
    const auto moving = [&](std::size_t i) { return s.motion.path(t[i % 3]); };
    const auto stays = [&](std::size_t i) {
      const auto place = s.motion.start(g[i % 3]);
      return MovingPoint{place, place};
    };
    const auto same = [&](std::size_t i, std::size_t j) { return g[i % 3] == t[j % 3]; };
    const auto contact = [&](const FourPoints& query) {
      return !detector::separated_along_an_axis(query) &&
             s.elementary.test(query, Want::yes_no).contact;
    };
    for (std::size_t i = 0; i < 3; ++i) {
      if (!same(i, 0) && !same(i, 1) && !same(i, 2) &&
          contact({{stays(i), moving(0), moving(1), moving(2)}, 1}))
        return true;
      if (!same(0, i) && !same(1, i) && !same(2, i) &&
          contact({{moving(i), stays(0), stays(1), stays(2)}, 1}))
        return true;
      for (std::size_t j = 0; j < 3; ++j) {
        if (same(i, j) || same(i, j + 1) || same(i + 1, j) || same(i + 1, j + 1)) continue;
        if (contact({{stays(i), stays(i + 1), moving(j), moving(j + 1)}, 2})) return true;
      }
    }
    return false;
  }
};

// Sweeps only some ghosts.
template <bool (*skips)(const GhostSweep&, std::int32_t ghost)>
struct GhostsSkipped : BoundaryHandler {
  bool sweep(const GhostSweep& s, GhostIndices ghosts, const StopFunction& stop, Flags& touched,
             GhostCounts& counts) const override {
    std::vector<std::int32_t> first_ghosts;
    std::ranges::copy_if(ghosts, std::back_inserter(first_ghosts),
                         [&](std::int32_t ghost) { return !skips(s, ghost); });
    return BoundaryHandler::sweep(s, first_ghosts, stop, touched, counts);
  }
};

bool of_later_loops(const GhostSweep& s, std::int32_t ghost) {
  return s.surface.all().triangles[at(ghost)][2] != s.surface.first_apex;
}

bool is_flat(const GhostSweep& s, std::int32_t ghost) {
  return detector::has_zero_area(s.surface.all(), s.motion.vertices_t0, ghost) ||
         detector::has_zero_area(s.surface.all(), s.motion.vertices_t1, ghost);
}

template <std::ptrdiff_t common>
struct LoopNeighboursSkipped : BoundaryHandler {
  bool sweep(const GhostSweep& s, GhostIndices ghosts, const StopFunction&, Flags& touched,
             GhostCounts& counts) const override {
    s.tree.join_boxes(nullptr);
    for (const auto ghost : ghosts) {
      Flags by_this(touched.size(), 0);
      const HoleTree alone(s.surface.all(), {&ghost, 1}, s.tree.grid(), s.motion);
      detector::sweep_hole(s, alone, {}, by_this, counts);
      for (std::size_t t = 0; t < touched.size(); ++t) {
        touched[t] |= by_this[t] && common_vertices(s.surface.all().triangles[at(ghost)],
                                                    s.surface.mesh.triangles[t]) < common;
      }
    }
    return true;
  }
};

struct VertexFaceTests : ElementaryTest {
  ContactResult test(const FourPoints& query, Want want) const override {
    return query.first_group == 1 ? detector::test_contact_past_axis(query, want) : ContactResult{};
  }
};

struct SweptVertexFaceOnly : BoundaryHandler {
  bool sweep(const GhostSweep& s, GhostIndices ghosts, const StopFunction& stop, Flags& touched,
             GhostCounts& counts) const override {
    const VertexFaceTests no_edges;
    const GhostSweep half{s.surface, s.tree, s.motion, no_edges, s.piercing_at_start};
    return BoundaryHandler::sweep(half, ghosts, stop, touched, counts);
  }
};

struct PiercedGhostsIgnored : BoundaryHandler {
  bool sweep(const GhostSweep& s, GhostIndices ghosts, const StopFunction& stop, Flags& touched,
             GhostCounts& counts) const override {
    const GhostSweep half{s.surface, s.tree, s.motion, s.elementary, false};
    return BoundaryHandler::sweep(half, ghosts, stop, touched, counts);
  }
};

// Does not sweep at a new start, as if ghosts could not touch a triangle that is clean there.
struct NewStartNotSwept : BoundaryHandler {
  bool sweep(const GhostSweep& s, GhostIndices ghosts, const StopFunction& stop, Flags& touched,
             GhostCounts& counts) const override {
    const bool moves = s.motion.vertices_t0 != s.motion.vertices_t1;
    if (moves && s.piercing_at_start) return true;
    return BoundaryHandler::sweep(s, ghosts, stop, touched, counts);
  }
};

}  // namespace

std::vector<Fault> ghost_faults() {
  return {
      {wrong<NothingSwept>, "boundary/no-ghost-sweep", "L11", "F_ghosts_swept", 12,
       "ghosts are not swept: no triangle is touched"},
      {wrong<OverlapAtEnds>, "boundary/overlap-at-ends", "L11", "F_ghosts_between_ends", 12,
       "ghosts are tested at t=0 and t=1 only"},
      {wrong<GhostsNotMoved>, "boundary/ghosts-not-moved", "L11", "F_ghosts_move", 13,
       "ghosts stay at their places of t=0"},
      {wrong<GhostsSkipped<of_later_loops>>, "boundary/first-loop-only", "L11", "F_second_loop", 6,
       "only ghosts of the first loop are swept"},
      {wrong<GhostsSkipped<is_flat>>, "boundary/flat-ghosts-skipped", "L11", "F_flat_ghost", 8,
       "a ghost without area at t=0 or t=1 is not swept"},
      {wrong<SweptVertexFaceOnly>, "boundary/swept-vertex-face-only", "L11", "F_ghost_edges", 5,
       "ghosts are swept without edge-edge tests"},
      {wrong<PiercedGhostsIgnored>, "boundary/pierced-ghosts-ignored", "L11", "F_pierced_ghost", 8,
       "triangles that pierce a ghost at a new start are not looked for"},
      {wrong<NewStartNotSwept>, "boundary/new-start-not-swept", "L11", "D8_release_arm_sequence",
       22, "ghosts are not swept in a step whose start is new"},
      {wrong<LoopNeighboursSkipped<1>>, "boundary/loop-neighbours-skipped", "L11",
       "F_loop_neighbours", 5,
       "triangles that share a vertex with a ghost are not tested against it"},
      {wrong<LoopNeighboursSkipped<2>>, "boundary/loop-edge-neighbours-skipped", "L11",
       "F_loop_edge_neighbours", 8,
       "triangles that share an edge with a ghost are not tested against it"},
  };
}

}  // namespace assay::properties
