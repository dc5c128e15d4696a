#include <fmt/format.h>

#include <new>
#include <nlohmann/json.hpp>

#include "detector/search/stopwatch.h"
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
  options.threads = choice.threads;
  return options;
}

class BuiltIn : public Subject {
 public:
  // `player` is empty if a limit was reached before there was one.
  BuiltIn(std::optional<properties::CasePlayer> player, double create_ms,
          const detector::Options& options, const corpus::Case& c, Limits& limits)
      : player_(std::move(player)),
        create_ms_(create_ms),
        options_(options),
        case_(c),
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

  StepResult answer(std::size_t s, const detector::StopFunction& stop) override try {
    return player_ ? player_->play(s, stop) : undecided();
  } catch (const std::bad_alloc&) {
    limits_.memory_failed();
    return undecided();
  }

  StepError error_of(std::size_t, const StepResult& result) const override {
    return {result.problem->message, true};
  }

  properties::StepDiff judge(std::size_t, const StepResult& result,
                             const oracle::StepJudgement& judgement) const override {
    return properties::compare(result, judgement, options_);
  }

  std::string stage_that_lost(std::size_t s, detector::TrianglePair pair) const override {
    if (!player_) return "";
    return properties::stage_that_lost(case_.triangles, player_->x_t0(s), player_->x_t1(s), pair);
  }

 private:
  static StepResult undecided() {
    StepResult result;
    result.answer = detector::Answer::undecided;
    return result;
  }

  std::optional<properties::CasePlayer> player_;
  double create_ms_;
  detector::Options options_;
  const corpus::Case& case_;
  Limits& limits_;
};

}  // namespace

Expected<std::unique_ptr<Subject>> make_built_in(const BuiltInChoice& choice,
                                                 const CheckInput& input, Limits& limits) {
  const detector::Options options = options_of(choice, input);
  std::optional<properties::CasePlayer> player;
  double create_ms = 0;
  try {
    const detector::Stopwatch watch(create_ms);
    auto made = properties::CasePlayer::make(input.c, options, {}, limits.stop_function());
    if (made) {
      player = std::move(made.value());
    } else if (made.error().error != detector::InputError::stopped) {
      return Refusal(fmt::format("{}: {}", input.file, made.error().message));
    }
  } catch (const std::bad_alloc&) {
    limits.memory_failed();
  }
  return std::unique_ptr<Subject>(
      std::make_unique<BuiltIn>(std::move(player), create_ms, options, input.c, limits));
}

}  // namespace assay::reports
