#include "reports/check/recorded_answers.h"

#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "corpus/formats/text_lines.h"
#include "properties/judging/contracted_case.h"
#include "properties/worker/plugin/plugin_reading.h"
#include "reports/check/detector_choice.h"
#include "reports/terminal/option_words.h"

namespace assay::reports {
namespace {

using properties::Claim;
using properties::Contract;

// The steps of a log, each as the contract takes it.
class RecordedSteps : public corpus::StepSource {
 public:
  RecordedSteps(corpus::StepLog& log, Contract contract, LogSelection selection)
      : log_(log), contract_(std::move(contract)), selection_(selection) {}

  std::size_t count() const override { return log_.count(); }
  std::size_t frames() const override { return log_.count() + 1; }
  const detector::Triangles& triangles() const override { return log_.head().triangles; }
  const detector::Positions& first_frame() const override { return log_.head().positions; }
  const detector::CountedPairs* counted() const override {
    return log_.head().counted ? &*log_.head().counted : nullptr;
  }

  corpus::Expected<bool> has(std::size_t s) override {
    constexpr std::chrono::milliseconds pause(200);
    while (selection_.follow && s >= log_.count() && !log_.is_ended()) {
      std::this_thread::sleep_for(pause);
      BOOST_OUTCOME_TRYV(log_.go_on());
    }
    return s < log_.count();
  }

  corpus::Expected<corpus::SourceStep> step(std::size_t s) override {
    is_chosen_ = chooses(log_.number_of(s));
    why_left_out_.clear();
    if (!is_chosen_) return corpus::SourceStep{now_.x_t0, now_.x_t1};
    BOOST_OUTCOME_TRY(read, log_.step(s));
    now_ = std::move(read);
    if (!now_.why_unknown.empty()) {
      why_left_out_ = now_.why_unknown;
      return corpus::SourceStep{now_.x_t0, now_.x_t1};
    }
    if (!now_.answer && !now_.limit) {
      why_left_out_ = "nothing was recorded that the detector said";
      return corpus::SourceStep{now_.x_t0, now_.x_t1};
    }
    auto c = as_case();
    if (auto seen = properties::contracted(c, contract_)) {
      const auto script = corpus::steps_of(*seen);
      now_.x_t0 = start_of(*seen, script.front());
      now_.x_t1 = end_of(*seen, script.front());
    } else {
      why_left_out_ = properties::why_left_out(c, contract_);
    }
    return corpus::SourceStep{now_.x_t0, now_.x_t1};
  }

  corpus::Expected<std::unique_ptr<StepSource>> read_whole() override {
    return corpus::problem_in({}, "a log is judged as it is read");
  }

  const corpus::StepLog& log() const { return log_; }
  // Of the step that was read last.
  const corpus::LogStep& now() const { return now_; }
  bool is_chosen() const { return is_chosen_; }
  const std::string& why_left_out() const { return why_left_out_; }

 private:
  // Spreads the numbers evenly, and goes by them alone, so that every run chooses the same steps.
  bool chooses(std::uint64_t number) const {
    if (selection_.step) return number == *selection_.step;
    constexpr std::uint64_t golden = 0x9E3779B97F4A7C15;
    return static_cast<double>((number * golden) >> 11) * 0x1p-53 < selection_.share;
  }

  // The mesh at rest is the first frame of a case where the contract goes by it.
  corpus::Case as_case() const {
    corpus::Case c;
    c.triangles = triangles();
    c.frames = {now_.x_t0, now_.x_t1};
    if (counted()) c.counted = corpus::CaseRelation{*counted(), {}};
    if (contract_.rest_distance > 0) {
      c.frames.insert(c.frames.begin(), first_frame());
      c.script = {{1, 2, true}};
    }
    return c;
  }

  corpus::StepLog& log_;
  const Contract contract_;
  const LogSelection selection_;
  corpus::LogStep now_;
  bool is_chosen_ = true;
  std::string why_left_out_;
};

// Answers that are not asked for here, but were given before.
class GivenAnswers : public StepAnswers {
 public:
  bool is_recorded() const override { return true; }

  nlohmann::ordered_json to_json() const override { return detector_json({{"library", nullptr}}); }

  std::string error_of(std::size_t, const detector::StepResult&) const override {
    const auto error = properties::error_of(run_, 0);
    return error.empty() ? run_.explanation : error;
  }

 protected:
  GivenAnswers(properties::Subject subject, const corpus::StepSource& steps)
      : StepAnswers(std::move(subject)), triangles_(steps.triangles()) {}

  // Begins the run of step s.
  void begin_run(std::size_t s) {
    first_of_run_ = s;
    run_ = {};
    run_.has_answers = has_answers();
    run_.steps.push_back(undecided());
  }
  void take(const std::optional<corpus::LoggedAnswer>& logged) {
    if (!has_answers() || !logged) return;
    auto result = result_of(*logged);
    if (result) {
      run_.steps.front() = std::move(result.value());
    } else {
      take_error(result.error().message);
    }
  }
  void take_error(const std::string& text) {
    run_.steps.front().answer = detector::Answer::error;
    note_error(run_, 0, properties::line_of(text.c_str()));
  }

 private:
  Expected<detector::StepResult> result_of(const corpus::LoggedAnswer& logged) const {
    assay_result raw = {};
    raw.answer = logged.answer;
    raw.first_lo = logged.first_lo;
    raw.first_hi = logged.first_hi;
    raw.message = logged.message.c_str();
    raw.pair_count = logged.pairs.size() / 2;
    raw.pairs = logged.pairs.data();
    if (logged.pairs.size() % 2 != 0) return Problem{"its pairs are not two triangles each"};
    if (!logged.pair_times.empty()) {
      if (logged.pair_times.size() != logged.pairs.size())
        return Problem{"its times of pairs are not two for each pair"};
      raw.pair_times = logged.pair_times.data();
    }
    const auto triangles = static_cast<std::int32_t>(triangles_.rows());
    return properties::step_result(raw, triangles, under_test().contract.reports_pairs);
  }

  const detector::Triangles& triangles_;
};

class Recorded : public GivenAnswers {
 public:
  Recorded(RecordedDetector detector, RecordedSteps& steps)
      : GivenAnswers(std::move(detector.subject), steps),
        beyond_a_log_(std::move(detector.not_judged)),
        steps_(steps) {}

  std::string title() const override { return "recorded of " + detector_text(subject_.detector); }

  std::optional<std::string> left_out() override {
    if (!steps_.is_chosen()) return "";
    if (steps_.why_left_out().empty()) return std::nullopt;
    ++steps_left_out_;
    return steps_.why_left_out();
  }

  std::vector<std::string> lost() const override {
    std::vector<std::string> lines;
    for (const auto& damage : steps_.log().damages()) {
      lines.push_back(damage.to > damage.from
                          ? fmt::format("bytes {} to {}: {}", damage.from, damage.to, damage.what)
                          : fmt::format("before byte {}: {}", damage.from, damage.what));
    }
    return lines;
  }

  std::vector<std::string> remarks() const override {
    const auto rest = steps_.log().rest();
    if (!rest.what.empty())
      return {
          fmt::format("bytes {} to {}, the last of the log, are {}: it was cut, or is being "
                      "written",
                      rest.from, rest.to, rest.what)};
    if (!steps_.log().is_ended()) return {"the recorder was not told to end the log"};
    return {};
  }

  std::uint64_t number_of(std::size_t s) const override { return steps_.log().number_of(s); }

  std::vector<properties::NotJudged> beyond_reach() const override { return beyond_a_log_; }

  detector::StepResult answer(std::size_t s, const corpus::SourceStep& step,
                              const detector::StopFunction&) override {
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
    return run_.steps.front();
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

// A row of a table of answers.
class Table : public GivenAnswers {
 public:
  Table(properties::Subject subject, const corpus::StepSource& steps,
        std::map<std::size_t, corpus::LoggedAnswer> rows, bool has_times)
      : GivenAnswers(std::move(subject), steps), rows_(std::move(rows)), has_times_(has_times) {}

  std::string title() const override { return "answers of " + detector_text(subject_.detector); }

  // Asked of each step in turn.
  std::optional<std::string> left_out() override {
    if (rows_.contains(next_++)) return std::nullopt;
    ++steps_left_out_;
    return "the table has no row of it";
  }

  std::vector<properties::NotJudged> beyond_reach() const override {
    if (has_times_) return {};
    return {{name_of(Claim::not_late), "the table has no times"}};
  }

  detector::StepResult answer(std::size_t s, const corpus::SourceStep&,
                              const detector::StopFunction&) override {
    begin_run(s);
    take(rows_.at(s));
    return run_.steps.front();
  }

 private:
  const std::map<std::size_t, corpus::LoggedAnswer> rows_;
  const bool has_times_;
  std::size_t next_ = 0;
};

// Reads a row "3,collision,0.25". Says what is wrong with it; empty if nothing is.
std::string read_row(std::string_view line, std::size_t steps, std::size_t& step,
                     corpus::LoggedAnswer& answer) {
  const auto first = line.find(','), second = line.find(',', first + 1);
  if (second == std::string_view::npos) return "step,answer,time expected";
  const auto number = whole_number_of<std::size_t>(std::string(line.substr(0, first)));
  if (!number || *number < 1 || *number > steps)
    return fmt::format("a step from 1 to {} expected", steps);
  step = *number - 1;
  const auto word = line.substr(first + 1, second - first - 1);
  const auto said = from_name<detector::Answer>(word);
  if (!said) return fmt::format("'{}' is no answer: {}", word, all_names<detector::Answer>());
  constexpr std::array raw = {ASSAY_FREE, ASSAY_COLLISION, ASSAY_UNDECIDED, ASSAY_ERROR};
  answer.answer = raw[static_cast<std::size_t>(*said)];
  const auto time = line.substr(second + 1);
  if (time.empty()) {
    answer.first_hi = 1;
    return "";
  }
  const auto t = corpus::parse_double(time);
  if (!t || !(*t >= 0 && *t <= 1)) return fmt::format("'{}' is no time from 0 to 1", time);
  answer.first_lo = answer.first_hi = *t;
  return "";
}

}  // namespace

Expected<RecordedDetector> recorded_detector(const corpus::StepLog& log, const std::string& file) {
  const auto& head = log.head();
  assay_description raw = head.description;
  raw.name = head.name.c_str();
  raw.version = head.version.c_str();
  const auto claims = properties::Claims::of_bits(raw.claims);
  properties::PluginParts parts;
  parts.candidates = claims.has(Claim::candidates);
  parts.limit = claims.has_any(properties::claims_on_limits);
  auto read = properties::described(raw, parts);
  if (!read) return Problem{fmt::format("{}: the detector: {}", file, read.error().message)};
  properties::PluginDescription& description = read.value();
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

Expected<RecordedInput> recorded_input(corpus::StepLog& log, const std::string& file,
                                       const LogSelection& selection) {
  BOOST_OUTCOME_TRY(recorded, recorded_detector(log, file));
  const auto& detector = recorded.subject.detector;
  if (judged_claims(detector.claims, detector.contract).empty())
    return Problem{fmt::format(
        "{}: its detector claims nothing that its contract leaves to be judged by a log", file)};
  if (selection.step && !log.place_of(*selection.step))
    return Problem{fmt::format("{}: there is no whole record of step {}", file, *selection.step)};
  auto steps = std::make_unique<RecordedSteps>(log, detector.contract, selection);
  auto answers = std::make_unique<Recorded>(std::move(recorded), *steps);
  return RecordedInput{{file, std::move(steps)}, std::move(answers)};
}

Expected<std::unique_ptr<StepAnswers>> answers_of_table(const std::string& file,
                                                        const CheckInput& input,
                                                        properties::Adjacency adjacency) {
  BOOST_OUTCOME_TRY(bytes, corpus::read_bytes(file));
  std::map<std::size_t, corpus::LoggedAnswer> rows;
  bool has_times = false;
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < bytes.size();) {
    const auto end = std::min(bytes.find('\n', begin), bytes.size());
    std::string_view line(bytes.data() + begin, end - begin);
    begin = end + 1;
    ++number;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty() || (number == 1 && line == "step,answer,time")) continue;
    std::size_t step = 0;
    corpus::LoggedAnswer answer;
    if (const auto wrong = read_row(line, input.steps->count(), step, answer); !wrong.empty())
      return Problem{fmt::format("{}: line {}: {}", file, number, wrong)};
    has_times |= answer.answer == ASSAY_COLLISION && answer.first_lo == answer.first_hi;
    if (!rows.emplace(step, answer).second)
      return Problem{fmt::format("{}: line {}: step {} has a row already", file, number, step + 1)};
  }
  if (rows.empty()) return Problem{fmt::format("{}: it has no row", file)};
  properties::Contract contract;
  contract.adjacency = adjacency;
  contract.reports_pairs = false;
  properties::Claims claims = {Claim::free_sound};
  claims.set(Claim::not_late, has_times);
  properties::Subject subject;
  subject.description = {file, "", claims, contract};
  subject.detector = {file, false, claims, contract, {{file, {}}}};
  return std::unique_ptr<StepAnswers>(
      std::make_unique<Table>(std::move(subject), *input.steps, std::move(rows), has_times));
}

}  // namespace assay::reports
