#include "properties/as_printed/toll.h"

#include <fmt/format.h>

#include "detector/step_result.h"
#include "properties/as_printed/deviations.h"
#include "properties/generators/families.h"
#include "properties/judging/fault_run.h"

namespace assay::properties {
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
  const StepDiff diff = compare(result, judgement, as_printed_options);
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

}  // namespace assay::properties
