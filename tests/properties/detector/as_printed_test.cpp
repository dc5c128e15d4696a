// The thesis as printed misses, each deviation on its case; and how often, over random cases.
#include <fmt/format.h>

#include "properties/faults/fault.h"
#include "properties/generators/draft.h"
#include "properties/generators/families.h"
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

// One detector over all steps. A missed step is counted once, under the worst that befell it.
struct TollRow {
  std::string name;
  std::uint64_t silent = 0;      // answered free, although there is a contact
  std::uint64_t late = 0;        // answered collision with a late first time
  std::uint64_t incomplete = 0;  // the first time is right, but pairs are missing
  std::uint64_t pairs_missing = 0;
  std::uint64_t candidates = 0;
  // Milliseconds of the steps without their view tests, because a deviation computes its own in
  // exact numbers. Not deterministic.
  double ms = 0;
};

struct TollTable {
  std::uint64_t cases = 0, steps = 0, colliding = 0, pairs = 0;  // counted by the oracle
  std::vector<TollRow> rows;  // the right detector, each deviation alone, all of them together
};

using detector::GivenStep;
using detector::PairContact;
using detector::PairRule;
using detector::ReleaseRule;
using detector::StepCost;
using detector::StepMarks;
using detector::StepState;

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

struct Assembly {
  std::string name;
  detector::Stages stages;
};

std::vector<Assembly> assemblies() {
  std::vector<Assembly> out = {{"as it should be", detector::standard_stages(as_printed_options)}};
  for (const auto& deviation : all) {
    out.push_back({std::string(deviation.name), stages_with(deviation)});
  }
  out.push_back({"as printed", stages_as_printed()});
  return out;
}

std::vector<detector::StepResult> results_of(const corpus::Case& c,
                                             const detector::Stages& stages) {
  auto player = CasePlayer::make(c, as_printed_options, stages).value();
  std::vector<detector::StepResult> results;
  for (std::size_t s = 0; s < player.steps(); ++s) results.push_back(player.play(s));
  return results;
}

void count(const detector::StepResult& result, const oracle::StepJudgement& judgement,
           TollRow& row) {
  const StepDiff diff = compare(result, judgement, claims_of(as_printed_options));
  const bool missed = !judgement.pairs.empty();
  if (missed && result.answer == detector::Answer::free) {
    ++row.silent;
  } else if (missed && result.first.lo > judgement.first.lo) {
    ++row.late;
  } else {
    row.incomplete += !diff.missing.empty() || !diff.late.empty();
  }
  row.pairs_missing += diff.missing.size();
  row.candidates += result.counts.search.candidate_pairs;
  row.ms += result.times.total - result.times.view_test;
}

// Runs the cases campaign:family:0, 1, ... of each generic family. About 30 ms a case.
TollTable measure_toll(const std::string& campaign, std::uint64_t cases_of_family) {
  TollTable table;
  const auto tried = assemblies();
  for (const auto& assembly : tried) table.rows.push_back({assembly.name});
  for (const auto& family : families()) {
    if (family.degenerate) continue;
    for (std::uint64_t i = 0; i < cases_of_family; ++i) {
      const auto c = make_case(family, fmt::format("{}:{}:{}", campaign, family.name, i)).c;
      const auto judgements = judge_case(c);
      ++table.cases;
      table.steps += judgements.size();
      for (const auto& judgement : judgements) {
        table.colliding += !judgement.pairs.empty();
        table.pairs += judgement.pairs.size();
      }
      for (std::size_t a = 0; a < tried.size(); ++a) {
        const auto results = results_of(c, tried[a].stages);
        for (std::size_t s = 0; s < results.size(); ++s) {
          count(results[s], judgements[s], table.rows[a]);
        }
      }
    }
  }
  return table;
}

// A table, a line a row.
std::string text_of(const TollTable& table) {
  std::string out = fmt::format(
      "{} cases, {} steps, {} collide, {} pairs\n{:<24} {:>7} {:>6} {:>11} {:>14} {:>11} {:>10}\n",
      table.cases, table.steps, table.colliding, table.pairs, "detector", "silent", "late",
      "incomplete", "pairs missing", "candidates", "ms");
  for (const auto& row : table.rows) {
    out += fmt::format("{:<24} {:>7} {:>6} {:>11} {:>14} {:>11} {:>10.1f}\n", row.name, row.silent,
                       row.late, row.incomplete, row.pairs_missing, row.candidates, row.ms);
  }
  return out;
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
      const auto results = results_of(c, stages);
      for (std::size_t s = 0; s < results.size(); ++s) {
        const auto diff = compare(results[s], judgements[s], claims_of(as_printed_options));
        if (diff.outcome != Outcome::holds) return true;
      }
      return false;
    };
    EXPECT_FALSE(defect(detector::standard_stages(as_printed_options)));
    EXPECT_TRUE(defect(stages_with(deviation)));
    EXPECT_TRUE(defect(stages_as_printed()));
  }
}

TEST(AsPrinted, TollOfRandomCases) {
  constexpr std::uint64_t cases_of_family = 60;
  const TollTable table = measure_toll("as-printed:1", cases_of_family);
  std::printf("%s", text_of(table).c_str());
  ASSERT_EQ(table.rows.size(), std::size(all) + 2);
  const TollRow &right = table.rows.front(), &printed = table.rows.back();
  EXPECT_EQ(right.silent + right.late + right.incomplete + right.pairs_missing, 0u);
  EXPECT_GT(printed.silent, 0u);
  EXPECT_GT(printed.pairs_missing, 0u);
  EXPECT_LT(printed.candidates, right.candidates);
  const TollTable again = measure_toll("as-printed:1", cases_of_family);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    EXPECT_EQ(table.rows[i].pairs_missing, again.rows[i].pairs_missing);
    EXPECT_EQ(table.rows[i].candidates, again.rows[i].candidates);
  }
}

}  // namespace
}  // namespace assay::properties
