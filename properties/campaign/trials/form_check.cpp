#include "properties/campaign/trials/form_check.h"

#include <fmt/format.h>

#include "properties/campaign/ledger/store_problem.h"
#include "properties/campaign/trials/trials.h"
#include "properties/judging/contracted_case.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {

bool has_forms(const DetectorUnderTest& detector, const corpus::Case& c) {
  return !detector.built_in && !detector.of_queries && !c.counted && !says_query(c);
}

namespace {

// How many steps of the form have another answer than those of the case, and how the first differs.
struct Differences {
  std::uint64_t steps = 0;
  std::string first;
};

Differences differences(const Form& form, const CaseRun& run, const CaseRun& in_form) {
  Differences found;
  if (!run.has_answers || run.end != RunEnd::completed || in_form.end != RunEnd::completed)
    return found;
  for (std::size_t s = 0; s < form.step.size(); ++s) {
    const auto differs = difference_in_form(run.steps[s], form, in_form.steps[form.step[s]]);
    if (differs.empty()) continue;
    if (found.steps++ == 0) found.first = fmt::format("step {}: {}", s + 1, differs);
  }
  return found;
}

StoredFailure stored(const FormLaw& law, const corpus::Case& c, const corpus::Case& form,
                     const CaseRun& run, const DetectorUnderTest& detector,
                     const Failure& failure) {
  const auto& configuration = detector.configurations.front();
  const bool is_flaky = failure.claim == Claim::deterministic;
  return {c.id,
          fmt::format("{}{}{}", configuration.name, law_in_configuration, law.law),
          fmt::format("{}{}, {}", law_in_signature, law.law, failure.signature()),
          failure.explanation,
          corpus::case_text(failing_case(form, configuration, detector, failure)),
          "",
          is_flaky,
          run.printed};
}

}  // namespace

FormCheck check_in_form(const FormLaw& law, const corpus::Case& c, const CaseRun& run,
                        const DetectorUnderTest& detector, WorkerProcess& worker) {
  FormCheck check;
  auto form = law.make(c);
  const auto told = form ? contracted(form->c, detector.contract) : std::nullopt;
  if (!told || corpus::steps_of(*told).size() != corpus::steps_of(form->c).size()) return check;
  // Answers can be set side by side if the contract has not rounded the form. Of lengths that the
  // contract states a form in another scale knows nothing.
  const auto& contract = detector.contract;
  const bool states_lengths =
      contract.margin > 0 || contract.separation > 0 || contract.rest_distance > 0;
  if (told->frames != form->c.frames || (states_lengths && !law.keeps_lengths)) form->step.clear();
  const auto& configuration = detector.configurations.front();
  const auto in_form = std::move(worker.run(*told, {&configuration, 1}).front());
  if (in_form.end == RunEnd::not_run) throw StoreProblem(in_form.explanation);
  check.disturbances = in_form.disturbances;
  auto judged = judge_trial(*told, judge_case(*told, contract), in_form, configuration, detector);
  if (judged.outcome != Outcome::holds && judged.outcome != Outcome::defect) return check;
  const auto differing = differences(*form, run, in_form);
  check.count.premise = corpus::steps_of(c).size();
  check.count.differs = differing.steps;
  if (!judged.failure && differing.steps > 0 && law.same_calls &&
      detector.claims_on(c, configuration).has(Claim::deterministic)) {
    auto& failure = judged.failure.emplace();
    failure.claim = Claim::deterministic;
    failure.kind = "two runs differ";
    failure.explanation = differing.first;
  }
  if (!judged.failure) return check;
  check.count.broken = 1;
  check.failure = stored(law, c, *told, in_form, detector, *judged.failure);
  return check;
}

}  // namespace assay::properties
