#include "reports/check/subject.h"

#include <fmt/format.h>

#include <boost/outcome/try.hpp>
#include <new>

#include "detector/detector.h"
#include "detector/search/stopwatch.h"
#include "properties/campaign/ledger/binding.h"
#include "properties/judging/case_options.h"
#include "properties/printable.h"
#include "properties/worker/case_player.h"
#include "reports/check/detector_choice.h"
#include "reports/terminal/words.h"

namespace assay::reports {
namespace {

using detector::StepResult;
using properties::Claim;
using properties::WorkerProcess;

class BuiltIn : public Subject {
 public:
  BuiltIn(const detector::Options& options, Limits& limits) : options_(options), limits_(limits) {
    claims_ = properties::claims_of(options);
  }

  Expected<void> make(const CheckInput& input) try {
    const detector::Stopwatch watch(create_ms_.emplace(0));
    auto made = detector::Detector::create(input.steps->triangles(), input.steps->first_frame(),
                                           options_, limits_.stop_function());
    if (made) {
      detector_ = std::move(made.value());
    } else if (made.error().error != detector::InputError::stopped) {
      return Problem{fmt::format("{}: {}", input.file, made.error().message)};
    }
    return outcome::success();
  } catch (const std::bad_alloc&) {
    limits_.memory_failed();
    return outcome::success();
  }

  std::string title() const override {
    const std::string culling = fmt::format("culling {}", properties::name_of(options_.culling));
    if (!judged_by_claims()) return culling;
    return fmt::format("{}, arithmetic {}", culling, properties::name_of(options_.arithmetic));
  }

  nlohmann::ordered_json to_json() const override {
    return {{"culling", properties::name_of(options_.culling)},
            {"arithmetic", properties::name_of(options_.arithmetic)},
            {"detector", nullptr}};
  }

  StepResult answer(std::size_t, const corpus::SourceStep& step,
                    const detector::StopFunction& stop) override try {
    if (!detector_) return undecided();
    const auto given = properties::given_view(step.view, options_.culling);
    return step.commit ? detector_->step(step.x_t0, step.x_t1, given, stop)
                       : detector_->evaluate(step.x_t0, step.x_t1, given, stop);
  } catch (const std::bad_alloc&) {
    limits_.memory_failed();
    return undecided();
  }

  std::string error_of(std::size_t, const StepResult& result) const override {
    return result.problem->message;
  }

 private:
  const detector::Options options_;
  Limits& limits_;
  std::optional<detector::Detector> detector_;  // nothing if a limit came before it was made
};

class Plugin : public Subject {
 public:
  Plugin(WorkerProcess worker, WorkerProcess second, properties::PluginDescription description,
         std::string library, std::uint64_t threads, std::shared_ptr<const corpus::Case> c,
         std::size_t steps_left_out)
      : worker_(std::move(worker)),
        second_(std::move(second)),
        library_(std::move(library)),
        threads_(threads),
        case_(std::move(c)) {
    // The words of the plug-in go to the terminal and into JSON, so they must be printable.
    description.name = properties::printable(description.name);
    description.version = properties::printable(description.version);
    claims_ = claims_on_steps(description);
    contract_ = description.contract;
    plugin_ = std::move(description);
    steps_left_out_ = steps_left_out;
  }

  std::string title() const override {
    return plugin_text(plugin_->name + " " + plugin_->version, claims_, contract_,
                       worker_.isolation(), threads_);
  }

  nlohmann::ordered_json to_json() const override {
    nlohmann::ordered_json claims = nlohmann::ordered_json::array();
    for (const auto claim : properties::list_of(claims_)) claims.push_back(name_of(claim));
    return {{"culling", nullptr},
            {"arithmetic", nullptr},
            {"detector",
             {{"name", plugin_->name},
              {"version", plugin_->version},
              {"library", library_},
              {"claims", std::move(claims)},
              {"disturbances", worker_.disturbances() + second_.disturbances()},
              {"isolation", text_of(worker_.isolation())},
              {"printed", run_.printed},
              {"contract", nlohmann::json(contract_)}}}};
  }

  // Runs all steps at once, because the worker carries the state of the detector from one to the
  // next. If the plug-in claims to be deterministic, they run a second time, in another process.
  properties::JudgedRun begin() override {
    const std::vector<properties::Configuration> alone = {{plugin_->name, {}}};
    run_ = std::move(worker_.run(*case_, alone).front());
    std::optional<properties::CaseRun> again;
    if (claims_.has(Claim::deterministic)) again = std::move(second_.run(*case_, alone).front());
    return judge_run(*case_, run_, {}, claims_, contract_, again ? &*again : nullptr);
  }

  StepResult answer(std::size_t s, const corpus::SourceStep&,
                    const detector::StopFunction&) override {
    return s < run_.steps.size() ? run_.steps[s] : undecided();
  }

  std::string error_of(std::size_t s, const StepResult&) const override {
    const auto error = properties::error_of(run_, s);
    return error.empty() ? run_.explanation : error;
  }

 private:
  WorkerProcess worker_, second_;
  const std::string library_;
  const std::uint64_t threads_;
  const std::shared_ptr<const corpus::Case> case_;
};

}  // namespace

Expected<std::unique_ptr<Subject>> make_built_in(const BuiltInChoice& choice,
                                                 const CheckInput& input, Limits& limits) {
  detector::Options options;
  if (const auto* c = input.steps->case_file()) options = properties::options_of(*c);
  options.culling = choice.culling.value_or(options.culling);
  options.start = choice.start.value_or(options.start);
  options.pairs = choice.pairs.value_or(options.pairs);
  options.arithmetic = choice.arithmetic.value_or(options.arithmetic);
  options.threads = choice.threads;
  auto subject = std::make_unique<BuiltIn>(options, limits);
  BOOST_OUTCOME_TRY(subject->make(input));
  return std::unique_ptr<Subject>(std::move(subject));
}

Expected<std::unique_ptr<Subject>> make_plugin_subject(const std::filesystem::path& worker_program,
                                                       const std::string& library,
                                                       const properties::WorkerLimits& limits,
                                                       CheckInput& input) {
  properties::WorkerProcess worker(worker_program, library, limits);
  BOOST_OUTCOME_TRY(description, worker.describe());
  const auto& parts = description.parts;
  if (!parts.steps && !parts.candidates)
    return Problem{
        fmt::format("{}: it holds no steps, but a query alone: assay check-queries", library)};
  if (judged_claims(claims_on_steps(description), description.contract).empty())
    return Problem{fmt::format(
        "{}: it claims nothing that its contract leaves to be judged; there is nothing to check",
        library)};
  auto seen = properties::contracted(*input.steps->whole(), description.contract);
  if (!seen) {
    return Problem{fmt::format(
        "{}: nothing of it is within the contract of {}: {}", input.file, description.name,
        properties::why_left_out(*input.steps->whole(), description.contract))};
  }
  const std::size_t given = input.steps->count();
  auto of_second = limits;
  of_second.variation = 1;
  of_second.least = worker.isolation();
  const auto taken = std::make_shared<const corpus::Case>(std::move(*seen));
  input.steps = corpus::steps_of_case(taken, false);
  return std::unique_ptr<Subject>(std::make_unique<Plugin>(
      std::move(worker), properties::WorkerProcess(worker_program, library, of_second),
      std::move(description), library, limits.threads, taken, given - input.steps->count()));
}

}  // namespace assay::reports
