#include "reports/check/step_answers.h"

#include <fmt/format.h>

#include <new>

#include "detector/detector.h"
#include "detector/search/stopwatch.h"
#include "properties/campaign/ledger/binding.h"
#include "properties/judging/case_options.h"
#include "properties/worker/case_run.h"
#include "reports/terminal/option_words.h"

namespace assay::reports {
namespace {

using properties::Claim;

class BuiltIn : public StepAnswers {
 public:
  BuiltIn(const detector::Options& options, Limits& limits)
      : StepAnswers({}), options_(options), limits_(limits) {
    subject_.detector = subject_.detector.in({"built-in", options});
    subject_.detector.claims = properties::claims_of(options);
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
    std::string text = fmt::format("culling {}", properties::name_of(options_.culling));
    if (judged_by_claims())
      text += fmt::format(", arithmetic {}", properties::name_of(options_.arithmetic));
    if (options_.separation > 0) text += fmt::format(", within {}", options_.separation);
    return text;
  }

  nlohmann::ordered_json to_json() const override {
    return {{"culling", properties::name_of(options_.culling)},
            {"arithmetic", properties::name_of(options_.arithmetic)},
            {"detector", nullptr}};
  }

  void ask(std::size_t s, const corpus::SourceStep& step,
           const detector::StopFunction& stop) override try {
    begin_run(s);
    if (!detector_) return;
    const auto given = properties::given_view(step.view, options_.culling);
    run_.steps.front() = step.commit ? detector_->step(step.x_t0, step.x_t1, given, stop)
                                     : detector_->evaluate(step.x_t0, step.x_t1, given, stop);
  } catch (const std::bad_alloc&) {
    limits_.memory_failed();
  }

 private:
  const detector::Options options_;
  Limits& limits_;
  std::optional<detector::Detector> detector_;  // nothing if a limit came before it was made
};

class Plugin : public StepAnswers {
 public:
  Plugin(properties::Subject subject, std::shared_ptr<const corpus::Case> c,
         std::size_t steps_left_out, bool drops_relation)
      : StepAnswers(std::move(subject)),
        worker_(subject_.process()),
        second_(subject_.process(1)),
        case_(std::move(c)),
        drops_relation_(drops_relation) {
    steps_left_out_ = steps_left_out;
  }

  std::string title() const override {
    return plugin_text(subject_) +
           (drops_relation_ ? "; it cannot be told which pairs count, so that all do" : "");
  }

  nlohmann::ordered_json to_json() const override {
    return detector_json({{"library", subject_.plugin->string()},
                          {"disturbances", worker_.disturbances() + second_.disturbances()},
                          {"isolation", text_of(subject_.isolation)},
                          {"printed", run_.printed}});
  }

  // Runs all steps at once, because the worker carries the state of the detector from one to the
  // next. If the plug-in claims to be deterministic, they run a second time, in another process.
  properties::Verdict begin() override {
    const auto& claims = under_test().claims;
    const auto& configuration = under_test().configurations.front();
    run_ = run_alone(worker_, *case_, configuration);
    std::optional<properties::CaseRun> again;
    if (claims.has(Claim::deterministic)) again = run_alone(second_, *case_, configuration);
    auto judged =
        judge_run(*case_, run_, {}, claims, under_test().contract, again ? &*again : nullptr);
    run_.steps.resize(corpus::steps_of(*case_).size(), undecided());
    return judged;
  }

  void ask(std::size_t, const corpus::SourceStep&, const detector::StopFunction&) override {}

 private:
  properties::WorkerProcess worker_, second_;
  const std::shared_ptr<const corpus::Case> case_;
  const bool drops_relation_;  // which the input has
};

}  // namespace

nlohmann::ordered_json StepAnswers::detector_json(const nlohmann::ordered_json& of_process) const {
  nlohmann::ordered_json detector = {{"name", subject_.description.name},
                                     {"version", subject_.description.version},
                                     {"claims", words_of(under_test().claims)},
                                     {"contract", properties::json_of(under_test().contract)}};
  detector.update(of_process);
  return {{"culling", nullptr}, {"arithmetic", nullptr}, {"detector", std::move(detector)}};
}

Expected<std::unique_ptr<StepAnswers>> answers_of_built_in(const BuiltInChoice& choice,
                                                           const CheckInput& input,
                                                           Limits& limits) {
  detector::Options options;
  const auto* c = input.steps->case_file();
  if (c) options = properties::options_of(*c);
  // Views are for many steps. One alone that nothing moves in costs them several times as much.
  if (input.steps->is_at_rest() && !(c && c->options.contains("culling")))
    options.culling = detector::Culling::bvh;
  options.culling = choice.culling.value_or(options.culling);
  options.start = choice.start.value_or(options.start);
  options.pairs = choice.pairs.value_or(options.pairs);
  options.arithmetic = choice.arithmetic.value_or(options.arithmetic);
  options.threads = choice.threads;
  options.counted = input.steps->counted();
  auto answers = std::make_unique<BuiltIn>(options, limits);
  BOOST_OUTCOME_TRY(answers->make(input));
  return std::unique_ptr<StepAnswers>(std::move(answers));
}

Expected<std::unique_ptr<StepAnswers>> answers_of_plugin(properties::Subject plugin,
                                                         CheckInput& input) {
  const auto& detector = plugin.detector;
  const auto library = plugin.plugin->string();
  if (detector.of_queries)
    return Problem{fmt::format(
        "{}: it holds no steps, but a query alone: assay check QUERIES.csv --detector {}", library,
        shell_word(library))};
  if (judged_claims(detector.claims, detector.contract).empty())
    return Problem{fmt::format(
        "{}: it claims nothing that its contract leaves to be judged; there is nothing to check",
        library)};
  auto seen = properties::contracted(*input.steps->whole(), detector.contract);
  if (!seen) {
    return Problem{fmt::format("{}: nothing of it is within the contract of {}: {}", input.file,
                               plugin.description.name,
                               properties::why_left_out(*input.steps->whole(), detector.contract))};
  }
  const std::size_t given = input.steps->count();
  const auto* counted = input.steps->counted();
  const bool drops_relation =
      counted && !counted->count_all() && !detector.contract.takes_relations;
  const auto taken = std::make_shared<const corpus::Case>(std::move(*seen));
  input.steps = corpus::steps_of_case(taken, false, input.steps->text());
  return std::unique_ptr<StepAnswers>(std::make_unique<Plugin>(
      std::move(plugin), taken, given - input.steps->count(), drops_relation));
}

}  // namespace assay::reports
