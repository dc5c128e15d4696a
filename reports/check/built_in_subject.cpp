#include <fmt/format.h>

#include <new>
#include <nlohmann/json.hpp>

#include "properties/worker/case_player.h"
#include "reports/check/subject.h"

namespace assay::reports {
namespace {

using detector::StepResult;

detector::Options options_of(const BuiltInChoice& choice, const CheckInput& input) {
  detector::Options options = properties::options_of(input.c);
  options.culling = choice.culling.value_or(options.culling);
  options.start = choice.start.value_or(options.start);
  options.pairs = choice.pairs.value_or(options.pairs);
  options.arithmetic = choice.arithmetic.value_or(options.arithmetic);
  return options;
}

class BuiltIn : public Subject {
 public:
  BuiltIn(properties::CasePlayer player, const detector::Options& options, const corpus::Case& c,
          Limits& limits)
      : player_(std::move(player)), options_(options), case_(c), limits_(limits) {}

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

  StepResult answer(std::size_t s, const detector::StopFunction& stop) override try {
    return player_.play(s, stop);
  } catch (const std::bad_alloc&) {
    limits_.memory_failed();
    StepResult result;
    result.answer = detector::Answer::undecided;
    return result;
  }

  StepError error_of(const StepResult& result) const override {
    return {result.problem->message, true};
  }

  properties::StepDiff judge(const StepResult& result,
                             const oracle::StepJudgement& judgement) const override {
    return properties::compare(result, judgement, options_);
  }

  std::string stage_that_lost(std::size_t s, detector::TrianglePair pair) const override {
    return properties::stage_that_lost(case_.triangles, player_.x_t0(s), player_.x_t1(s), pair);
  }

 private:
  properties::CasePlayer player_;
  detector::Options options_;
  const corpus::Case& case_;
  Limits& limits_;
};

}  // namespace

Expected<std::unique_ptr<Subject>> make_built_in(const BuiltInChoice& choice,
                                                 const CheckInput& input, Limits& limits) {
  const detector::Options options = options_of(choice, input);
  auto made = properties::CasePlayer::make(input.c, options);
  if (!made) return Refusal(fmt::format("{}: {}", input.file, made.error().message));
  return std::unique_ptr<Subject>(
      std::make_unique<BuiltIn>(std::move(made.value()), options, input.c, limits));
}

}  // namespace assay::reports
