#include "properties/as_printed/deviations.h"

namespace assay::properties {
namespace {

using detector::GivenStep;
using detector::PairContact;
using detector::PairRule;
using detector::ReleaseRule;
using detector::StepCost;
using detector::StepMarks;
using detector::StepState;

enum Place : std::size_t { one_vertex, handled_when_not_free, reduced_u, corollary_4, released };
constexpr Deviation all[] = {
    {"one-vertex", "the view test of a triangle is that of one of its vertices",
     "view-line/one-corner"},
    {"boundary-when-not-free",
     "all triangles of the mesh positive: free; ghosts are handled only otherwise",
     "state/ghost-signs-not-asked"},
    {"u-without-violated", "U = U - Vv: (U,Vv) leaves out pairs of two violated triangles",
     "pair/u-without-violated"},
    {"corollary-4-all-pairs", "the pairs of Corollary 4 are all that can collide",
     "pair/no-closure"},
    {"release-when-free", "Vv is emptied when a step is free", "state/released-on-no-contact"},
};

detector::Stages stages_at(Place place) { return stages_with(all[place]); }

struct PrintedRule : PairRule {
  std::shared_ptr<const PairRule> k = stages_at(reduced_u).pair_rule;
  std::shared_ptr<const PairRule> closing = stages_at(corollary_4).pair_rule;
  detector::PairTables candidates() const override { return k->candidates(); }
  detector::PairTables closure() const override { return closing->closure(); }
};

struct PrintedRelease : ReleaseRule {
  std::shared_ptr<const ReleaseRule> by_view = stages_at(handled_when_not_free).release;
  std::shared_ptr<const ReleaseRule> when_free = stages_at(released).release;
  bool is_free(const GivenStep& step, const StepMarks& marks, StepCost& cost,
               std::size_t component) const override {
    return by_view->is_free(step, marks, cost, component);
  }
  bool released_at_start(const GivenStep& step, const StepMarks& marks, StepCost& cost,
                         std::size_t component) const override {
    return by_view->released_at_start(step, marks, cost, component);
  }
  // The thesis as printed releases nothing here: only a free step empties Vv.
  bool release(const GivenStep&, StepMarks&, StepCost&,
               const std::vector<std::int32_t>&) const override {
    return true;
  }
  void settle(const GivenStep& step, const StepMarks& marks, const std::vector<PairContact>& pairs,
              bool complete, StepState& state) const override {
    when_free->settle(step, marks, pairs, complete, state);
  }
};

}  // namespace

std::span<const Deviation> deviations() { return all; }

detector::Stages stages_with(const Deviation& deviation) {
  return find_fault(deviation.fault)->stages(as_printed_options);
}

detector::Stages stages_as_printed() {
  detector::Stages stages = stages_at(one_vertex);
  stages.pair_rule = std::make_shared<PrintedRule>();
  stages.release = std::make_shared<PrintedRelease>();
  return stages;
}

}  // namespace assay::properties
