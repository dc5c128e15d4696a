#include "properties/campaign/trials/case_tally.h"

#include <fmt/format.h>

#include "properties/campaign/stored/count_names.h"
#include "properties/campaign/stored/store.h"
#include "properties/campaign/trials/trial.h"
#include "properties/generators/tag_table.h"
#include "properties/judging/case_options.h"
#include "properties/laws/facts/case_facts.h"
#include "properties/laws/law_table.h"

namespace assay::properties {
namespace {

bool has_view_sets(const Configuration& configuration) {
  return detector::uses_views(configuration.options.culling);
}

void count_blocks(const CaseRun& run, std::span<const oracle::StepJudgement> truth,
                  Counts& counts) {
  for (std::size_t s = 0; s < run.steps.size(); ++s) {
    const auto& result = run.steps[s];
    if (result.doubts.empty()) continue;
    for (const auto& contact : truth[s].pairs) {
      const auto a = static_cast<std::size_t>(contact.pair.a);
      const auto b = static_cast<std::size_t>(contact.pair.b);
      const auto block =
          block_of(result.signs[a], result.signs[b], (result.doubts[a] | result.doubts[b]) != 0);
      ++counts[contact_count(name_of(block))];
      if (contact.time == truth[s].first) ++counts[first_contact_count(name_of(block))];
    }
  }
}

void count_laws(const LawTable& table, const Configuration& configuration, CaseTally& tally) {
  const auto all = laws();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const LawTally& law_tally = table.tallies()[i];
    if (law_tally.premise == 0) continue;
    add_law(tally.counts, all[i], law_tally, name_of(configuration.options.culling));
    if (law_tally.broken > 0) {
      tally.broken.push_back(
          {std::string(all[i].name), configuration.name, law_tally.first_broken});
    }
  }
}

}  // namespace

CaseTally tally_case(const GeneratedCase& made, std::span<const Configuration> configurations,
                     std::span<const CaseRun> runs, std::span<const oracle::StepJudgement> truth,
                     bool with_laws) {
  CaseTally tally;
  for (const auto& tag : made.tags) ++tally.counts[tag_count(tag)];
  bool counted_blocks = false;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].end != RunEnd::completed || !has_view_sets(configurations[i]) ||
        configurations[i].options.pairs != detector::Pairs::all ||
        configurations[i].options.arithmetic != detector::Arithmetic::exact) {
      continue;
    }
    if (!counted_blocks) count_blocks(runs[i], truth, tally.counts);
    counted_blocks = true;
    if (!with_laws) continue;
    const auto surface = detector::make_surface(made.c.triangles, made.c.frames[0].rows());
    CaseFacts facts(made.c, configurations[i].options, runs[i].steps, truth, surface);
    LawTable table;
    table.add(facts);
    count_laws(table, configurations[i], tally);
  }
  return tally;
}

Judge judge_of_law(const Law& law, const Configuration& configuration) {
  return [&law, configuration](const corpus::Case& c) -> std::optional<Finding> {
    const CaseRun run = run_case(c, configuration);
    if (run.end != RunEnd::completed) return std::nullopt;
    const auto truth = judge_case(c);
    const auto surface = detector::make_surface(c.triangles, c.frames[0].rows());
    CaseFacts facts(c, configuration.options, run.steps, truth, surface);
    LawTally tally;
    law.check(facts, tally);
    if (tally.broken == 0) return std::nullopt;
    return Finding{fmt::format("{}{}", law_in_signature, law.name), {}, 0};
  };
}

}  // namespace assay::properties
