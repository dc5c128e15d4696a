#include "properties/campaign/case_tally.h"

#include <fmt/format.h>

#include "properties/generators/tag_table.h"
#include "properties/laws/law.h"

namespace assay::properties {
namespace {

bool has_view_sets(const Configuration& configuration) {
  return configuration.options.culling == detector::Culling::view_point ||
         configuration.options.culling == detector::Culling::view_line;
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
      ++counts[fmt::format("block:{}", name_of(block))];
      if (contact.time == truth[s].first) ++counts[fmt::format("first:{}", name_of(block))];
    }
  }
}

}  // namespace

Counts tally_case(const GeneratedCase& made, std::span<const Configuration> configurations,
                  std::span<const CaseRun> runs, std::span<const oracle::StepJudgement> truth,
                  bool with_laws) {
  Counts counts;
  for (const auto& tag : made.tags) ++counts["tag:" + tag];
  bool counted_blocks = false;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].end != RunEnd::completed || !has_view_sets(configurations[i]) ||
        configurations[i].options.pairs != detector::Pairs::all) {
      continue;
    }
    if (!counted_blocks) count_blocks(runs[i], truth, counts);
    counted_blocks = true;
    if (with_laws) {
      add_law_counts(made.c, configurations[i].options, runs[i].steps, truth, counts);
    }
  }
  return counts;
}

}  // namespace assay::properties
