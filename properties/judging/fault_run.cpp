#include "properties/judging/fault_run.h"

#include <fmt/format.h>

#include <algorithm>

#include "properties/generators/families.h"

namespace assay::properties {
namespace {

using detector::StepResult;

std::vector<StepResult> refused(const corpus::Case& c, const detector::Problem& problem) {
  StepResult result;
  result.problem = problem;
  return std::vector<StepResult>(corpus::steps_of(c).size(), result);
}

}  // namespace

std::vector<StepResult> run_case(const corpus::Case& c, const detector::Options& options,
                                 const detector::Stages& stages) {
  auto player = CasePlayer::make(c, options, stages);
  if (!player) return refused(c, player.error());
  std::vector<StepResult> results;
  for (std::size_t s = 0; s < player.value().steps(); ++s) {
    results.push_back(player.value().play(s));
  }
  return results;
}

std::vector<StepResult> run_case(const corpus::Case& c, const Fault& fault) {
  return run_case(c, fault.options, fault.stages(fault.options));
}

std::vector<StepResult> run_disturbed(const corpus::Case& c, const detector::Options& options,
                                      MakeStages stages, std::span<const StepResult> undisturbed) {
  constexpr int most_stops = 8;
  auto made = CasePlayer::make(c, options, stages(options));
  auto beside = CasePlayer::make(c, options, stages(options));
  if (!made || !beside) return refused(c, made.error());
  std::vector<StepResult> results;
  for (std::size_t s = 0; s < made.value().steps(); ++s) {
    std::vector<StepResult> after_stops;
    for (int stop_at = 1; stop_at <= most_stops; ++stop_at) {
      int asked = 0;
      const auto stop = [&] { return ++asked == stop_at; };
      const auto stopped = made.value().look(s, stop);
      if (stopped.answer != detector::Answer::undecided) break;
      after_stops.push_back(made.value().look(s));
    }
    const auto meanwhile = [&] {
      beside.value().look(s);
      return false;
    };
    results.push_back(made.value().play(s, meanwhile));
    const auto differs = [&](const StepResult& disturbed) {
      return !same_answers(without_marking_counts({disturbed}),
                           without_marking_counts({undisturbed[s]}));
    };
    const auto other = std::find_if(after_stops.begin(), after_stops.end(), differs);
    if (other != after_stops.end() && !differs(results.back())) results.back() = *other;
  }
  return results;
}

CaseRun without_marking_counts(std::vector<StepResult> results) {
  CaseRun run;
  run.steps = std::move(results);
  for (auto& step : run.steps) step.counts.marking = {};
  return run;
}

namespace {

struct Assembly {
  std::string name;
  detector::Stages stages;
};

std::vector<Assembly> assemblies() {
  std::vector<Assembly> out = {{"as it should be", detector::standard_stages(as_printed_options)}};
  for (const auto& deviation : deviations()) {
    out.push_back({std::string(deviation.name), stages_with(deviation)});
  }
  out.push_back({"as printed", stages_as_printed()});
  return out;
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

}  // namespace

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
        const auto results = run_case(c, as_printed_options, tried[a].stages);
        for (std::size_t s = 0; s < results.size(); ++s) {
          count(results[s], judgements[s], table.rows[a]);
        }
      }
    }
  }
  return table;
}

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
