
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "properties/judging/contracted_case.h"
#include "properties/worker/plugin/plugin_host.h"
#include "reports/check/check_run.h"
#include "reports/terminal/option_words.h"
#include "reports/terminal/words.h"

namespace assay::reports {

namespace {

using properties::Claim;
using properties::Contract;

// The recorded detector, and those of its claims that a log cannot show, each with the reason.
struct RecordedDetector {
  properties::Subject subject;
  std::vector<properties::NotJudged> not_judged;
};

// The steps of a log, each as fitted to the contract.
class RecordedSteps : public corpus::StepSource {
 public:
  RecordedSteps(corpus::StepLog log, const properties::PluginDescription& detector,
                LogSelection selection)
      : log_(std::move(log)),
        contract_(detector.contract),
        asks_answers_(detector.parts.steps),
        asks_limits_(detector.parts.limit),
        selection_(selection) {}

  std::size_t count() const override { return log_.count(); }
  std::size_t frames() const override { return log_.count() + 1; }
  const detector::Triangles& triangles() const override { return log_.head().triangles; }
  const detector::Positions& first_frame() const override { return log_.head().positions; }
  const detector::CountedPairs* counted() const override {
    return log_.head().counted ? &*log_.head().counted : nullptr;
  }

  corpus::Expected<bool> has(std::size_t s) override {
    constexpr std::chrono::milliseconds pause(200);
    const auto is_there = [&] {
      return s < log_.count() || (selection_.step && log_.count() > 0 &&
                                  log_.number_of(log_.count() - 1) >= *selection_.step);
    };
    const auto is_damaged = [&] { return log_.damage() && !log_.damage()->is_cut; };
    while (selection_.follow && !is_there() && !log_.is_ended() && !is_damaged()) {
      std::this_thread::sleep_for(pause);
      BOOST_OUTCOME_TRYV(log_.go_on());
    }
    return s < log_.count();
  }

  std::uint64_t number_of(std::size_t s) const override { return log_.number_of(s); }

  std::vector<std::string> notes() const override {
    std::vector<std::string> lines;
    const auto [begin, end] = log_.notes().equal_range(now_.number);
    for (auto note = begin; is_chosen_ && note != end; ++note)
      lines.push_back(properties::line_of(note->second.c_str()));
    return lines;
  }

  std::vector<std::string> lost() const override {
    std::vector<std::string> lines;
    if (const auto damage = log_.damage(); damage && !damage->is_cut)
      lines.push_back(fmt::format(
          "bytes {} to {}, from the first damage to the end of the log ({}); steps read before the "
          "damage: {}",
          damage->from, damage->to, damage->what, log_.count()));
    lines.insert(lines.end(), unknown_.begin(), unknown_.end());
    return lines;
  }

  std::vector<std::string> last_remarks() const override {
    std::vector<std::string> lines;
    if (unanswered_ > 0)
      lines.push_back(
          fmt::format("{} step{} without an answer", unanswered_, unanswered_ == 1 ? "" : "s"));
    const auto damage = log_.damage();
    if (damage && damage->is_cut)
      lines.push_back(
          fmt::format("bytes {} to {}, the last of the log, are {}: the log was cut, "
                      "or is being written",
                      damage->from, damage->to, damage->what));
    if (!damage && !log_.is_ended()) lines.emplace_back("the recorder was not told to end the log");
    return lines;
  }

  corpus::Expected<corpus::SourceStep> step(std::size_t s) override {
    is_chosen_ = chooses(log_.number_of(s));
    why_left_out_.clear();
    is_beyond_contract_ = false;
    if (!is_chosen_) return corpus::SourceStep{now_.x_t0, now_.x_t1};
    BOOST_OUTCOME_TRY(logged_step, log_.step(s));
    now_ = std::move(logged_step);
    if (!now_.why_unknown.empty()) {
      unknown_.push_back(fmt::format("step {}: {}", now_.number + 1, now_.why_unknown));
      why_left_out_ = now_.why_unknown;
      return corpus::SourceStep{now_.x_t0, now_.x_t1};
    }
    if (!(asks_answers_ && now_.answer) && !(asks_limits_ && now_.limit)) {
      ++unanswered_;
      why_left_out_ = "no recorded answer is about the detector's claims";
      return corpus::SourceStep{now_.x_t0, now_.x_t1};
    }
    const auto* rest = contract_.rest_distance > 0 ? &first_frame() : nullptr;
    const auto c = corpus::case_of_step(triangles(), counted(), rest, now_.x_t0, now_.x_t1);
    if (auto contracted_case = properties::contract_case(c, contract_)) {
      const auto script = corpus::steps_of(*contracted_case);
      now_.x_t0 = start_of(*contracted_case, script.front());
      now_.x_t1 = end_of(*contracted_case, script.front());
    } else {
      why_left_out_ = properties::why_left_out(c, contract_);
      is_beyond_contract_ = true;
    }
    return corpus::SourceStep{now_.x_t0, now_.x_t1};
  }

  corpus::Expected<std::unique_ptr<StepSource>> read_whole() override {
    return corpus::problem_in({}, "a log is judged while it is read, never as a whole");
  }

  // Returns the step that was read last.
  const corpus::LogStep& now() const { return now_; }
  bool is_chosen() const { return is_chosen_; }
  const std::string& why_left_out() const { return why_left_out_; }
  bool is_beyond_contract() const { return is_beyond_contract_; }

 private:
  // Returns whether a step is chosen. Chosen numbers are spread evenly, and depend on nothing else,
  // so that every run chooses the same steps.
  bool chooses(std::uint64_t number) const {
    if (selection_.step) return number == *selection_.step;
    if (number + 1 < selection_.from) return false;
    constexpr std::uint64_t golden = 0x9E3779B97F4A7C15;
    return static_cast<double>((number * golden) >> 11) * 0x1p-53 < selection_.share;
  }

  corpus::StepLog log_;
  const Contract contract_;
  const bool asks_answers_, asks_limits_;
  const LogSelection selection_;
  corpus::LogStep now_;
  bool is_chosen_ = true;
  std::string why_left_out_;
  bool is_beyond_contract_ = false;
  std::vector<std::string> unknown_;
  std::size_t unanswered_ = 0;
};

class LoggedAnswers : public GivenAnswers {
 public:
  LoggedAnswers(RecordedDetector detector, RecordedSteps& steps)
      : GivenAnswers(std::move(detector.subject), steps),
        beyond_a_log_(std::move(detector.not_judged)),
        steps_(steps) {}

  std::string title() const override { return "recorded of " + detector_text(subject_.detector); }

  std::optional<std::string> left_out() override {
    if (!steps_.is_chosen()) return "";
    if (steps_.why_left_out().empty()) return std::nullopt;
    steps_left_out_ += steps_.is_beyond_contract() ? 1 : 0;
    return steps_.why_left_out();
  }

  std::vector<properties::NotJudged> beyond_reach() const override { return beyond_a_log_; }

  void ask(std::size_t s, const corpus::SourceStep& step, const detector::StopFunction&) override {
    const auto& now = steps_.now();
    begin_run(s);
    take(now.answer);
    if (subject_.description.parts.limit) {
      run_.limits.emplace_back();
      if (now.limit) {
        auto limit = limit_of(*now.limit, step);
        if (limit) {
          run_.limits.back() = std::move(limit.value());
        } else {
          take_error(limit.error().message);
        }
      }
    }
  }

 private:
  Expected<properties::LimitAnswer> limit_of(const corpus::LoggedLimit& logged,
                                             const corpus::SourceStep& step) const {
    const assay_limit raw = {logged.share, logged.positions ? logged.positions->data() : nullptr};
    const auto& contract = under_test().contract;
    const auto way = contract.motion == properties::MotionGiven::displacement
                         ? properties::displacement(step.x_t0, step.x_t1)
                         : detector::Positions();
    return properties::limit_answer(raw, under_test().claims, contract, step.x_t0, step.x_t1, way);
  }

  const std::vector<properties::NotJudged> beyond_a_log_;
  RecordedSteps& steps_;
};

Expected<RecordedDetector> recorded_detector(const corpus::StepLog& log, const std::string& file) {
  const auto& head = log.head();
  assay_description raw = head.description;
  raw.name = head.name.c_str();
  raw.version = head.version.c_str();
  const auto claims = properties::Claims::of_bits(raw.claims);
  properties::PluginParts parts;
  parts.candidates = claims.has(Claim::candidates);
  parts.limit = claims.has_any(properties::claims_on_limits);
  auto reading = properties::described(raw, parts);
  if (!reading) return Problem{fmt::format("{}: the detector: {}", file, reading.error().message)};
  properties::PluginDescription& description = reading.value();
  RecordedDetector recorded;
  const auto without = [&](Claim claim, const char* reason) {
    if (!description.claims.has(claim)) return;
    description.claims.set(claim, false);
    recorded.not_judged.push_back({name_of(claim), reason});
  };
  without(Claim::deterministic, "a log holds each step once");
  without(Claim::candidates, "a log holds no candidates");
  description.parts.candidates = false;
  const auto on_answers = description.claims.without(properties::claims_on_limits);
  description.parts.steps = !parts.limit || !on_answers.without({Claim::total}).empty();
  auto& subject = recorded.subject;
  subject.description = description;
  subject.detector = {fmt::format("{} {}", description.name, description.version),
                      false,
                      claims_on_steps(description),
                      description.contract,
                      {{description.name, {}}}};
  return recorded;
}

}  // namespace

LogName log_name(const std::string& word) {
  std::error_code ignored;
  const auto mark = word.rfind('#');
  if (mark == std::string::npos || std::filesystem::exists(word, ignored)) return {word, {}};
  const auto number = whole_number_of<std::uint64_t>(word.substr(mark + 1));
  if (!number || *number == 0) return {word, {}};
  return {word.substr(0, mark), *number - 1};
}

corpus::Expected<corpus::Case> read_case_of(const std::vector<std::string>& words) {
  const auto name = log_name(words.front());
  if (words.size() > 1 || !name.step) {
    if (words.size() == 1) return corpus::read_case(words.front());
    BOOST_OUTCOME_TRY(steps, corpus::read_steps({words.begin(), words.end()}));
    BOOST_OUTCOME_TRY(whole, steps->read_whole());
    auto c = *whole->whole();
    c.id = std::filesystem::path(words.front()).stem().string();
    return c;
  }
  BOOST_OUTCOME_TRY(log, corpus::StepLog::open(name.file));
  const auto place = log.place_of(*name.step);
  if (!place)
    return corpus::problem_in(name.file,
                              fmt::format("there is no whole record of step {}", *name.step + 1));
  BOOST_OUTCOME_TRY(step, log.step(*place));
  if (!step.why_unknown.empty()) return corpus::problem_in(words.front(), step.why_unknown);
  const auto& head = log.head();
  const auto* rest = head.positions != step.x_t0 ? &head.positions : nullptr;
  auto c = corpus::case_of_step(head.triangles, head.counted ? &*head.counted : nullptr, rest,
                                step.x_t0, step.x_t1);
  c.id = fmt::format("step-{}", *name.step + 1);
  c.source = words.front();
  return c;
}

Expected<CheckInput> read_log(const LogName& name, LogSelection selection) {
  BOOST_OUTCOME_TRY(log, corpus::StepLog::open(name.file));
  if (name.step) selection.step = name.step;
  BOOST_OUTCOME_TRY(recorded, recorded_detector(log, name.file));
  const auto& detector = recorded.subject.detector;
  if (judged_claims(detector.claims, detector.contract).empty())
    return Problem{fmt::format(
        "{}: under the contract of its detector no claim can be judged from a log", name.file)};
  if (selection.step && !selection.follow && !log.place_of(*selection.step))
    return Problem{
        fmt::format("{}: there is no whole record of step {}", name.file, *selection.step + 1)};
  auto steps =
      std::make_unique<RecordedSteps>(std::move(log), recorded.subject.description, selection);
  auto answers = std::make_unique<LoggedAnswers>(std::move(recorded), *steps);
  return CheckInput{name.file, std::move(steps), false, std::move(answers)};
}

}  // namespace assay::reports
