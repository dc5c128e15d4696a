// Wrong releases within a sequence: triangles that were dirty and are taken for clean too soon
// (L9).
#include <algorithm>

#include "detector/state/layers.h"
#include "detector/step/static_touches.h"
#include "properties/faults/planting.h"

namespace assay::properties {
namespace {

using detector::GivenStep;
using detector::ReleaseRule;
using detector::StepCost;
using detector::StepMarks;

using Flags = std::vector<std::uint8_t>;
using Components = std::vector<std::int32_t>;
using Triangles = std::vector<std::int32_t>;

enum class Contacts { tested, ignored };
enum class Ghosts { tested, ignored };
enum class ReleasedLayers { of_pieces, by_connection, across_touched, not_looked_at };

// The release, composed anew with parts of it missing or changed.
template <Contacts contacts, Ghosts ghosts, ReleasedLayers layers>
struct ReleaseHalfChecked : ReleaseRule {
  bool release(const GivenStep& step, StepMarks& marks, StepCost& cost,
               const Components& components) const override {
    Flags touched(marks.clean.size(), 0), seen(touched);
    const detector::FloatGrid grid(step.motion.at_start());
    if (contacts == Contacts::tested) detector::add_lasting_contacts(step, cost, touched);
    for (const auto component : components) {
      const std::size_t c = at(component);
      Triangles in_doubt;
      for (const auto t : step.own_triangles(c)) {
        if (!marks.clean[at(t)]) in_doubt.push_back(t);
      }
      if (ghosts == Ghosts::tested)
        detector::add_ghost_touches(step, cost, grid, c, in_doubt, touched);
      switch (layers) {
        case ReleasedLayers::of_pieces:
          detector::release_pieces({step.surface, step.motion.vertices_t0, touched}, c, in_doubt,
                                   witnesses(step, marks, c), seen, marks.clean);
          break;
        case ReleasedLayers::across_touched:
          release_across_touched(step, marks, c, in_doubt, touched);
          break;
        case ReleasedLayers::by_connection:
          release_connected(step, marks, in_doubt, touched);
          break;
        case ReleasedLayers::not_looked_at:
          for (const auto t : in_doubt) marks.clean[at(t)] = !touched[at(t)];
      }
    }
    return true;
  }

 private:
  // Lets pieces continue through triangles that are touched. Only the touched triangles themselves
  // stay dirty.
  void release_across_touched(const GivenStep& step, StepMarks& marks, std::size_t c,
                              const Triangles& in_doubt, const Flags& touched) const {
    const Flags nothing(touched.size(), 0);
    Flags seen(nothing);
    detector::release_pieces({step.surface, step.motion.vertices_t0, nothing}, c, in_doubt,
                             witnesses(step, marks, c), seen, marks.clean);
    for (const auto t : in_doubt) marks.clean[at(t)] &= !touched[at(t)];
  }

  // Releases a triangle if it has a clean neighbour at any edge, however many triangles meet at
  // that edge.
  static void release_connected(const GivenStep& step, StepMarks& marks, const Triangles& in_doubt,
                                const Flags& touched) {
    const auto& mesh = step.surface.mesh;
    for (bool grows = true; grows;) {
      grows = false;
      for (const auto t : in_doubt) {
        if (marks.clean[at(t)] || touched[at(t)]) continue;
        for (const auto edge : mesh.triangle_edges[at(t)]) {
          const auto around = mesh.edge_triangles.row(edge);
          marks.clean[at(t)] |= std::any_of(around.begin(), around.end(),
                                            [&](auto s) { return marks.clean[at(s)] != 0; });
        }
        grows |= marks.clean[at(t)] != 0;
      }
    }
  }
};

// Releases by a clean neighbour also triangles that a ghost or the mesh touches. Pieces still end
// at them.
struct ReleasedWhileTouched : ReleaseRule {
  bool release(const GivenStep& step, StepMarks& marks, StepCost& cost,
               const Components& components) const override {
    if (!ReleaseRule::release(step, marks, cost, components)) return false;
    const auto& mesh = step.surface.mesh;
    const Flags released = marks.clean;
    for (const auto component : components) {
      for (const auto t : step.own_triangles(at(component))) {
        for (const auto edge : mesh.triangle_edges[at(t)]) {
          for (const auto s : mesh.edge_triangles.row(edge)) marks.clean[at(t)] |= released[at(s)];
        }
      }
    }
    return true;
  }
};

// Asks for the state of a triangle by its place in the component, and so gets the answer for a
// triangle of another component.
struct WitnessesByPlace : ReleaseRule {
  Triangles witnesses(const GivenStep& step, const StepMarks& marks, std::size_t c) const override {
    Triangles found;
    const auto own = step.own_triangles(c);
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (marks.clean[i]) found.push_back(own[i]);
    }
    return found;
  }
};

}  // namespace

std::vector<Fault> release_faults() {
  using C = Contacts;
  using G = Ghosts;
  using L = ReleasedLayers;
  return {
      planted<ReleaseHalfChecked<C::tested, G::ignored, L::of_pieces>>(
          "release/blind-to-ghosts", "released without looking at the ghosts", "L9",
          "D8_release_arm_sequence", 22),
      planted<ReleaseHalfChecked<C::ignored, G::tested, L::of_pieces>>(
          "release/blind-to-contacts", "released although still in contact with the mesh", "L9",
          "F_contacts_carried", 5),
      planted<ReleaseHalfChecked<C::tested, G::tested, L::by_connection>>(
          "release/released-when-connected",
          "a clean neighbour is enough, also at an edge of four triangles", "L9",
          "F_released_by_connection", 6),
      planted<ReleaseHalfChecked<C::tested, G::tested, L::across_touched>>(
          "release/linked-across-touched", "pieces go on through triangles that touch something",
          "L9", "D8_release_arm_sequence", 22),
      planted<ReleaseHalfChecked<C::tested, G::tested, L::not_looked_at>>(
          "release/layers-not-checked", "what touches nothing is released, whatever its layer",
          "L9", "D8_release_arm_sequence", 22),
      planted<ReleasedWhileTouched>(
          "release/released-while-touched",
          "what still touches something is released beside a clean neighbour", "L9",
          "F_released_while_touched", 5),
      planted<WitnessesByPlace>(
          "release/witnesses-by-place",
          "the common layer is named by triangles whose place another component has clean", "L9",
          "F_witness_of_another", 11),
  };
}

}  // namespace assay::properties
