// Wrong treatment of holes: meshes taken as closed, apexes that jump (L11).
#include <algorithm>

#include "properties/faults/planting.h"

namespace assay::properties {
namespace {

using detector::BoundaryHandler;
using detector::MovingPoint;
using detector::PositionsView;
using detector::SteppedMesh;
using detector::Surface;

// Finds no loops if `is_closed` says so. It is given the number of triangles at each edge.
template <bool (*is_closed)(const std::vector<std::size_t>&)>
struct TakenAsClosed : BoundaryHandler {
  Surface close_up(const detector::TrianglesView& triangles, Eigen::Index vertex_count,
                   detector::PacedStop& pace) const override {
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
  return std::all_of(uses.begin(), uses.end(), [](auto n) { return n % 2 == 0; });
}
bool no_edge_used_once(const std::vector<std::size_t>& uses) {
  return std::all_of(uses.begin(), uses.end(), [](auto n) { return n > 1; });
}

struct ApexStaysBehind : BoundaryHandler {
  std::vector<MovingPoint> place_apexes(const Surface& surface,
                                        const std::vector<detector::ApexRule>& rules,
                                        const SteppedMesh& motion) const override {
    return BoundaryHandler::place_apexes(surface, rules, motion.at_start());
  }
};

struct ApexAhead : BoundaryHandler {
  std::vector<MovingPoint> place_apexes(const Surface& surface,
                                        const std::vector<detector::ApexRule>& rules,
                                        const SteppedMesh& motion) const override {
    return BoundaryHandler::place_apexes(surface, rules, {motion.vertices_t1, motion.vertices_t1});
  }
};

// Each step chooses anew the rule that suits its start best, so an apex may jump between two
// steps.
struct ApexChosenAnew : BoundaryHandler {
  std::vector<MovingPoint> place_apexes(const Surface& surface,
                                        const std::vector<detector::ApexRule>&,
                                        const SteppedMesh& motion) const override {
    detector::BoundingVolumeTree tree(surface.mesh, motion.vertices_t0);
    const auto rules = choose_apexes(surface, tree, motion.vertices_t0, detector::ElementaryTest());
    return BoundaryHandler::place_apexes(surface, rules, motion);
  }
};

struct AlwaysCentroid : BoundaryHandler {
  std::vector<detector::ApexRule> choose_apexes(const Surface& surface,
                                                detector::BoundingVolumeTree&, const PositionsView&,
                                                const detector::ElementaryTest&,
                                                const detector::StopFunction&) const override {
    return std::vector<detector::ApexRule>(surface.loops.size(), detector::apex_rules[0]);
  }
};

}  // namespace

std::vector<Fault> boundary_faults() {
  return {
      planted<TakenAsClosed<always>>("boundary/open-taken-as-closed",
                                     "holes are not looked for: every mesh is taken as closed",
                                     "L11", "D1_open_allplus", 12),
      planted<TakenAsClosed<edges_used_evenly>>(
          "boundary/orientation-not-checked",
          "a mesh with an even number of triangles at each edge is taken as closed, however they "
          "are oriented",
          "L12", "A5_one_face_flipped", 5),
      planted<TakenAsClosed<no_edge_used_once>>(
          "boundary/fin-taken-as-closed",
          "a mesh without an edge of one triangle alone is taken as closed: three at an edge are "
          "no cycle",
          "L12", "F_fin", 5),
      planted<ApexStaysBehind>("boundary/apex-stays-behind",
                               "an apex stays where it is at t=0 and jumps between two steps",
                               "L11", "F_apex_moves", 8),
      planted<ApexAhead>("boundary/apex-ahead",
                         "an apex is where it is at t=1 and jumps between two steps", "L11",
                         "F_apex_in_step", 8),
      planted<ApexChosenAnew>("boundary/apex-chosen-anew",
                              "the rule of an apex is chosen anew at each step", "L11",
                              "F_apex_rule_kept", 13),
      unseen<AlwaysCentroid>(FaultStatus::equivalent, "boundary/always-centroid",
                             "every apex is the centroid of its loop", "L11",
                             "the proof of L3 asks for an apex that moves continuously and not "
                             "where: the choice costs "
                             "time only"),
  };
}

}  // namespace assay::properties
