// `assay check`: consecutive frames are the steps of one mesh; each goes through the detector and,
// unless left out, the oracle, and the two are compared.
#include <fmt/format.h>

#include <chrono>
#include <new>
#include <nlohmann/json.hpp>

#include "detector/mesh/mesh_checks.h"
#include "detector/mesh/topology.h"
#include "reports/check/check_input.h"
#include "reports/check/check_outcome.h"
#include "reports/check/subject.h"
#include "reports/steps/json_output.h"
#include "reports/steps/second_opinion_text.h"
#include "reports/steps/step_text.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/limits.h"
#include "reports/terminal/progress.h"
#include "reports/verbs/commands.h"

namespace assay::reports {
namespace {

using detector::Answer;
using properties::Outcome;

class Check {
 public:
  Check(const CheckRequest& request, const CheckInput& input, detector::Topology mesh,
        Subject& subject, Limits& limits)
      : request_(request),
        case_(input.c),
        is_case_file_(input.is_case_file),
        mesh_(std::move(mesh)),
        subject_(subject),
        script_(corpus::steps_of(input.c)),
        limits_(limits) {
    outcome_.judged_by_claims = subject.judged_by_claims();
  }

  int run() {
    announce();
    nlohmann::ordered_json steps = nlohmann::ordered_json::array();
    if (begin()) {
      for (std::size_t s = 0; s < step_count(); ++s) {
        steps.push_back(run_step(s));
        if (refused_) return refuse(*refused_);
        if (outcome_.unsound) break;
      }
      if (has_facts() && !outcome_.undecided) check_facts();
    }
    outcome_.limit_reached = limits_.reached();
    fmt::print("{}", outcome_.summary(request_));
    if (!request_.json_file.empty()) {
      if (auto problem = write_json(std::move(steps))) return refuse(*problem);
    }
    return outcome_.exit_code(request_);
  }

 private:
  std::size_t step_count() const { return script_.size(); }

  void announce() const {
    std::size_t unclosed = 0;
    for (const auto& component : mesh_.components) unclosed += component.is_cycle ? 0 : 1;
    fmt::print("{} triangles, {} vertices, {} component{}", mesh_.triangles.size(),
               case_.frames[0].rows(), mesh_.components.size(),
               mesh_.components.size() == 1 ? "" : "s");
    if (unclosed) {
      fmt::print(" ({} unclosed{})", unclosed,
                 request_.plugin_library.empty() ? ": closed with ghosts" : "");
    }
    fmt::print("; {} step{}; {}{}{}\n", step_count(), step_count() == 1 ? "" : "s",
               subject_.title(), request_.use_oracle ? "" : "; no oracle: not judged",
               request_.time_limit ? fmt::format("; at most {} s", *request_.time_limit) : "");
    if (!request_.json_file.empty()) fmt::print("writes {}\n", request_.json_file);
    std::fflush(stdout);
  }

  // Whether there are steps to go through.
  bool begin() {
    const auto verdict = subject_.begin();
    if (verdict.disturbances > 0)
      fmt::print("the detector's process was killed from outside {} times, and began anew\n",
                 verdict.disturbances);
    if (verdict.outcome == Outcome::holds) return true;
    outcome_.ended = verdict.what;
    for (const auto claim : verdict.broken) {
      outcome_.ended +=
          fmt::format("{}{}", outcome_.ended.empty() ? "broken: " : "; broken: ", name_of(claim));
    }
    fmt::print("the detector's run: {}\n", outcome_.ended);
    outcome_.defect = verdict.outcome == Outcome::defect;
    outcome_.undecided = !outcome_.defect;
    // What only differs between two runs has steps to show.
    return verdict.broken == std::vector<properties::Claim>{properties::Claim::deterministic};
  }

  nlohmann::ordered_json run_step(std::size_t s) {
    Progress progress(fmt::format("step {}/{}", s + 1, step_count()));
    const detector::StopFunction stop = [&] {
      progress.tick();
      return limits_.exceeded();
    };
    const auto &x_t0 = start_of(case_, script_[s]), &x_t1 = end_of(case_, script_[s]);

    progress.phase("detector");
    const detector::StepResult result = subject_.answer(s, stop);
    if (result.answer == Answer::error) {
      const auto error = subject_.error_of(result);
      if (error.refused) {
        refused_ = fmt::format("step {}: {}", s + 1, error.message);
        return {};
      }
      if (outcome_.ended.empty()) outcome_.ended = error.message;
    }
    if (result.answer == Answer::collision && !outcome_.collision_step) {
      outcome_.collision_step = s;
      outcome_.collision_time = result.first;
    }
    outcome_.undecided |= result.answer == Answer::undecided;
    if (!request_.use_oracle) {
      progress.finish();
      fmt::print("{}", step_text(s + 1, result, nullptr, 0, nullptr));
      return step_json(result, nullptr, 0, nullptr);
    }

    progress.phase("oracle");
    double oracle_ms = 0;
    const oracle::StepJudgement judgement = judge(x_t0, x_t1, stop, oracle_ms);
    const auto diff = subject_.judge(result, judgement);
    progress.finish();
    outcome_.defect |= diff.outcome == Outcome::defect;
    outcome_.undecided |= diff.outcome == Outcome::undecided || diff.outcome == Outcome::error;
    outcome_.left_out_misses += diff.left_out_missed ? 1 : 0;
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
      opinion =
          oracle::second_opinion(start_of(case_, script_[s]), end_of(case_, script_[s]),
                                 case_.triangles, judgement, {share, request_.jobs, stop, {}});
    } catch (const std::bad_alloc&) {
      limits_.memory_failed();
    }
    const double milliseconds =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    progress.finish();
    fmt::print("{}", second_opinion_text(opinion, milliseconds));
    outcome_.undecided |= !opinion.complete;
    outcome_.unsound = !opinion.contradictions.empty();
    if (outcome_.unsound) fmt::print("  replay: {}\n", replay_line(s));
    std::fflush(stdout);
    return second_opinion_json(opinion, share, milliseconds);
  }

  // The step alone, where each frame is a file of its own; the same queries are chosen again.
  std::string replay_line(std::size_t s) const {
    const auto& files = request_.files;
    const bool file_a_frame = files.size() == case_.frames.size();
    std::string input;
    for (std::size_t i = 0; i < files.size(); ++i) {
      if (!file_a_frame || i == s || i == s + 1) input += " " + files[i];
    }
    return fmt::format("assay check{} --second-opinion {}", input, *request_.second_opinion);
  }

  oracle::StepJudgement judge(const detector::Positions& x_t0, const detector::Positions& x_t1,
                              const detector::StopFunction& stop, double& milliseconds) {
    const auto begin = std::chrono::steady_clock::now();
    oracle::StepJudgement judgement;
    try {
      judgement = oracle::judge_step(x_t0, x_t1, case_.triangles, {request_.jobs, stop});
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
    const std::string stage = subject_.stage_that_lost(s, lost.pair);
    if (stage.empty()) return;
    fmt::print("  triangles {} and {} were lost at: {}\n", lost.pair.a, lost.pair.b, stage);
  }

  // The facts of a case are the built-in detector's; a plug-in is judged by the oracle alone.
  bool has_facts() const {
    return is_case_file_ && request_.use_oracle && request_.plugin_library.empty();
  }

  // A case states what is true of it: an answer that differs is a defect.
  void check_facts() {
    const auto report =
        properties::check_case(case_, request_.culling, request_.jobs, request_.arithmetic);
    for (const auto& line : report.failed) fmt::print("expected facts: {}\n", line);
    outcome_.facts_differ = !report.failed.empty();
    outcome_.defect |= outcome_.facts_differ;
  }

  std::optional<std::string> write_json(nlohmann::ordered_json steps) const {
    const auto or_null = [](const std::string& text) {
      return text.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(text);
    };
    const auto tested = subject_.to_json();
    const nlohmann::ordered_json report = {{"schema", "assay-check/1"},
                                           {"version", version_text()},
                                           {"files", request_.files},
                                           {"triangles", mesh_.triangles.size()},
                                           {"components", mesh_.components.size()},
                                           {"culling", tested["culling"]},
                                           {"arithmetic", tested["arithmetic"]},
                                           {"detector", tested["detector"]},
                                           {"detector_ended", or_null(outcome_.ended)},
                                           {"judged", request_.use_oracle},
                                           {"outcome", outcome_.word(request_)},
                                           {"limit_reached", or_null(limits_.reached())},
                                           {"peak_memory_bytes", peak_resident_bytes()},
                                           {"steps", std::move(steps)}};
    return write_json_file(request_.json_file, report);
  }

  const CheckRequest& request_;
  const corpus::Case& case_;
  bool is_case_file_;
  detector::Topology mesh_;
  Subject& subject_;
  std::vector<corpus::CaseStep> script_;
  Limits& limits_;
  std::optional<std::string> refused_;
  CheckOutcome outcome_;
};

}  // namespace

int run_check(const CheckRequest& request) {
  // Before the work, not after it.
  if (auto problem = cannot_write(request.json_file, request.files)) return refuse(*problem);
  auto input = read_check_input(request.files);
  if (!input) return refuse(input.error().message);
  auto& c = input.value().c;
  if (const auto bad = detector::check_triangles(c.triangles, c.frames[0].rows())) {
    return refuse(fmt::format("{}: {}", request.files[0], bad->message));
  }
  Limits limits(request.time_limit, request.memory_limit);
  auto made = request.plugin_library.empty() ? make_built_in(request, input.value(), limits)
                                             : make_plugin_subject(request, input.value());
  if (const auto* problem = std::get_if<std::string>(&made)) return refuse(*problem);
  auto mesh = detector::make_topology(c.triangles, c.frames[0].rows());
  return Check(request, input.value(), std::move(mesh), *std::get<std::unique_ptr<Subject>>(made),
               limits)
      .run();
}

}  // namespace assay::reports
