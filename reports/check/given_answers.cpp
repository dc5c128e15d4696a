#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/outcome/try.hpp>
#include <map>

#include "corpus/files.h"
#include "corpus/formats/text_lines.h"
#include "properties/worker/plugin/plugin_reading.h"
#include "reports/check/step_answers.h"
#include "reports/terminal/option_words.h"

namespace assay::reports {

void GivenAnswers::take(const std::optional<corpus::LoggedAnswer>& logged) {
  if (!has_answers() || !logged) return;
  auto result = result_of(*logged);
  if (result) {
    run_.steps.front() = std::move(result.value());
  } else {
    if (result.error().kind == properties::ProblemKind::beyond_capacity)
      properties::note_capacity(run_, 0);
    take_error(result.error().message);
  }
}

void GivenAnswers::take_error(const std::string& text) {
  run_.steps.front().answer = detector::Answer::error;
  note_error(run_, 0, properties::line_of(text.c_str()));
}

Expected<detector::StepResult> GivenAnswers::result_of(const corpus::LoggedAnswer& logged) const {
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

namespace {

using properties::Claim;

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

  void ask(std::size_t s, const corpus::SourceStep&, const detector::StopFunction&) override {
    begin_run(s);
    take(rows_.at(s));
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
  const auto number = whole_number_of<std::size_t>(line.substr(0, first));
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

Expected<std::unique_ptr<StepAnswers>> answers_of_table(const std::string& file,
                                                        const CheckInput& input,
                                                        properties::Adjacency adjacency) {
  BOOST_OUTCOME_TRY(bytes, corpus::read_bytes(file));
  std::map<std::size_t, corpus::LoggedAnswer> rows;
  bool has_times = false;
  corpus::Lines lines(bytes, '#', false);
  while (const auto line = lines.next()) {
    const auto number = lines.number();
    if (number == 1 && *line == "step,answer,time") continue;
    std::size_t step = 0;
    corpus::LoggedAnswer answer;
    if (const auto wrong = read_row(*line, input.steps->count(), step, answer); !wrong.empty())
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
