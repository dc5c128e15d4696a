// `assay judge` judges the answers that a simulator recorded, without its detector.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "reports/judge/log_check.h"
#include "reports/terminal/text_file.h"
#include "reports/terminal/words.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

struct JudgeRequest {
  std::vector<std::string> logs;
  LogQuestion question;
  std::optional<double> share;
  std::uint64_t from = 1;  // counted from 1
  bool fail_on_collision = false;
  std::string json_file;   // empty: not written
  std::string junit_file;  // empty: not written
  bool all_steps = false;
};

// The worse of two exit codes of this verb.
int worse(int a, int b) {
  constexpr std::array from_best = {exit_holds, exit_collision, exit_undecided,
                                    exit_usage, exit_defect,    exit_unsound};
  const auto rank = [&](int code) { return std::ranges::find(from_best, code); };
  return rank(a) < rank(b) ? b : a;
}

Expected<void> check_words(const JudgeRequest& request) {
  const bool is_one = request.logs.size() == 1;
  if (!request.json_file.empty() && !is_one)
    return Problem{"--json is of one log: name them one by one"};
  if (request.question.selection.follow && !is_one) return Problem{"--follow is of one log"};
  if (!request.question.again.library.empty() && request.question.out.empty())
    return Problem{"--detector asks again about what is kept: --out says where"};
  std::vector<std::string> files;
  for (const auto& word : request.logs) files.push_back(log_name(word).file);
  BOOST_OUTCOME_TRY(may_fill(request.question.out));
  return may_write({request.json_file, request.junit_file}, files);
}

Expected<int> run_judge(const JudgeRequest& request) {
  auto question = request.question;
  question.selection.share = request.share.value_or(1);
  question.selection.from = request.from - 1;
  question.check.wants_report = !request.json_file.empty();
  question.check.announced_file = request.json_file;
  question.check.again = this_command(PastedIn::any_folder);
  question.check.shows_all_steps = request.all_steps;
  BOOST_OUTCOME_TRY(check_words(request));
  const CheckListener terminal{[](const std::string& text) {
    fmt::print("{}", text);
    std::fflush(stdout);
  }};
  int code = exit_holds;
  std::string suites;
  for (std::size_t i = 0; i < request.logs.size(); ++i) {
    const auto& word = request.logs[i];
    auto of_log = question;
    if (request.logs.size() > 1) {
      fmt::print("{}\n", word);
      // Step 3 of one log is not that of another, and logs of two folders may have one name.
      const auto name = std::filesystem::path(log_name(word).file).filename().string();
      if (!of_log.out.empty()) of_log.out = fmt::format("{}/{}-{}", of_log.out, i + 1, name);
    }
    const auto answer = judge_log(log_name(word), of_log, terminal);
    if (!answer) {
      // The others are judged all the same.
      if (request.logs.size() == 1) return answer.error();
      refuse(answer.error());
      suites += junit_suite_of_problem(word, answer.error().message);
      code = worse(code, exit_usage);
      continue;
    }
    if (question.check.wants_report) {
      BOOST_OUTCOME_TRY(write_json_file(request.json_file, answer.value().report));
    }
    suites += junit_suite(word, answer.value().outcome);
    const auto end = answer.value().outcome.end(request.fail_on_collision);
    code = worse(code, end ? end.value() : refuse(end.error()));
  }
  if (!request.junit_file.empty()) {
    BOOST_OUTCOME_TRY(write_text_file(request.junit_file, junit_text(suites)));
  }
  return code;
}

// The shard in words such as "2/8"; nothing for other words.
std::optional<Shard> shard_of(const std::string& word) {
  const auto slash = word.find('/');
  if (slash == std::string::npos) return std::nullopt;
  const auto index = whole_number_of<std::uint64_t>(word.substr(0, slash));
  const auto count = whole_number_of<std::uint64_t>(word.substr(slash + 1));
  const bool is_shard = index && count && *index >= 1 && *index <= *count;
  return is_shard ? std::optional(Shard{*index, *count}) : std::nullopt;
}

void add_options(Verb& verb, JudgeRequest& request) {
  auto& question = request.question;
  verb.add("LOG", request.logs,
           "Logs that a recorder wrote (assay_record.h, assay.Recorder); LOG#N: step N alone")
      .required();
  verb.add("--share SHARE", request.share, "Judge this share of the steps").with(reports::share());
  add_choice(verb, "--shard I/N", question.selection.shard, "I/N with 1 <= I <= N", shard_of,
             "I/N: the part of the steps that this process judges, one of N");
  verb.add("--from N", request.from, "Go on with this step, counted from 1")
      .in_range(1, std::numeric_limits<std::int64_t>::max());
  verb.add_flag("--follow", question.selection.follow,
                "Wait for steps until the recorder ends the log");
  verb.add("--out DIR", question.out,
           "Keep failing steps here: the part of the mesh that shows each, as case, OBJ and C++")
      .in(OptionGroup::output);
  add_detector(verb, question.again,
               "A plug-in of the same code: it is asked again about what is kept, and that is "
               "shrunk");
  verb.add("--shrink-time SECONDS", question.shrink_seconds, "Seconds at most for each")
      .with(positive())
      .shows_default()
      .in(OptionGroup::limits);
  verb.add("--second-opinion SHARE", question.check.second_opinion,
           "Check the oracle itself by other methods, on this share of its questions")
      .with(reports::share());
  add_jobs(verb, question.check.jobs);
  add_limits(verb, question.check.time_limit, question.check.memory_limit);
  verb.add_flag("--fail-on-collision", request.fail_on_collision,
                "Exit code 5 when a collision is recorded, and no answer breaks a claim");
  verb.add_flag("--all-steps", request.all_steps,
                "Print every step, not only those that are not as claimed")
      .in(OptionGroup::output);
  verb.add("--junit FILE", request.junit_file, "Write what each claim came to here, as JUnit XML")
      .in(OptionGroup::output);
  verb.add("--json FILE", request.json_file, "Write the report of one log here (assay-check/1)")
      .in(OptionGroup::output);
}

}  // namespace

AddedVerb add_judge(CLI::App& app) {
  return make_verb(app, "judge", "The recorded answers of a simulator against oracle", add_options,
                   run_judge);
}

}  // namespace assay::reports
