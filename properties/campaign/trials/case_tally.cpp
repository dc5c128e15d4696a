#include "properties/campaign/trials/case_tally.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "properties/campaign/ledger/store.h"
#include "properties/campaign/ledger/tally.h"
#include "properties/judging/case_options.h"
#include "properties/judging/trial.h"
#include "properties/laws/facts/case_facts.h"
#include "properties/laws/law.h"
#include "properties/worker/child_process.h"

namespace assay::properties {

namespace {

bool has_view_sets(const Configuration& configuration) {
  return detector::uses_views(configuration.options.culling);
}

void count_blocks(const CaseRun& run, std::span<const oracle::StepJudgement> truth,
                  TrialCounts& counts) {
  for (std::size_t s = 0; s < run.steps.size(); ++s) {
    const auto& result = run.steps[s];
    if (result.doubts.empty()) continue;
    for (const auto& contact : truth[s].pairs) {
      const auto a = static_cast<std::size_t>(contact.pair.a);
      const auto b = static_cast<std::size_t>(contact.pair.b);
      const auto block =
          block_of(result.signs[a], result.signs[b], (result.doubts[a] | result.doubts[b]) != 0);
      auto& count = counts.set_pairs[name_of(block)];
      ++count.contacts;
      if (contact.time == truth[s].first) ++count.first_contacts;
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

// A law that is checked on one of the cases, in one of its configurations: places in lists.
struct LawCheck {
  const Law* law;
  std::size_t of_case, configuration;
};

void count_laws(std::span<const LawCheck> checks, std::span<const RunCase> cases,
                std::span<CaseTally> tallies) {
  std::optional<ConfigurationLaws> asked;
  const LawCheck* last = nullptr;
  const auto found = check_in_copies(
      checks.size(), [&](std::size_t i) { return cases[checks[i].of_case].made.c.id; },
      [&](std::size_t i) {
        const LawCheck& check = checks[i];
        if (!last || last->of_case != check.of_case || last->configuration != check.configuration) {
          const RunCase& one = cases[check.of_case];
          asked.emplace(one.made.c, one.configurations[check.configuration],
                        one.runs[check.configuration].steps, one.truth);
        }
        last = &check;
        return asked->check(*check.law);
      });
  for (std::size_t i = 0; i < checks.size(); ++i) {
    const auto& [law, of_case, at] = checks[i];
    if (found[i].premise == 0) continue;
    const auto& configuration = cases[of_case].configurations[at];
    auto& tally = tallies[of_case];
    add_law(tally.counts, *law, found[i], name_of(configuration.options.culling));
    if (found[i].broken > 0)
      tally.broken.push_back({std::string(law->name), configuration.name, found[i].first_broken});
  }
}

}  // namespace

std::vector<CaseTally> tally_cases(std::span<const RunCase> cases) {
  std::vector<CaseTally> tallies(cases.size());
  std::vector<LawCheck> checks;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const auto& [made, configurations, runs, truth, with_laws] = cases[k];
    for (const auto& tag : made.tags) ++tallies[k].counts.tags[tag];
    bool counted_blocks = false;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (runs[i].end != RunEnd::completed || !has_view_sets(configurations[i]) ||
          configurations[i].options.pairs != detector::Pairs::all ||
          configurations[i].options.arithmetic != detector::Arithmetic::exact) {
        continue;
      }
      if (!counted_blocks) count_blocks(runs[i], truth, tallies[k].counts);
      counted_blocks = true;
      for (const Law& law : laws()) {
        // Laws speak of all contacts, and a run with a relation tells only those that count.
        if (with_laws && !made.c.counted && is_checked_on(law, made.c.id))
          checks.push_back({&law, k, i});
      }
    }
  }
  count_laws(checks, cases, tallies);
  return tallies;
}

Judge judge_of_law(const Law& law, const Configuration& configuration) {
  return [&law, configuration](const corpus::Case& c) -> std::optional<Finding> {
    const auto check = [&](std::size_t) -> LawTally {
      const CaseRun run = run_case(c, configuration);
      if (run.end != RunEnd::completed) return {};
      const auto truth = judge_case(c);
      return ConfigurationLaws(c, configuration, run.steps, truth).check(law);
    };
    const LawTally tally = check_in_copies(
                               1, [&](std::size_t) { return c.id; }, check)
                               .front();
    if (tally.broken == 0) return std::nullopt;
    return Finding{fmt::format("{}{}", law_in_signature, law.name), {}, 0};
  };
}

namespace {

std::string line_of(const LawTally& tally) {
  const nlohmann::json line = {tally.premise, tally.close, tally.broken, tally.first_broken};
  return line.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace) + "\n";
}

LawTally tally_of(const std::string& line) {
  const auto fields = nlohmann::json::parse(line);
  return {fields[0], fields[1], fields[2], fields[3]};
}

// The lines that are whole: a copy that is killed may leave a part of one.
void add_tallies(const std::string& said, std::vector<LawTally>& tallies) {
  std::istringstream lines(said.substr(0, said.rfind('\n') + 1));
  for (std::string line; std::getline(lines, line);) tallies.push_back(tally_of(line));
}

}  // namespace

std::vector<LawTally> check_in_copies(std::size_t count,
                                      const std::function<std::string(std::size_t)>& case_of,
                                      const std::function<LawTally(std::size_t)>& check) {
  constexpr int most_kills = 5;
  int kills = 0;
  std::vector<LawTally> tallies;
  while (tallies.size() < count) {
    const auto run = in_a_copy([&](const Say& say) {
      for (std::size_t i = tallies.size(); i < count; ++i) say(line_of(check(i)));
    });
    add_tallies(run.said, tallies);
    if (tallies.size() == count) break;
    const std::string case_id = case_of(tallies.size());
    if (was_killed_from_outside(run.end)) {
      if (++kills == most_kills)
        throw std::runtime_error(
            fmt::format("{}: the check of laws was {} {} times", case_id, run.end.text, kills));
      continue;
    }
    tallies.push_back({1, 0, 1, fmt::format("{}: the check ended: {}", case_id, run.end.text)});
  }
  return tallies;
}

}  // namespace assay::properties
