#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "detector/step_result.h"
#include "properties/campaign/ledger/binding.h"
#include "properties/printable.h"
#include "reports/check/detector_choice.h"
#include "reports/check/subject.h"
#include "reports/terminal/words.h"

namespace assay::reports {
namespace {

using detector::StepResult;
using properties::Claim;

// The words of the plug-in go to the terminal and into JSON, so they must be printable.
properties::PluginDescription in_print(properties::PluginDescription description) {
  description.name = properties::printable(description.name);
  description.version = properties::printable(description.version);
  return description;
}

class Plugin : public Subject {
 public:
  Plugin(properties::WorkerProcess worker, properties::WorkerProcess second,
         properties::PluginDescription description, std::string library, std::uint64_t threads,
         std::shared_ptr<const corpus::Case> c, std::size_t steps_left_out)
      : worker_(std::move(worker)),
        second_(std::move(second)),
        description_(in_print(std::move(description))),
        claims_(claims_on_steps(description_)),
        library_(std::move(library)),
        threads_(threads),
        case_(std::move(c)),
        steps_left_out_(steps_left_out) {}

  std::string title() const override {
    return plugin_text(description_.name + " " + description_.version, claims_,
                       description_.contract, worker_.isolation(), threads_);
  }

  nlohmann::ordered_json to_json() const override {
    nlohmann::ordered_json claims = nlohmann::ordered_json::array();
    for (const auto claim : properties::list_of(claims_)) {
      claims.push_back(name_of(claim));
    }
    return {{"culling", nullptr},
            {"arithmetic", nullptr},
            {"detector",
             {{"name", description_.name},
              {"version", description_.version},
              {"library", library_},
              {"claims", std::move(claims)},
              {"disturbances", worker_.disturbances() + second_.disturbances()},
              {"isolation", text_of(worker_.isolation())},
              {"printed", runs_[0].printed},
              {"contract", properties::json_of(description_.contract)}}}};
  }

  // Runs all steps at once, because the worker carries the state of the detector from one to the
  // next. If the plug-in claims to be deterministic, they run a second time, in another process.
  properties::JudgedRun begin() override {
    const std::vector<properties::Configuration> alone = {{description_.name, {}}};
    runs_ = worker_.run(*case_, alone);
    if (claims_.has(properties::Claim::deterministic))
      runs_.push_back(std::move(second_.run(*case_, alone).front()));
    return properties::judge_run(
        *case_, runs_[0], {}, claims_, description_.contract,
        claims_.has(properties::Claim::deterministic) ? &runs_[1] : nullptr);
  }

  const properties::PluginDescription* description() const override { return &description_; }
  std::size_t steps_left_out() const override { return steps_left_out_; }
  std::optional<double> processor_seconds() const override { return runs_[0].processor_seconds; }

  std::string printed() const override { return runs_[0].printed; }

  StepResult answer(std::size_t s, const corpus::SourceStep&,
                    const detector::StopFunction&) override {
    return s < runs_[0].steps.size() ? runs_[0].steps[s] : not_reached();
  }

  StepError error_of(std::size_t s, const StepResult&) const override {
    const auto error = properties::error_of(runs_[0], s);
    return {error.empty() ? runs_[0].explanation : error, false};
  }

  oracle::AskedFeatures asked() const override {
    return properties::asked_features(description_.contract);
  }

  bool has_answers() const override { return description_.parts.steps; }

  properties::StepDiff judge(std::size_t s, const StepResult& result,
                             const oracle::StepJudgement& judgement) const override {
    if (s < runs_[0].steps.size())
      return properties::compare_step(runs_[0], s, judgement, claims_, description_.contract,
                                      case_->triangles);
    return properties::compare(result, judgement, claims_, description_.contract, case_->triangles);
  }

  std::string stage_that_lost(const corpus::SourceStep&, detector::TrianglePair) const override {
    return "";
  }

 private:
  static StepResult not_reached() {
    StepResult result;
    result.answer = detector::Answer::undecided;
    return result;
  }

  properties::WorkerProcess worker_, second_;
  properties::PluginDescription description_;
  properties::Claims claims_;  // on steps
  std::string library_;
  std::uint64_t threads_;
  std::shared_ptr<const corpus::Case> case_;
  const std::size_t steps_left_out_;
  std::vector<properties::CaseRun> runs_;
};

}  // namespace

Expected<std::unique_ptr<Subject>> make_plugin_subject(const std::filesystem::path& worker_program,
                                                       const std::string& library,
                                                       const properties::WorkerLimits& limits,
                                                       CheckInput& input) {
  properties::WorkerProcess worker(worker_program, library, limits);
  auto description = worker.describe();
  if (!description) return description.error();
  const auto& parts = description.value().parts;
  if (!parts.steps && !parts.candidates)
    return Problem{
        fmt::format("{}: it holds no steps, but a query alone: assay check-queries", library)};
  if (judged_claims(claims_on_steps(description.value()), description.value().contract).empty())
    return Problem{fmt::format(
        "{}: it claims nothing that its contract leaves to be judged; there is nothing to check",
        library)};
  auto seen = properties::contracted(*input.steps->whole(), description.value().contract);
  if (!seen) {
    return Problem{fmt::format(
        "{}: nothing of it is within the contract of {}: {}", input.file, description.value().name,
        properties::why_left_out(*input.steps->whole(), description.value().contract))};
  }
  const std::size_t given = input.steps->count();
  auto of_second = limits;
  of_second.variation = 1;
  of_second.least = worker.isolation();
  const auto taken = std::make_shared<const corpus::Case>(std::move(*seen));
  input.steps = corpus::steps_of_case(taken, false);
  return std::unique_ptr<Subject>(std::make_unique<Plugin>(
      std::move(worker), properties::WorkerProcess(worker_program, library, of_second),
      std::move(description.value()), library, limits.threads, taken,
      given - input.steps->count()));
}

}  // namespace assay::reports
