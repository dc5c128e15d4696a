#include <fmt/format.h>

#include <new>
#include <nlohmann/json.hpp>

#include "detector/detector.h"
#include "detector/search/stopwatch.h"
#include "properties/judging/case_options.h"
#include "properties/worker/case_player.h"
#include "reports/check/subject.h"

namespace assay::reports {
namespace {

using detector::StepResult;

detector::Options options_of(const BuiltInChoice& choice, const CheckInput& input) {
  detector::Options options;
  if (const auto* c = input.steps->case_file()) options = properties::options_of(*c);
  options.culling = choice.culling.value_or(options.culling);
  options.start = choice.start.value_or(options.start);
  options.pairs = choice.pairs.value_or(options.pairs);
  options.arithmetic = choice.arithmetic.value_or(options.arithmetic);
  options.threads = choice.threads;
  return options;
}

class BuiltIn : public Subject {
 public:
  // `made` is empty if a limit was reached before there was one.
  BuiltIn(std::optional<detector::Detector> made, double create_ms,
          const detector::Options& options, const detector::Triangles& triangles, Limits& limits)
      : detector_(std::move(made)),
        create_ms_(create_ms),
        options_(options),
        triangles_(triangles),
        limits_(limits) {}

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

  std::optional<double> create_ms() const override { return create_ms_; }

  bool judged_by_claims() const override {
    return options_.arithmetic != detector::Arithmetic::exact;
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

  StepError error_of(std::size_t, const StepResult& result) const override {
    return {result.problem->message, true};
  }

  properties::StepDiff judge(std::size_t, const StepResult& result,
                             const oracle::StepJudgement& judgement) const override {
    return properties::compare(result, judgement, properties::claims_of(options_));
  }

  std::string stage_that_lost(const corpus::SourceStep& step,
                              detector::TrianglePair pair) const override {
    if (!detector_) return "";
    return properties::stage_that_lost(triangles_, step.x_t0, step.x_t1, pair);
  }

 private:
  static StepResult undecided() {
    StepResult result;
    result.answer = detector::Answer::undecided;
    return result;
  }

  std::optional<detector::Detector> detector_;
  double create_ms_;
  detector::Options options_;
  const detector::Triangles& triangles_;
  Limits& limits_;
};

}  // namespace

Expected<std::unique_ptr<Subject>> make_built_in(const BuiltInChoice& choice,
                                                 const CheckInput& input, Limits& limits) {
  const detector::Options options = options_of(choice, input);
  std::optional<detector::Detector> detector;
  double create_ms = 0;
  try {
    const detector::Stopwatch watch(create_ms);
    auto made = detector::Detector::create(input.steps->triangles(), input.steps->first_frame(),
                                           options, limits.stop_function());
    if (made) {
      detector = std::move(made.value());
    } else if (made.error().error != detector::InputError::stopped) {
      return Problem{fmt::format("{}: {}", input.file, made.error().message)};
    }
  } catch (const std::bad_alloc&) {
    limits.memory_failed();
  }
  return std::unique_ptr<Subject>(std::make_unique<BuiltIn>(std::move(detector), create_ms, options,
                                                            input.steps->triangles(), limits));
}

}  // namespace assay::reports
