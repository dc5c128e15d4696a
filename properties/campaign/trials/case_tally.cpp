#include "properties/campaign/trials/case_tally.h"

#include <fmt/format.h>

#include "properties/campaign/stored/count_names.h"
#include "properties/campaign/stored/store.h"
#include "properties/campaign/trials/law_checks.h"
#include "properties/campaign/trials/trial.h"
#include "properties/generators/pair_blocks.h"
#include "properties/judging/case_options.h"
#include "properties/laws/facts/case_facts.h"
#include "properties/laws/law.h"

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

// The laws of one configuration of a case; what they ask of it is found once.
class ConfigurationLaws {
 public:
  ConfigurationLaws(const corpus::Case& c, const Configuration& configuration,
                    std::span<const detector::StepResult> results,
                    std::span<const oracle::StepJudgement> truth)
      : surface_(detector::make_surface(c.triangles, c.frames[0].rows())),
        facts_(c, configuration.options, results, truth, surface_) {}
  ConfigurationLaws(const ConfigurationLaws&) = delete;
  ConfigurationLaws& operator=(const ConfigurationLaws&) = delete;

  LawTally check(const Law& law) {
    LawTally tally;
    law.check(facts_, tally);
    return tally;
  }

 private:
  const detector::Surface surface_;
  CaseFacts facts_;
};

// A law that is checked in one of the configurations, by its place in a list.
struct LawCheck {
  const Law* law;
  std::size_t configuration;
};

void count_laws(std::span<const LawCheck> checks, const corpus::Case& c,
                std::span<const Configuration> configurations, std::span<const CaseRun> runs,
                std::span<const oracle::StepJudgement> truth, CaseTally& tally) {
  std::optional<ConfigurationLaws> asked;
  std::size_t of = 0;
  const auto tallies = check_in_copies(c.id, checks.size(), [&](std::size_t i) {
    if (!asked || of != checks[i].configuration) {
      of = checks[i].configuration;
      asked.emplace(c, configurations[of], runs[of].steps, truth);
    }
    return asked->check(*checks[i].law);
  });
  for (std::size_t i = 0; i < checks.size(); ++i) {
    const auto& [law, at] = checks[i];
    if (tallies[i].premise == 0) continue;
    add_law(tally.counts, *law, tallies[i], name_of(configurations[at].options.culling));
    if (tallies[i].broken > 0) {
      tally.broken.push_back(
          {std::string(law->name), configurations[at].name, tallies[i].first_broken});
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
  std::vector<LawCheck> checks;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].end != RunEnd::completed || !has_view_sets(configurations[i]) ||
        configurations[i].options.pairs != detector::Pairs::all ||
        configurations[i].options.arithmetic != detector::Arithmetic::exact) {
      continue;
    }
    if (!counted_blocks) count_blocks(runs[i], truth, tally.counts);
    counted_blocks = true;
    for (const Law& law : laws()) {
      if (with_laws && is_checked_on(law, made.c.id)) checks.push_back({&law, i});
    }
  }
  count_laws(checks, made.c, configurations, runs, truth, tally);
  return tally;
}

Judge judge_of_law(const Law& law, const Configuration& configuration) {
  return [&law, configuration](const corpus::Case& c) -> std::optional<Finding> {
    const auto check = [&](std::size_t) -> LawTally {
      const CaseRun run = run_case(c, configuration);
      if (run.end != RunEnd::completed) return {};
      const auto truth = judge_case(c);
      return ConfigurationLaws(c, configuration, run.steps, truth).check(law);
    };
    const LawTally tally = check_in_copies(c.id, 1, check).front();
    if (tally.broken == 0) return std::nullopt;
    return Finding{fmt::format("{}{}", law_in_signature, law.name), {}, 0};
  };
}

}  // namespace assay::properties
