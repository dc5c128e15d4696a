// Wrong beliefs about what a step leaves clean (L8), and wrong releases (L9).

#include <algorithm>

#include "detector/state/layers.h"
#include "detector/step/release_rule.h"
#include "properties/faults/planting.h"

namespace assay::properties {

namespace {

using detector::GivenStep;
using detector::PairContact;
using detector::ReleaseRule;
using detector::StepCost;
using detector::StepMarks;
using detector::StepState;

// What the step leaves behind is computed from a start at which too much is believed clean, or
// from a step that is made to have seen too little.
struct DirtyNotCarried : ReleaseRule {
  void settle(const GivenStep& step, const StepMarks& marks, const std::vector<PairContact>& pairs,
              bool complete, StepState& state) const override {
    StepMarks forgetful = marks;
    forgetful.clean.assign(marks.clean.size(), 1);
    ReleaseRule::settle(step, forgetful, pairs, complete, state);
  }
};

struct ViolatedNotCarried : ReleaseRule {
  void settle(const GivenStep& step, const StepMarks& marks, const std::vector<PairContact>& pairs,
              bool complete, StepState& state) const override {
    StepMarks forgetful = marks;
    forgetful.touched.assign(marks.touched.size(), 0);
    ReleaseRule::settle(step, forgetful, pairs, complete, state);
  }
};

struct ReleasedOnNoContact : ReleaseRule {
  void settle(const GivenStep& step, const StepMarks& marks, const std::vector<PairContact>& pairs,
              bool complete, StepState& state) const override {
    ReleaseRule::settle(step, marks, pairs, complete, state);
    if (pairs.empty()) std::fill(state.clean.begin(), state.clean.end(), 1);
  }
};

struct ContactsNotCarried : ReleaseRule {
  void settle(const GivenStep& step, const StepMarks& marks, const std::vector<PairContact>&, bool,
              StepState& state) const override {
    ReleaseRule::settle(step, marks, {}, true, state);
  }
};

struct OneSideDirty : ReleaseRule {
  void settle(const GivenStep& step, const StepMarks& marks, const std::vector<PairContact>& pairs,
              bool, StepState& state) const override {
    ReleaseRule::settle(step, marks, {}, true, state);
    for (const auto& contact : pairs) {
      state.clean[at(contact.pair.a)] = 0;
      state.met.push_back(contact.pair);
    }
  }
};

struct FirstPairsAreAll : ReleaseRule {
  void settle(const GivenStep& step, const StepMarks& marks, const std::vector<PairContact>& pairs,
              bool, StepState& state) const override {
    ReleaseRule::settle(step, marks, pairs, true, state);
  }
};

// After a step without views, an open component becomes dirty only if the step found a contact.
struct LostByContactAlone : ReleaseRule {
  bool knows_clean(const GivenStep& step, const std::vector<PairContact>& pairs,
                   std::size_t c) const override {
    return pairs.empty() || ReleaseRule::knows_clean(step, pairs, c);
  }
};

// Carries clean bits through a step without views as through any other step, whether or not there
// are ghosts.
struct CarriedPastGhosts : ReleaseRule {
  bool knows_clean(const GivenStep&, const std::vector<PairContact>&, std::size_t) const override {
    return true;
  }
};

// A triangle that the step before did not find in contact is not tested against the ghosts either.
struct OnlyMetAgainstGhosts : ReleaseRule {
  std::vector<std::int32_t> may_touch_ghosts(
      const GivenStep& step, const std::vector<std::int32_t>& in_doubt) const override {
    std::vector<std::int32_t> met;
    const auto is_met = [&](std::int32_t t) {
      return std::any_of(step.known->met.begin(), step.known->met.end(),
                         [&](const auto& pair) { return pair.a == t || pair.b == t; });
    };
    std::copy_if(in_doubt.begin(), in_doubt.end(), std::back_inserter(met), is_met);
    return met;
  }
};

struct KeptElsewhere : ReleaseRule {
  bool still_holds(const StepState&, const detector::PositionsView&,
                   const detector::PacedStop&) const override {
    return true;
  }
};

// Uses what an evaluation found, although it was not committed, in the next evaluation from the
// same place: if that place was seen to be free, nothing there is taken for dirty.
class EvaluationKept : public ReleaseRule {
 public:
  void settle(const GivenStep& step, const StepMarks& marks, const std::vector<PairContact>& pairs,
              bool complete, StepState& state) const override {
    ReleaseRule::settle(step, marks, pairs, complete, state);
    free_from_.resize(pairs.empty() ? step.motion.size() : 0, 3);
    if (pairs.empty()) free_from_ = step.motion.vertices_t0;
  }
  bool release(const GivenStep& step, StepMarks& marks, StepCost& cost,
               const std::vector<std::int32_t>& components) const override {
    if (!ReleaseRule::release(step, marks, cost, components)) return false;
    const bool is_known =
        free_from_.rows() == step.motion.size() && free_from_ == step.motion.vertices_t0;
    if (is_known) std::fill(marks.clean.begin(), marks.clean.end(), 1);
    return true;
  }

 private:
  mutable detector::Positions free_from_;
};

constexpr detector::Options auto_views = {detector::Culling::view_auto, detector::Start::verified,
                                          detector::Pairs::all};
constexpr detector::Options first_pairs = {detector::Culling::view_point, detector::Start::verified,
                                           detector::Pairs::first};

}  // namespace

std::vector<Fault> state_faults() {
  return {
      planted<DirtyNotCarried>("state/dirty-not-carried",
                               "doubt of a step's start does not outlive the step", "L8",
                               "F_doubt_carried", 6),
      planted<ViolatedNotCarried>("state/violated-not-carried",
                                  "what a ghost touched is clean in the next step", "L8",
                                  "D8_release_arm_sequence", 22),
      planted<ReleasedOnNoContact>("state/released-on-no-contact",
                                   "a step without contact releases everything", "L8",
                                   "D8_release_arm_sequence", 22),
      planted<ContactsNotCarried>("state/contacts-not-carried",
                                  "what was in contact is clean in the next step", "L8",
                                  "F_contacts_carried", 5),
      planted<OneSideDirty>("state/one-side-dirty",
                            "of a pair in contact only the lower triangle gets dirty", "L8",
                            "F_contacts_carried", 5),
      planted<FirstPairsAreAll>("state/first-pairs-are-all",
                                "after a collision found by K alone the rest is taken for clean",
                                "L8", "F_first_pairs_only", 6, first_pairs),
      planted<LostByContactAlone>(
          "state/lost-by-contact-alone",
          "after a free step without views an open component is believed as clean as before", "L8",
          "F_views_dropped", 47, auto_views),
      planted<CarriedPastGhosts>("state/carried-past-ghosts",
                                 "what was clean is clean after a step that swept no ghosts", "L15",
                                 "F_views_dropped", 47, auto_views),
      planted<OnlyMetAgainstGhosts>(
          "state/only-met-against-ghosts",
          "only triangles of the pairs that were found are tested against ghosts at the next start",
          "L15", "F_views_dropped", 47, auto_views),
      planted<KeptElsewhere>("state/kept-elsewhere",
                             "the state is kept although the step starts at other positions", "L8",
                             "F_start_elsewhere", 6),
      planted<EvaluationKept>("state/evaluation-kept",
                              "a free evaluation that was not committed releases what is dirty",
                              "L8", "F_evaluation_kept", 6),
  };
}

// Wrong releases within a sequence: triangles that were dirty and are taken for clean too soon
// (L9).

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
