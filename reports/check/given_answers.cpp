#include "reports/check/given_answers.h"

#include "properties/worker/plugin/plugin_reading.h"

namespace assay::reports {

std::string GivenAnswers::error_of(std::size_t, const detector::StepResult&) const {
  const auto error = properties::error_of(run_, 0);
  return error.empty() ? run_.explanation : error;
}

void GivenAnswers::begin_run(std::size_t s) {
  first_of_run_ = s;
  run_ = {};
  run_.has_answers = has_answers();
  run_.steps.push_back(undecided());
}

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

}  // namespace assay::reports
