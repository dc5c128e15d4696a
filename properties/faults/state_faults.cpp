// Wrong decisions about which triangles are clean after a step (L8), and wrong releases (L9).

#include <algorithm>

#include "detector/state/layers.h"
#include "detector/step/release_rule.h"
#include "properties/faults/planting.h"

namespace assay::properties {

using namespace detector;  // whose stages the faults replace

namespace {

using PairList = std::vector<PairContact>;

// Computes the state behind a step from a start at which too much is believed clean, or from too
// few of the step's findings.
template <void (*forget)(StepMarks&, PairList&, bool& complete)>
struct Forgotten : ReleaseRule {
  void settle(const GivenStep& step, const StepMarks& marks, const PairList& pairs, bool complete,
              StepState& state) const override {
    StepMarks first_marks = marks;
    PairList first_pairs = pairs;
    forget(first_marks, first_pairs, complete);
    ReleaseRule::settle(step, first_marks, first_pairs, complete, state);
  }
};

void dirty(StepMarks& marks, PairList&, bool&) { marks.clean.assign(marks.clean.size(), 1); }
void violated(StepMarks& marks, PairList&, bool&) { marks.touched.assign(marks.touched.size(), 0); }
void contacts(StepMarks&, PairList& pairs, bool& complete) {
  pairs.clear();
  complete = true;
}
void later_pairs(StepMarks&, PairList&, bool& complete) { complete = true; }

struct ReleasedOnNoContact : ReleaseRule {
  void settle(const GivenStep& step, const StepMarks& marks, const PairList& pairs, bool complete,
              StepState& state) const override {
    ReleaseRule::settle(step, marks, pairs, complete, state);
    if (pairs.empty()) std::ranges::fill(state.clean, 1);
  }
};

struct OneSideDirty : ReleaseRule {
  void settle(const GivenStep& step, const StepMarks& marks, const PairList& pairs, bool,
              StepState& state) const override {
    ReleaseRule::settle(step, marks, {}, true, state);
    for (const auto& contact : pairs) {
      state.clean[at(contact.pair.a)] = 0;
      state.contacts.push_back(contact.pair);
    }
  }
};

// After a step without views, an open component becomes dirty only if the step found a contact.
struct LostByContactAlone : ReleaseRule {
  bool knows_clean(const GivenStep& step, const PairList& pairs, std::size_t c) const override {
    return pairs.empty() || ReleaseRule::knows_clean(step, pairs, c);
  }
};

// Carries clean bits through a step without views as through any other step, whether or not there
// are ghosts.
struct CarriedPastGhosts : ReleaseRule {
  bool knows_clean(const GivenStep&, const PairList&, std::size_t) const override { return true; }
};

// Tests against the ghosts only those triangles that the step before found in contact.
struct OnlyMetAgainstGhosts : ReleaseRule {
  std::vector<std::int32_t> may_touch_ghosts(
      const GivenStep& step, const std::vector<std::int32_t>& in_doubt) const override {
    std::vector<std::int32_t> triangles;
    const auto is_met = [&](std::int32_t t) {
      return std::ranges::any_of(step.last_state->contacts,
                                 [&](const auto& pair) { return pair.a == t || pair.b == t; });
    };
    std::ranges::copy_if(in_doubt, std::back_inserter(triangles), is_met);
    return triangles;
  }
};

struct KeptElsewhere : ReleaseRule {
  bool still_holds(const StepState&, const PositionsView&, const PacedStop&) const override {
    return true;
  }
};

// Keeps the findings of an uncommitted evaluation for the next evaluation from the same place: if
// that place was found free, nothing there is taken for dirty.
class EvaluationKept : public ReleaseRule {
 public:
  void settle(const GivenStep& step, const StepMarks& marks, const PairList& pairs, bool complete,
              StepState& state) const override {
    ReleaseRule::settle(step, marks, pairs, complete, state);
    free_from_.resize(pairs.empty() ? step.motion.size() : 0, 3);
    if (pairs.empty()) free_from_ = step.motion.vertices_t0;
  }
  bool release(const GivenStep& step, StepMarks& marks, StepCost& cost,
               const std::vector<std::int32_t>& components) const override {
    if (!ReleaseRule::release(step, marks, cost, components)) return false;
    const bool is_known =
        free_from_.rows() == step.motion.size() && free_from_ == step.motion.vertices_t0;
    if (is_known) std::ranges::fill(marks.clean, 1);
    return true;
  }

 private:
  mutable Positions free_from_;
};

constexpr Options auto_views{Culling::view_auto};
constexpr Options first_pairs = {Culling::view_point, Start::verified, Pairs::first};

}  // namespace

std::vector<Fault> state_faults() {
  return {
      {wrong<Forgotten<dirty>>, "state/dirty-not-carried", "L8", "F_doubt_carried", 6,
       "triangles dirty at the start of a step are clean after it"},
      {wrong<Forgotten<violated>>, "state/violated-not-carried", "L8", "D8_release_arm_sequence",
       22, "triangles that a ghost touched are clean in the next step"},
      {wrong<ReleasedOnNoContact>, "state/released-on-no-contact", "L8", "D8_release_arm_sequence",
       22, "a step without contact releases everything"},
      {wrong<Forgotten<contacts>>, "state/contacts-not-carried", "L8", "F_contacts_carried", 5,
       "triangles that were in contact are clean in the next step"},
      {wrong<OneSideDirty>, "state/one-side-dirty", "L8", "F_contacts_carried", 5,
       "only the lower-numbered triangle of a pair in contact gets dirty"},
      {wrong<Forgotten<later_pairs>>, "state/first-pairs-are-all", "L8", "F_first_pairs_only", 6,
       "after a collision, if only K was searched, triangles with no pair are clean", first_pairs},
      {wrong<LostByContactAlone>, "state/lost-by-contact-alone", "L8", "F_views_dropped", 47,
       "after a free step without views, clean triangles of an open component stay clean",
       auto_views},
      {wrong<CarriedPastGhosts>, "state/carried-past-ghosts", "L15", "F_views_dropped", 47,
       "clean triangles stay clean after a step that swept no ghosts", auto_views},
      {wrong<OnlyMetAgainstGhosts>, "state/only-met-against-ghosts", "L15", "F_views_dropped", 47,
       "only triangles of pairs in contact are tested against ghosts at the next start",
       auto_views},
      {wrong<KeptElsewhere>, "state/kept-elsewhere", "L8", "F_start_elsewhere", 6,
       "the state is kept although the step starts at other positions"},
      {wrong<EvaluationKept>, "state/evaluation-kept", "L8", "F_evaluation_kept", 6,
       "a free evaluation that was not committed releases dirty triangles"},
  };
}

// Wrong releases within a sequence: triangles that were dirty and are taken for clean too soon
// (L9).

namespace {

using Flags = std::vector<std::uint8_t>;

enum class Contacts { tested, ignored };
enum class Ghosts { tested, ignored };
enum class ReleasedLayers { of_pieces, by_connection, across_touched, not_looked_at };

// The release, composed anew with parts of it missing or changed.
template <Contacts contacts, Ghosts ghosts, ReleasedLayers layers>
struct ReleaseHalfChecked : ReleaseRule {
  bool release(const GivenStep& step, StepMarks& marks, StepCost& cost,
               const Numbers& components) const override {
    Flags touched(marks.clean.size(), 0), is_seen(touched);
    const FloatGrid grid(step.motion.at_start());
    if (contacts == Contacts::tested) detector::add_lasting_contacts(step, cost, touched);
    for (const auto component : components) {
      const std::size_t c = at(component);
      Numbers in_doubt;
      for (const auto t : step.own_triangles(c)) {
        if (!marks.clean[at(t)]) in_doubt.push_back(t);
      }
      if (ghosts == Ghosts::tested)
        detector::add_ghost_touches(step, cost, grid, c, in_doubt, touched);
      switch (layers) {
        case ReleasedLayers::of_pieces:
          detector::release_pieces({step.surface, step.motion.vertices_t0, touched}, c, in_doubt,
                                   witnesses(step, marks, c), is_seen, marks.clean);
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
                              const Numbers& in_doubt, const Flags& touched) const {
    const Flags nothing(touched.size(), 0);
    Flags is_seen(nothing);
    detector::release_pieces({step.surface, step.motion.vertices_t0, nothing}, c, in_doubt,
                             witnesses(step, marks, c), is_seen, marks.clean);
    for (const auto t : in_doubt) marks.clean[at(t)] &= !touched[at(t)];
  }

  // Releases a triangle if it has a clean neighbour at any edge, however many triangles meet at
  // that edge.
  static void release_connected(const GivenStep& step, StepMarks& marks, const Numbers& in_doubt,
                                const Flags& touched) {
    const auto& mesh = step.surface.mesh;
    for (bool grows = true; grows;) {
      grows = false;
      for (const auto t : in_doubt) {
        if (marks.clean[at(t)] || touched[at(t)]) continue;
        for (const auto edge : mesh.triangle_edges[at(t)]) {
          const auto around = mesh.edge_triangles.row(edge);
          marks.clean[at(t)] |=
              std::ranges::any_of(around, [&](auto s) { return marks.clean[at(s)] != 0; });
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
               const Numbers& components) const override {
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
  Numbers witnesses(const GivenStep& step, const StepMarks& marks, std::size_t c) const override {
    Numbers triangles;
    const auto own = step.own_triangles(c);
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (marks.clean[i]) triangles.push_back(own[i]);
    }
    return triangles;
  }
};

}  // namespace

std::vector<Fault> release_faults() {
  using C = Contacts;
  using G = Ghosts;
  using L = ReleasedLayers;
  return {
      {wrong<ReleaseHalfChecked<C::tested, G::ignored, L::of_pieces>>, "release/blind-to-ghosts",
       "L9", "D8_release_arm_sequence", 22, "triangles are released without a test against ghosts"},
      {wrong<ReleaseHalfChecked<C::ignored, G::tested, L::of_pieces>>, "release/blind-to-contacts",
       "L9", "F_contacts_carried", 5, "triangles in contact with the mesh are released"},
      {wrong<ReleaseHalfChecked<C::tested, G::tested, L::by_connection>>,
       "release/released-when-connected", "L9", "F_released_by_connection", 6,
       "a triangle is released beside a clean neighbour, even at an edge of four triangles"},
      {wrong<ReleaseHalfChecked<C::tested, G::tested, L::across_touched>>,
       "release/linked-across-touched", "L9", "D8_release_arm_sequence", 22,
       "connected pieces of untouched triangles continue through triangles that touch something"},
      {wrong<ReleaseHalfChecked<C::tested, G::tested, L::not_looked_at>>,
       "release/layers-not-checked", "L9", "D8_release_arm_sequence", 22,
       "a triangle that touches nothing is released, whatever its layer"},
      {wrong<ReleasedWhileTouched>, "release/released-while-touched", "L9",
       "F_released_while_touched", 5,
       "a triangle that touches something is released beside a clean neighbour"},
      {wrong<WitnessesByPlace>, "release/witnesses-by-place", "L9", "F_witness_of_another", 11,
       "the common layer is read from triangles of another component at the same places"},
  };
}

}  // namespace assay::properties
