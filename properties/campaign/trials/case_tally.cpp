#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "detector/mesh/topology.h"
#include "properties/campaign/ledger/database.h"
#include "properties/campaign/ledger/store.h"
#include "properties/campaign/ledger/tally.h"
#include "properties/campaign/trials/trials.h"
#include "properties/generators/draft.h"
#include "properties/judging/case_options.h"
#include "properties/judging/contracted_case.h"
#include "properties/judging/exam.h"
#include "properties/laws/facts/case_facts.h"
#include "properties/worker/child_process.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {

Extremes extremes_of(const Case& c, std::span<const StepJudgement> truth) {
  Extremes most;
  auto starts = new_starts(c);
  starts.push_back(steps_of(c).size());
  for (std::size_t i = 1; i < starts.size(); ++i)
    most.steps_in_a_row = std::max<std::uint64_t>(most.steps_in_a_row, starts[i] - starts[i - 1]);
  const auto vertices = c.frames.front().rows();
  const auto mesh = detector::make_topology(c.triangles, vertices);
  for (std::int32_t v = 0; v < vertices; ++v)
    most.valence = std::max<std::uint64_t>(most.valence, mesh.vertex_triangles.row(v).size());
  if (c.counted && !c.counted->pairs.count_all() && !c.counted->pairs.body.empty()) {
    const auto& body = c.counted->pairs.body;
    most.bodies = 1 + static_cast<std::uint64_t>(*std::ranges::max_element(body));
  }
  most.components = mesh.components.size();
  for (const auto& step : truth)
    most.pairs = std::max<std::uint64_t>(most.pairs, step.pairs.size());
  most.triangles = mesh.triangles.size();
  return most;
}

std::vector<std::size_t> new_starts(const Case& c) {
  std::vector<std::size_t> starts;
  const CaseStep* committed = nullptr;
  const auto script = steps_of(c);
  for (std::size_t s = 0; s < script.size(); ++s) {
    const bool goes_on = committed && start_of(c, script[s]) == end_of(c, *committed);
    if (!goes_on) starts.push_back(s);
    if (script[s].commit) committed = &script[s];
  }
  return starts;
}

namespace {

bool has_view_sets(const Configuration& configuration) {
  return detector::uses_views(configuration.options.culling);
}

void count_blocks(const CaseRun& run, std::span<const StepJudgement> truth, TrialCounts& counts) {
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

// The laws of one configuration of a case; the facts that they need are found once.
class ConfigurationLaws {
 public:
  ConfigurationLaws(const Case& c, const Configuration& configuration,
                    std::span<const StepResult> results, std::span<const StepJudgement> truth)
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

// A law to be checked, and in which case and configuration, by their places in the lists.
struct LawCheck {
  const Law* law;
  std::size_t of_case, configuration;
};

FailureRecord broken_law(const Case& c, const Configuration& configuration, const Law& law,
                         const std::string& explanation) {
  Case failing = c;
  failing.about = fmt::format("breaks {}; {}", law.name, explanation);
  failing.source = fmt::format("campaign case {}, {}", c.id, configuration.name);
  failing.options = configuration_text(configuration);
  // The case keeps its id, because laws that choose at random, or look at some of the cases only,
  // go by it.
  return {.case_id = c.id,
          .configuration = configuration.name,
          .law = std::string(law.name),
          .explanation = explanation,
          .mesh = case_text(failing)};
}

void count_laws(std::span<const LawCheck> checks, std::span<const TallyInput> cases,
                std::span<CaseTally> tallies) {
  std::optional<ConfigurationLaws> laws_of_configuration;
  const LawCheck* last = nullptr;
  const auto law_tallies = check_in_copies(
      checks.size(), [&](std::size_t i) { return cases[checks[i].of_case].results.c.id; },
      [&](std::size_t i) {
        const LawCheck& check = checks[i];
        if (!last || last->of_case != check.of_case || last->configuration != check.configuration) {
          const auto& [results, configurations, tags, with_laws] = cases[check.of_case];
          laws_of_configuration.emplace(results.c, configurations[check.configuration],
                                        results.runs[check.configuration].steps, results.truth);
        }
        last = &check;
        return laws_of_configuration->check(*check.law);
      });
  for (std::size_t i = 0; i < checks.size(); ++i) {
    const auto& [law, of_case, at] = checks[i];
    if (law_tallies[i].premise == 0) continue;
    const auto& configuration = cases[of_case].configurations[at];
    auto& tally = tallies[of_case];
    add_law(tally.counts, *law, law_tallies[i], name_of(configuration.options.culling));
    if (law_tallies[i].broken_steps > 0)
      tally.failures.push_back(
          broken_law(cases[of_case].results.c, configuration, *law, law_tallies[i].first_broken));
  }
}

}  // namespace

std::vector<CaseTally> tally_cases(std::span<const TallyInput> cases) {
  std::vector<CaseTally> tallies(cases.size());
  std::vector<LawCheck> checks;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const auto& [results, configurations, tags, with_laws] = cases[k];
    const auto& runs = results.runs;
    for (const auto& tag : tags) ++tallies[k].counts.tags[tag];
    bool counted_blocks = false;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (runs[i].end != RunEnd::completed || !has_view_sets(configurations[i]) ||
          configurations[i].options.pairs != detector::Pairs::all ||
          configurations[i].options.arithmetic != Arithmetic::exact) {
        continue;
      }
      if (!counted_blocks) count_blocks(runs[i], results.truth, tallies[k].counts);
      counted_blocks = true;
      for (const Law& law : laws()) {
        // Laws speak of all contacts, and a run with a relation tells only those that count.
        if (with_laws && !results.c.counted && is_checked_on(law, results.c.id))
          checks.push_back({&law, k, i});
      }
    }
  }
  count_laws(checks, cases, tallies);
  return tallies;
}

Judge judge_of_law(const Law& law, const Configuration& configuration) {
  return [&law, configuration](const Case& c) -> std::optional<Finding> {
    const auto check = [&](std::size_t) -> LawTally {
      const CaseRun run = run_case(c, configuration);
      if (run.end != RunEnd::completed) return {};
      const auto truth = judge_case(c);
      return ConfigurationLaws(c, configuration, run.steps, truth).check(law);
    };
    const LawTally tally = check_in_copies(
                               1, [&](std::size_t) { return c.id; }, check)
                               .front();
    if (tally.broken_steps == 0) return std::nullopt;
    return Finding{fmt::format("law {}", law.name), {}, 0};
  };
}

namespace {

std::string line_of(const LawTally& tally) {
  const nlohmann::json line = {tally.premise, tally.close, tally.broken_steps, tally.first_broken};
  return line.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace) + "\n";
}

// Adds the tallies of whole lines, because a copy that is killed may leave a part of a line.
void add_tallies(const std::string& text, std::vector<LawTally>& tallies) {
  std::istringstream lines(text.substr(0, text.rfind('\n') + 1));
  for (std::string line; std::getline(lines, line);) {
    const auto fields = nlohmann::json::parse(line);
    tallies.push_back({fields[0], fields[1], fields[2], fields[3]});
  }
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
    add_tallies(run.output, tallies);
    if (tallies.size() == count) break;
    const std::string case_id = case_of(tallies.size());
    if (was_killed_from_outside(run.end)) {
      if (++kills == most_kills)
        throw std::runtime_error(fmt::format("{}: the process that checks laws was {}, {} times",
                                             case_id, run.end.text, kills));
      continue;
    }
    tallies.push_back({1, 0, 1, fmt::format("{}: the check ended: {}", case_id, run.end.text)});
  }
  return tallies;
}

bool has_forms(const DetectorUnderTest& detector, const Case& c) {
  return !detector.built_in && !detector.of_queries && !c.counted && !says_query(c);
}

namespace {

// Counts the steps of the form that have another answer than those of the case. Returns how the
// first differs.
std::string count_differences(const Form& form, const CaseRun& run, const CaseRun& in_form,
                              LawCount& count) {
  std::string first;
  if (!run.has_answers || run.end != RunEnd::completed || in_form.end != RunEnd::completed)
    return first;
  for (std::size_t s = 0; s < form.step.size(); ++s) {
    const auto differs = difference_in_form(run.steps[s], form, in_form.steps[form.step[s]]);
    if (!differs.empty() && count.differs++ == 0)
      first = fmt::format("step {}: {}", s + 1, differs);
  }
  return first;
}

}  // namespace

FormCheck check_in_form(const Law& law, const Case& c, const CaseRun& run,
                        const DetectorUnderTest& detector, WorkerProcess& worker) {
  FormCheck check;
  auto form = form_of(*law.change, c);
  const auto input = form ? contract_case(form->c, detector.contract) : std::nullopt;
  if (!input || steps_of(*input).size() != steps_of(form->c).size()) return check;
  // Answers can be compared if the contract has not rounded the form, and if it states no lengths,
  // which do not change with the scale of a form.
  const auto& contract = detector.contract;
  const bool states_lengths =
      contract.margin > 0 || contract.separation > 0 || contract.rest_distance > 0;
  if (input->frames != form->c.frames || (states_lengths && !law.change->keeps_lengths))
    form->step.clear();
  const auto& configuration = detector.configurations.front();
  auto results = examine({detector, {&configuration, 1}, &worker}, *input);
  throw_if_not_run(results);
  const auto& in_form = results.runs[0];
  auto& verdict = results.verdicts[0];
  check.disturbances = in_form.disturbances;
  if (verdict.outcome != Outcome::holds && verdict.outcome != Outcome::defect) return check;
  const auto first_difference = count_differences(*form, run, in_form, check.count);
  check.count.premise = steps_of(c).size();
  if (!verdict.failure && check.count.differs > 0 && law.change->same_calls &&
      detector.claims_on(c, configuration).has(Claim::deterministic)) {
    auto& failure = verdict.failure.emplace();
    failure.claim = Claim::deterministic;
    failure.kind = "two runs differ";
    failure.explanation = first_difference;
  }
  if (!verdict.failure) return check;
  check.count.broken = 1;
  const Failure& failure = *verdict.failure;
  check.failure = stored_failure(Source::trial, *input, configuration, detector, failure, false,
                                 in_form.output);
  check.failure->case_id = c.id;
  check.failure->law = law.name;
  check.failure->flaky = failure.claim == Claim::deterministic;
  return check;
}

}  // namespace assay::properties
