// `assay check`: consecutive frames are the steps of one mesh; each goes through the detector and,
// unless left out, the oracle, and the two are compared.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <iterator>
#include <new>
#include <nlohmann/json.hpp>

#include "corpus/case_file.h"
#include "corpus/mesh_reader.h"
#include "detector/detector.h"
#include "properties/case_check.h"
#include "reports/commands.h"
#include "reports/complaint.h"
#include "reports/json_output.h"
#include "reports/limits.h"
#include "reports/progress.h"
#include "reports/second_opinion_text.h"
#include "reports/step_text.h"

namespace assay::reports {
namespace {

using detector::Answer;
using properties::Outcome;

struct Input {
  corpus::Sequence sequence;
  std::optional<corpus::Case> as_case;  // when the input was a case file
};

corpus::Expected<Input> read_input(const std::vector<std::string>& files) {
  if (files.size() == 1 && std::filesystem::path(files[0]).extension() == ".json") {
    auto c = corpus::read_case(files[0]);
    if (!c) return c.error();
    if (auto wrong = properties::wrong_option(c.value())) {
      return corpus::problem_in(corpus::FileProblem::wrong_type, files[0], *wrong);
    }
    return Input{{c.value().triangles, c.value().frames}, c.value()};
  }
  const std::vector<std::filesystem::path> paths(files.begin(), files.end());
  auto sequence = corpus::read_sequence(paths);
  if (!sequence) return sequence.error();
  return Input{std::move(sequence.value()), std::nullopt};
}

detector::Options options_of(const CheckRequest& request, const Input& input) {
  detector::Options options;
  if (input.as_case) options = properties::options_of(*input.as_case);
  options.culling = request.culling.value_or(options.culling);
  options.start = request.start.value_or(options.start);
  options.pairs = request.pairs.value_or(options.pairs);
  return options;
}

class Check {
 public:
  Check(const CheckRequest& request, const Input& input, detector::Detector detector,
        const detector::Options& options)
      : request_(request),
        input_(input),
        detector_(std::move(detector)),
        options_(options),
        script_(input.as_case ? corpus::steps_of(*input.as_case)
                              : corpus::consecutive_steps(input.sequence.frames.size())),
        limits_(request.time_limit, request.memory_limit) {}

  int run() {
    announce();
    nlohmann::ordered_json steps = nlohmann::ordered_json::array();
    for (std::size_t s = 0; s < step_count(); ++s) {
      steps.push_back(run_step(s));
      if (refused_) return refuse(*refused_);
      if (unsound_) break;
    }
    if (input_.as_case && request_.use_oracle && !undecided_) check_facts();
    summarise();
    if (!request_.json_file.empty()) {
      if (auto problem = write_json(std::move(steps))) return refuse(*problem);
    }
    return exit_code();
  }

 private:
  std::size_t step_count() const { return script_.size(); }
  const detector::Positions& start_of(std::size_t s) const {
    return input_.sequence.frames[static_cast<std::size_t>(script_[s].from)];
  }
  const detector::Positions& end_of(std::size_t s) const {
    return input_.sequence.frames[static_cast<std::size_t>(script_[s].to)];
  }

  void announce() const {
    const auto& mesh = detector_.topology();
    std::size_t unclosed = 0;
    for (const auto& component : mesh.components) unclosed += component.is_cycle ? 0 : 1;
    fmt::print("{} triangles, {} vertices, {} component{}", mesh.triangles.size(),
               input_.sequence.frames[0].rows(), mesh.components.size(),
               mesh.components.size() == 1 ? "" : "s");
    if (unclosed) fmt::print(" ({} unclosed: all dirty, answered without culling)", unclosed);
    fmt::print("; {} step{}; culling {}{}{}\n", step_count(), step_count() == 1 ? "" : "s",
               properties::name_of(options_.culling),
               request_.use_oracle ? "" : "; no oracle: not judged",
               request_.time_limit ? fmt::format("; at most {} s", *request_.time_limit) : "");
    if (!request_.json_file.empty()) fmt::print("writes {}\n", request_.json_file);
    std::fflush(stdout);
  }

  nlohmann::ordered_json run_step(std::size_t s) {
    Progress progress(fmt::format("step {}/{}", s + 1, step_count()));
    const detector::StopFunction stop = [&] {
      progress.tick();
      return limits_.exceeded();
    };
    const auto &x_t0 = start_of(s), &x_t1 = end_of(s);

    progress.phase("detector");
    const detector::StepResult result = detect(s, x_t0, x_t1, stop);
    if (result.answer == Answer::error) {
      refused_ = fmt::format("step {}: {}", s + 1, result.problem->message);
      return {};
    }
    if (result.answer == Answer::collision && !collision_step_) {
      collision_step_ = s;
      collision_time_ = result.first;
    }
    undecided_ |= result.answer == Answer::undecided;
    if (!request_.use_oracle) {
      progress.finish();
      fmt::print("{}", step_text(s + 1, result, nullptr, 0, nullptr));
      return step_json(result, nullptr, 0, nullptr);
    }

    progress.phase("oracle");
    double oracle_ms = 0;
    const oracle::StepJudgement judgement = judge(x_t0, x_t1, stop, oracle_ms);
    const auto diff = properties::compare(result, judgement, options_.pairs);
    progress.finish();
    defect_ |= diff.outcome == Outcome::defect;
    undecided_ |= diff.outcome == Outcome::undecided;
    fmt::print("{}", step_text(s + 1, result, &judgement, oracle_ms, &diff));
    if (diff.outcome == Outcome::defect) print_defect(s, diff);
    std::fflush(stdout);
    auto json = step_json(result, &judgement, oracle_ms, &diff);
    if (request_.second_opinion) {
      progress.phase("second opinion");
      json["second_opinion"] = ask_second_opinion(s, judgement, stop, progress);
    }
    return json;
  }

  nlohmann::ordered_json ask_second_opinion(std::size_t s, const oracle::StepJudgement& judgement,
                                            const detector::StopFunction& stop,
                                            Progress& progress) {
    const double share = *request_.second_opinion;
    const auto begin = std::chrono::steady_clock::now();
    oracle::SecondOpinion opinion;
    try {
      opinion = oracle::second_opinion(start_of(s), end_of(s), input_.sequence.triangles, judgement,
                                       {share, request_.jobs, stop, {}});
    } catch (const std::bad_alloc&) {
      limits_.memory_failed();
    }
    const double milliseconds =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    progress.finish();
    fmt::print("{}", second_opinion_text(opinion, milliseconds));
    undecided_ |= !opinion.complete;
    unsound_ = !opinion.contradictions.empty();
    if (unsound_) fmt::print("  replay: {}\n", replay_line(s));
    std::fflush(stdout);
    return second_opinion_json(opinion, share, milliseconds);
  }

  // The step alone, where each frame is a file of its own; the same queries are chosen again.
  std::string replay_line(std::size_t s) const {
    const auto& files = request_.files;
    const bool file_a_frame = files.size() == input_.sequence.frames.size();
    std::string input;
    for (std::size_t i = 0; i < files.size(); ++i) {
      if (!file_a_frame || i == s || i == s + 1) input += " " + files[i];
    }
    return fmt::format("assay check{} --second-opinion {}", input, *request_.second_opinion);
  }

  detector::StepResult detect(std::size_t s, const detector::Positions& x_t0,
                              const detector::Positions& x_t1, const detector::StopFunction& stop) {
    std::vector<detector::ViewPrimitive> given;
    if (input_.as_case) {
      if (auto view = corpus::view_of_step(*input_.as_case, s)) {
        if (options_.culling == detector::Culling::view_point) view->q1 = view->q0;
        given.push_back(*view);
      }
    }
    try {
      return script_[s].commit ? detector_.step(x_t0, x_t1, given, stop)
                               : detector_.evaluate(x_t0, x_t1, given, stop);
    } catch (const std::bad_alloc&) {
      limits_.memory_failed();
      detector::StepResult result;
      result.answer = Answer::undecided;
      return result;
    }
  }

  oracle::StepJudgement judge(const detector::Positions& x_t0, const detector::Positions& x_t1,
                              const detector::StopFunction& stop, double& milliseconds) {
    const auto begin = std::chrono::steady_clock::now();
    oracle::StepJudgement judgement;
    try {
      judgement = oracle::judge_step(x_t0, x_t1, input_.sequence.triangles, {request_.jobs, stop});
    } catch (const std::bad_alloc&) {
      limits_.memory_failed();
    }
    milliseconds =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    return judgement;
  }

  void print_defect(std::size_t s, const properties::StepDiff& diff) const {
    if (diff.missing.empty()) return;
    const auto& lost = diff.missing.front();
    fmt::print(
        "  triangles {} and {} were lost at: {}\n", lost.pair.a, lost.pair.b,
        properties::stage_that_lost(input_.sequence.triangles, start_of(s), end_of(s), lost.pair));
  }

  // A case states what is true of it: an answer that differs is a defect.
  void check_facts() {
    const auto report = properties::check_case(*input_.as_case, request_.culling, request_.jobs);
    for (const auto& line : report.failed) fmt::print("expected facts: {}\n", line);
    facts_differ_ = !report.failed.empty();
    defect_ |= facts_differ_;
  }

  void summarise() const {
    const std::string what =
        collision_step_ ? fmt::format("collision at t = {} of step {}", time_text(collision_time_),
                                      *collision_step_ + 1)
                        : std::string(undecided_ ? "no collision found so far" : "no collision");
    if (unsound_) {
      fmt::print("{}; UNSOUND: oracle and second opinion contradict each other\n", what);
    } else if (defect_) {
      fmt::print(
          "{}; DEFECT: {}\n", what,
          facts_differ_ ? "the case's expected facts do not hold" : "detector and oracle differ");
    } else if (undecided_) {
      fmt::print("{}; undecided: {} reached\n", what,
                 limits_.reached().empty() ? "a limit" : limits_.reached());
    } else if (!request_.use_oracle) {
      fmt::print("{}; not judged\n", what);
    } else {
      fmt::print("{}; detector and oracle agree\n", what);
    }
  }

  std::optional<std::string> write_json(nlohmann::ordered_json steps) const {
    const nlohmann::ordered_json report = {
        {"schema", "assay-check/1"},
        {"version", version_text()},
        {"files", request_.files},
        {"triangles", detector_.topology().triangles.size()},
        {"components", detector_.topology().components.size()},
        {"culling", properties::name_of(options_.culling)},
        {"judged", request_.use_oracle},
        {"outcome", outcome_text()},
        {"limit_reached", limits_.reached().empty() ? nlohmann::ordered_json()
                                                    : nlohmann::ordered_json(limits_.reached())},
        {"peak_memory_bytes", peak_resident_bytes()},
        {"steps", std::move(steps)}};
    return write_text_file(
        request_.json_file,
        report.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  }

  const char* outcome_text() const {
    if (unsound_) return "unsound";
    if (!request_.use_oracle) return "not judged";
    return properties::name_of(defect_      ? Outcome::defect
                               : undecided_ ? Outcome::undecided
                                            : Outcome::holds);
  }

  int exit_code() const {
    if (unsound_) return exit_unsound;
    if (defect_) return exit_defect;
    if (undecided_) return exit_undecided;
    if (request_.fail_on_collision && collision_step_) return exit_collision;
    return exit_holds;
  }

  const CheckRequest& request_;
  const Input& input_;
  detector::Detector detector_;
  detector::Options options_;
  std::vector<corpus::CaseStep> script_;
  Limits limits_;
  std::optional<std::string> refused_;
  bool defect_ = false, undecided_ = false, unsound_ = false, facts_differ_ = false;
  std::optional<std::size_t> collision_step_;
  detector::TimeEnclosure collision_time_;
};

}  // namespace

int run_check(const CheckRequest& request) {
  // Before the work, not after it.
  if (auto problem = cannot_write(request.json_file, request.files)) return refuse(*problem);
  auto input = read_input(request.files);
  if (!input) return refuse(input.error().message);
  if (input.value().sequence.frames.size() < 2) {
    return refuse("one frame only: a step needs two frames or more");
  }
  const detector::Options options = options_of(request, input.value());
  auto detector = detector::Detector::create(input.value().sequence.triangles,
                                             input.value().sequence.frames[0], options);
  if (!detector) return refuse(fmt::format("{}: {}", request.files[0], detector.error().message));
  return Check(request, input.value(), std::move(detector.value()), options).run();
}

}  // namespace assay::reports
