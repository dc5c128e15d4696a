#include <fmt/format.h>

#include <new>
#include <nlohmann/json.hpp>

#include "detector/detector.h"
#include "reports/subject.h"

namespace assay::reports {
namespace {

using detector::StepResult;

detector::Options options_of(const CheckRequest& request, const CheckInput& input) {
  detector::Options options = properties::options_of(input.c);
  options.culling = request.culling.value_or(options.culling);
  options.start = request.start.value_or(options.start);
  options.pairs = request.pairs.value_or(options.pairs);
  options.arithmetic = request.arithmetic.value_or(options.arithmetic);
  return options;
}

class BuiltIn : public Subject {
 public:
  BuiltIn(detector::Detector detector, const detector::Options& options, const corpus::Case& c,
          Limits& limits)
      : detector_(std::move(detector)),
        options_(options),
        case_(c),
        script_(corpus::steps_of(c)),
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

  bool judged_by_claims() const override {
    return options_.arithmetic != detector::Arithmetic::exact;
  }

  StepResult answer(std::size_t s, const detector::StopFunction& stop) override {
    std::vector<detector::ViewPrimitive> given;
    if (auto view = corpus::view_of_step(case_, s)) {
      // A segment serves as a point by its first end.
      if (options_.culling == detector::Culling::view_point) view->q1 = view->q0;
      given.push_back(*view);
    }
    try {
      return script_[s].commit
                 ? detector_.step(frame(script_[s].from), frame(script_[s].to), given, stop)
                 : detector_.evaluate(frame(script_[s].from), frame(script_[s].to), given, stop);
    } catch (const std::bad_alloc&) {
      limits_.memory_failed();
      StepResult result;
      result.answer = detector::Answer::undecided;
      return result;
    }
  }

  StepError error_of(const StepResult& result) const override {
    return {result.problem->message, true};
  }

  properties::StepDiff judge(const StepResult& result,
                             const oracle::StepJudgement& judgement) const override {
    return properties::compare(result, judgement, options_);
  }

  std::string stage_that_lost(std::size_t s, detector::TrianglePair pair) const override {
    return properties::stage_that_lost(case_.triangles, frame(script_[s].from),
                                       frame(script_[s].to), pair);
  }

 private:
  const detector::Positions& frame(std::int32_t f) const {
    return case_.frames[static_cast<std::size_t>(f)];
  }

  detector::Detector detector_;
  detector::Options options_;
  const corpus::Case& case_;
  std::vector<corpus::CaseStep> script_;
  Limits& limits_;
};

}  // namespace

MadeSubject make_built_in(const CheckRequest& request, const CheckInput& input, Limits& limits) {
  const detector::Options options = options_of(request, input);
  auto made = detector::Detector::create(input.c.triangles, input.c.frames[0], options);
  if (!made) return fmt::format("{}: {}", request.files[0], made.error().message);
  return std::make_unique<BuiltIn>(std::move(made.value()), options, input.c, limits);
}

}  // namespace assay::reports
