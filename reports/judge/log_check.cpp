#include "reports/judge/log_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "reports/certificate/summary.h"
#include "reports/check/detector_choice.h"
#include "reports/judge/kept_failures.h"
#include "reports/terminal/limits.h"
#include "reports/terminal/text_file.h"
#include "reports/terminal/words.h"

namespace assay::reports {

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

Expected<CheckAnswer> judge_log(const LogName& name, const LogQuestion& question,
                                const CheckListener& listener) {
  BOOST_OUTCOME_TRY(log, corpus::StepLog::open(name.file));
  auto selection = question.selection;
  if (name.step) selection.step = name.step;
  BOOST_OUTCOME_TRY(recorded, recorded_input(log, name.file, selection));
  std::optional<properties::Subject> again;
  if (!question.again.library.empty()) {
    BOOST_OUTCOME_TRY(subject, choose_detector(question.again));
    again = std::move(subject);
  }
  std::unique_ptr<KeptFailures> kept;
  CheckListener with_files = listener;
  if (!question.out.empty()) {
    BOOST_OUTCOME_TRY(may_fill(question.out, {"page.html"}));
    const auto replay = [&](std::uint64_t number) {
      const auto step = fmt::format("{}#{}", absolute_path(name.file), number);
      return line_to_paste("replay " + shell_word(step));
    };
    kept = std::make_unique<KeptFailures>(question.out, name.file, replay, std::move(again),
                                          question.shrink_seconds);
    with_files.failed = [&](const FailedStep& failed) { return kept->keep(failed); };
  }
  auto check = question.check;
  check.files = {name.file};
  Limits limits(check.time_limit, check.memory_limit);
  BOOST_OUTCOME_TRY(answer,
                    check_answers(check, recorded.input, *recorded.answers, limits, with_files));
  if (kept) kept->end(answer);
  return std::move(answer);
}

std::string junit_suite(const std::string& log, const CheckOutcome& outcome) {
  using State = ClaimResult::State;
  const auto results = outcome.claim_results();
  const auto broken = std::ranges::count(results, State::broken, &ClaimResult::state);
  const auto held = std::ranges::count(results, State::holds, &ClaimResult::state);
  const auto name = xml_escaped(log);
  std::string text = fmt::format(
      "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" skipped=\"{}\">\n", name,
      results.size(), broken, static_cast<std::ptrdiff_t>(results.size()) - broken - held);
  for (const auto& [claim, state, why] : results) {
    text += fmt::format("    <testcase classname=\"{}\" name=\"{}\"", name, claim);
    text += state == State::holds
                ? "/>\n"
                : fmt::format("><{} message=\"{}\"/></testcase>\n",
                              state == State::broken ? "failure" : "skipped", xml_escaped(why));
  }
  if (!outcome.asked_again.empty())
    text += fmt::format("    <system-out>{}</system-out>\n",
                        xml_escaped(joined(outcome.asked_again, "\n")));
  return text + "  </testsuite>\n";
}

std::string junit_suite_of_problem(const std::string& log, const std::string& message) {
  const auto name = xml_escaped(log);
  return fmt::format(
      "  <testsuite name=\"{0}\" tests=\"1\" failures=\"0\" errors=\"1\">\n"
      "    <testcase classname=\"{0}\" name=\"log\"><error message=\"{1}\"/></testcase>\n"
      "  </testsuite>\n",
      name, xml_escaped(message));
}

std::string junit_text(const std::string& suites) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"assay\">\n" + suites +
         "</testsuites>\n";
}

}  // namespace assay::reports
