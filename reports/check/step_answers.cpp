#include "reports/check/step_answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/outcome/try.hpp>
#include <map>
#include <new>

#include "corpus/files.h"
#include "corpus/formats/text_lines.h"
#include "detector/detector.h"
#include "detector/search/stopwatch.h"
#include "properties/campaign/ledger/binding.h"
#include "properties/judging/case_options.h"
#include "properties/worker/case_run.h"
#include "properties/worker/plugin/plugin_host.h"
#include "reports/terminal/option_words.h"
#include "reports/terminal/words.h"

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
    auto creation = detector::Detector::create(input.steps->triangles(), input.steps->first_frame(),
                                               options_, limits_.stop_function());
    if (creation) {
      detector_ = std::move(creation.value());
    } else if (creation.error().error != detector::InputError::stopped) {
      return Problem{fmt::format("{}: {}", input.file, creation.error().message)};
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
    const auto view = properties::given_view(step.view, options_.culling);
    run_.steps.front() = step.commit ? detector_->step(step.x_t0, step.x_t1, view, stop)
                                     : detector_->evaluate(step.x_t0, step.x_t1, view, stop);
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
           (drops_relation_ ? "; the plug-in has no function `count`, so all pairs count" : "");
  }

  nlohmann::ordered_json to_json() const override {
    return detector_json({{"library", subject_.plugin->string()},
                          {"disturbances", worker_.disturbances() + second_.disturbances()},
                          {"isolation", text_of(subject_.isolation)},
                          {"printed", run_.output}});
  }

  // Runs all steps at once, because the worker carries the state of the detector from one to the
  // next. If the plug-in claims to be deterministic, they run a second time, in another process.
  properties::Verdict begin() override {
    const auto& claims = under_test().claims;
    const auto& configuration = under_test().configurations.front();
    run_ = run_alone(worker_, *case_, configuration);
    std::optional<properties::CaseRun> again;
    if (claims.has(Claim::deterministic)) again = run_alone(second_, *case_, configuration);
    auto runs =
        judge_run(*case_, run_, {}, claims, under_test().contract, again ? &*again : nullptr);
    run_.steps.resize(corpus::steps_of(*case_).size(), undecided());
    return runs;
  }

  void ask(std::size_t, const corpus::SourceStep&, const detector::StopFunction&) override {}

 private:
  properties::WorkerProcess worker_, second_;
  const std::shared_ptr<const corpus::Case> case_;
  const bool drops_relation_;  // the input has one that is dropped
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
  // Views pay over many steps. A single step at rest would cost several times as much with them.
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
    return Problem{
        fmt::format("{}: it answers no steps, only queries: assay check QUERIES.csv --detector {}",
                    library, shell_word(library))};
  if (judged_claims(detector.claims, detector.contract).empty())
    return Problem{fmt::format(
        "{}: under its contract no claim can be judged; there is nothing to check", library)};
  auto contracted_case = properties::contract_case(*input.steps->whole(), detector.contract);
  if (!contracted_case) {
    return Problem{fmt::format("{}: none of its steps is within the contract of {}: {}", input.file,
                               plugin.description.name,
                               properties::why_left_out(*input.steps->whole(), detector.contract))};
  }
  const std::size_t step_count = input.steps->count();
  const auto* counted_pairs = input.steps->counted();
  const bool drops_relation =
      counted_pairs && !counted_pairs->count_all() && !detector.contract.takes_relations;
  const auto steps = std::make_shared<const corpus::Case>(std::move(*contracted_case));
  input.steps = corpus::steps_of_case(steps, false, input.steps->text());
  return std::unique_ptr<StepAnswers>(std::make_unique<Plugin>(
      std::move(plugin), steps, step_count - input.steps->count(), drops_relation));
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
      return Problem{"it does not give two times for each pair"};
    raw.pair_times = logged.pair_times.data();
  }
  const auto triangles = static_cast<std::int32_t>(triangles_.rows());
  return properties::step_result(raw, triangles, under_test().contract.reports_pairs());
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

  // Is called for each step in turn.
  std::optional<std::string> left_out() override {
    if (rows_.contains(next_++)) return std::nullopt;
    ++steps_left_out_;
    return "the table has no row for this step";
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

// Reads a row "3,collision,0.25". Returns what is wrong with the row; empty if it is right.
std::string read_row(std::string_view line, std::size_t steps, std::size_t& step,
                     corpus::LoggedAnswer& answer) {
  const auto first = line.find(','), second = line.find(',', first + 1);
  if (second == std::string_view::npos) return "step,answer,time expected";
  const auto number = whole_number_of<std::size_t>(line.substr(0, first));
  if (!number || *number < 1 || *number > steps)
    return fmt::format("a step from 1 to {} expected", steps);
  step = *number - 1;
  const auto word = line.substr(first + 1, second - first - 1);
  const auto value = from_name<detector::Answer>(word);
  if (!value) return fmt::format("'{}' is no answer: {}", word, all_names<detector::Answer>());
  constexpr std::array raw = {ASSAY_FREE, ASSAY_COLLISION, ASSAY_UNDECIDED, ASSAY_ERROR};
  answer.answer = raw[static_cast<std::size_t>(*value)];
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
  contract.reports = properties::PairReporting::no_pairs;
  properties::Claims claims = {Claim::free_sound};
  claims.set(Claim::not_late, has_times);
  properties::Subject subject;
  subject.description = {file, "", claims, contract};
  subject.detector = {file, false, claims, contract, {{file, {}}}};
  return std::unique_ptr<StepAnswers>(
      std::make_unique<Table>(std::move(subject), *input.steps, std::move(rows), has_times));
}

}  // namespace assay::reports
