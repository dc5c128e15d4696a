// Wrong beliefs about what a step leaves clean (L8).
#include <algorithm>

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

}  // namespace assay::properties
