// The thesis as printed misses contacts: each of its deviations from the laws misses a contact in
// the case that is made for it.
#include "properties/faults/fault.h"
#include "properties/judging/exam.h"
#include "tests/curated_cases.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

// The thesis as printed: the detector with those stages that its text describes and that do not
// hold, all of them together and each alone.
//
// The stages that the text takes for granted stay right: the model starts free of collisions (the
// verified start), the primitive is inside (winding number 1), times and contacts are exact. The
// wrong stages are planted faults; here they are put together.

struct Deviation {
  std::string_view name;
  std::string_view printed;  // what the text says
  std::string_view fault;    // the planted fault that does so, with its law and case
};

// The options of the scheme that the text ends with: a view-line, all pairs claimed.
constexpr detector::Options as_printed_options = {detector::Culling::view_line,
                                                  detector::Start::verified, detector::Pairs::all};

using detector::GivenStep, detector::PairContact, detector::PairRule, detector::ReleaseRule,
    detector::StepCost, detector::StepMarks, detector::StepState;

enum Place : std::size_t { one_vertex, handled_when_not_free, reduced_u, corollary_4, released };
// In the order of the text.
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

// The stages with one deviation.
detector::Stages stages_with(const Deviation& deviation) {
  return find_fault(deviation.fault)->stages(as_printed_options);
}
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

// The stages with all of them.
detector::Stages stages_as_printed() {
  detector::Stages stages = stages_at(one_vertex);
  stages.pair_rule = std::make_shared<PrintedRule>();
  stages.release = std::make_shared<PrintedRelease>();
  return stages;
}

TEST(AsPrinted, EachDeviationMissesOnItsCase) {
  ASSERT_EQ(std::size(all), 5u);
  for (const auto& deviation : all) {
    SCOPED_TRACE(deviation.name);
    const Fault* fault = find_fault(deviation.fault);
    ASSERT_NE(fault, nullptr);
    const auto c = tests::curated_case(std::string(fault->curated));
    const auto judgements = judge_case(c);
    const auto defect = [&](const detector::Stages& stages) {
      auto player = CasePlayer::make(c, as_printed_options, stages).value();
      for (std::size_t s = 0; s < player.steps(); ++s) {
        const auto diff = compare(player.play(s), judgements[s], claims_of(as_printed_options));
        if (diff.outcome != Outcome::holds) return true;
      }
      return false;
    };
    EXPECT_FALSE(defect(detector::standard_stages(as_printed_options)));
    EXPECT_TRUE(defect(stages_with(deviation)));
    EXPECT_TRUE(defect(stages_as_printed()));
  }
}

}  // namespace
}  // namespace assay::properties
