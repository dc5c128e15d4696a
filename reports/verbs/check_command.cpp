// `assay check`: consecutive frames are the steps of one mesh; each goes through the detector and,
// unless left out, the oracle, and the two are compared.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "detector/mesh/mesh_checks.h"
#include "detector/mesh/topology.h"
#include "detector/step_result.h"
#include "reports/check/check_input.h"
#include "reports/check/check_outcome.h"
#include "reports/check/check_report.h"
#include "reports/check/claims_tally.h"
#include "reports/check/plugin_text.h"
#include "reports/check/subject.h"
#include "reports/check/timed_oracle.h"
#include "reports/steps/second_opinion_text.h"
#include "reports/steps/step_json.h"
#include "reports/steps/step_text.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/limits.h"
#include "reports/terminal/option_words.h"
#include "reports/terminal/progress.h"
#include "reports/terminal/text_file.h"
#include "reports/terminal/version.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

struct CheckRequest {
  std::vector<std::string> files;  // frames of one mesh, or one case file
  BuiltInChoice built_in;
  DetectorWords detector;
  std::uint64_t threads = 0;
  bool no_oracle = false;
  std::optional<double> second_opinion;  // share in (0,1]; needs the oracle
  int jobs = 1;
  std::optional<double> time_limit;           // seconds
  std::optional<std::uint64_t> memory_limit;  // bytes
  bool fail_on_collision = false;
  std::string json_file;  // empty: none
};

// A week: nobody waits longer for one mesh.
constexpr double no_limit_seconds = 7 * 24 * 3600.0;

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
        limits_(limits),
        oracle_(request.jobs, subject.asked(), limits),
        tally_(subject.description()) {
    outcome_.is_judged = !request.no_oracle;
    outcome_.judged_by_claims = subject.judged_by_claims();
    outcome_.has_answers = subject.has_answers();
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
    if (!request_.no_oracle) tally_.tell(outcome_, subject_.steps_left_out());
    if (outcome_.defect || outcome_.undecided) fmt::print("{}", printed_text(subject_.printed()));
    fmt::print("{}", outcome_.summary());
    if (!request_.json_file.empty()) {
      const auto report = check_report(request_.files, mesh_, subject_, outcome_, std::move(steps));
      const auto written = write_json_file(request_.json_file, report);
      if (!written) return refuse(written.error());
    }
    return outcome_.exit_code(request_.fail_on_collision);
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
                 request_.detector.library.empty() ? ": closed with ghosts" : "");
    }
    fmt::print("; {} step{}; {}{}{}\n", step_count(), step_count() == 1 ? "" : "s",
               subject_.title(), request_.no_oracle ? "; no oracle: not judged" : "",
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
    if (const auto seconds = subject_.processor_seconds())
      fmt::print("the detector took {:.3g} s of processor time for {} step{}\n", *seconds,
                 step_count(), step_count() == 1 ? "" : "s");
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

  ShownWork shown_work(std::size_t s) const {
    const auto* plugin = subject_.description();
    // The time of preprocessing is told once, with the first step.
    return {!plugin, !plugin || plugin->contract.reports_pairs,
            s == 0 ? subject_.create_ms() : std::nullopt};
  }

  nlohmann::ordered_json run_step(std::size_t s) {
    Progress progress(fmt::format("step {}/{}", s + 1, step_count()));
    const detector::StopFunction stop = [&] {
      progress.tick();
      return limits_.exceeded();
    };
    const auto &x_t0 = start_of(case_, script_[s]), &x_t1 = end_of(case_, script_[s]);

    progress.phase("detector");
    detector::StepResult result = subject_.answer(s, stop);
    std::string told_error;
    if (result.answer == Answer::error) {
      const auto error = subject_.error_of(s, result);
      if (error.refused) {
        refused_ = fmt::format("step {}: {}", s + 1, error.message);
        return {};
      }
      if (outcome_.ended.empty()) outcome_.ended = error.message;
      told_error = fmt::format("  {}\n", error.message);
    }
    if (result.answer == Answer::collision && !outcome_.collision_step) {
      outcome_.collision_step = s;
      outcome_.collision_time = result.first;
    }
    outcome_.undecided |= subject_.has_answers() && result.answer == Answer::undecided;
    if (request_.no_oracle) {
      progress.finish();
      fmt::print("{}{}", step_text(s + 1, result, nullptr, 0, nullptr, shown_work(s)), told_error);
      return json_of(result, nullptr, 0, nullptr);
    }

    progress.phase("oracle");
    const auto [judgement, oracle_ms] = oracle_.judge(x_t0, x_t1, case_.triangles, stop);
    const auto diff = subject_.judge(s, result, judgement);
    progress.finish();
    outcome_.defect |= diff.outcome == Outcome::defect;
    outcome_.undecided |= diff.outcome == Outcome::undecided || diff.outcome == Outcome::error;
    tally_.add(diff, result, judgement);
    fmt::print("{}{}", step_text(s + 1, result, &judgement, oracle_ms, &diff, shown_work(s)),
               told_error);
    if (diff.outcome == Outcome::defect) print_defect(s, diff);
    std::fflush(stdout);
    auto json = json_of(result, &judgement, oracle_ms, &diff);
    if (request_.second_opinion) {
      progress.phase("second opinion");
      json["second_opinion"] = ask_second_opinion(s, judgement, stop, progress);
    }
    return json;
  }

  // Null where nobody asked for the report, for it takes more memory than what it tells. Of a step
  // that ended at the limit of memory the pairs found until then are left out for the same reason.
  nlohmann::ordered_json json_of(detector::StepResult& result,
                                 const oracle::StepJudgement* judgement, double oracle_ms,
                                 const properties::StepDiff* diff) const {
    if (request_.json_file.empty()) return nullptr;
    if (result.answer == Answer::undecided && limits_.is_out_of_memory()) result.pairs = {};
    return step_json(result, judgement, oracle_ms, diff);
  }

  nlohmann::ordered_json ask_second_opinion(std::size_t s, const oracle::StepJudgement& judgement,
                                            const detector::StopFunction& stop,
                                            Progress& progress) {
    const double share = *request_.second_opinion;
    const auto [opinion, milliseconds] =
        oracle_.second_opinion(start_of(case_, script_[s]), end_of(case_, script_[s]),
                               case_.triangles, judgement, share, stop);
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

  void print_defect(std::size_t s, const properties::StepDiff& diff) const {
    if (diff.missing.empty()) return;
    const auto& lost = diff.missing.front();
    const std::string stage = subject_.stage_that_lost(s, lost.pair);
    if (stage.empty()) return;
    fmt::print("  triangles {} and {} were lost at: {}\n", lost.pair.a, lost.pair.b, stage);
  }

  // The facts of a case are the built-in detector's; a plug-in is judged by the oracle alone.
  bool has_facts() const {
    return is_case_file_ && !request_.no_oracle && request_.detector.library.empty();
  }

  // A case states what is true of it: an answer that differs is a defect.
  void check_facts() {
    const auto report = properties::check_case(case_, request_.built_in.culling, request_.jobs,
                                               request_.built_in.arithmetic);
    for (const auto& line : report.failed) fmt::print("expected facts: {}\n", line);
    outcome_.facts_differ = !report.failed.empty();
    outcome_.defect |= outcome_.facts_differ;
  }

  const CheckRequest& request_;
  const corpus::Case& case_;
  bool is_case_file_;
  detector::Topology mesh_;
  Subject& subject_;
  std::vector<corpus::CaseStep> script_;
  Limits& limits_;
  TimedOracle oracle_;
  std::optional<std::string> refused_;
  ClaimsTally tally_;
  CheckOutcome outcome_;
};

int run_check(const CheckRequest& request) {
  // Before the work, not after it.
  if (auto may = may_write(request.json_file, request.files); !may) return refuse(may.error());
  auto input = read_check_input(request.files);
  if (!input) return refuse(Refusal(input.error()));
  auto& c = input.value().c;
  if (const auto bad = detector::check_triangles(c.triangles, c.frames[0].rows())) {
    return refuse(fmt::format("{}: {}", request.files[0], bad->message));
  }
  Limits limits(request.time_limit, request.memory_limit);
  BuiltInChoice built_in = request.built_in;
  built_in.threads = static_cast<std::uint32_t>(request.threads);
  auto subject = request.detector.library.empty()
                     ? make_built_in(built_in, input.value(), limits)
                     : make_plugin_subject(request.detector.library,
                                           {request.time_limit.value_or(no_limit_seconds),
                                            request.memory_limit.value_or(0),
                                            request.detector.isolation,
                                            {},
                                            std::max<std::uint64_t>(request.threads, 1)},
                                           input.value());
  if (!subject) return refuse(subject.error());
  auto mesh = detector::make_topology(c.triangles, c.frames[0].rows());
  return Check(request, input.value(), std::move(mesh), *subject.value(), limits).run();
}

void add_options(Verb& verb, CheckRequest& request) {
  verb.add("frames", request.files,
           "Two or more frames (OBJ, PLY, OFF; .gz too), or one case file (.json)")
      .required();
  auto plugin =
      add_detector_alone(verb, request.detector, "A plug-in's library (default: the built-in)");
  add_threads(verb, request.threads);
  auto& built_in = request.built_in;
  plugin
      .excludes(add_choice(verb, "--culling", built_in.culling,
                           "auto, view-auto, view-point, view-line, normal-cone, bvh, none",
                           properties::culling_named, "How the detector culls (default auto)"))
      .excludes(add_choice(verb, "--start", built_in.start, "verified, clean, unknown",
                           properties::start_named,
                           "What is known of the first frame (default verified)"))
      .excludes(add_choice(verb, "--pairs", built_in.pairs, "all, first", properties::pairs_named,
                           "Which pairs are asked for (default all)"))
      .excludes(add_choice(verb, "--arithmetic", built_in.arithmetic,
                           "exact, bounded, double, float", properties::arithmetic_named,
                           "What the detector computes in (default exact)"));
  const auto no_oracle =
      verb.add_flag("--no-oracle", request.no_oracle, "Detector only; prints `not judged`");
  verb.add("--second-opinion", request.second_opinion,
           "Check the oracle itself by other methods, on this share of its questions")
      .with(share())
      .excludes(no_oracle);
  add_jobs(verb, request.jobs);
  verb.add("--time", request.time_limit,
           "Limit in seconds of processor time, all threads together; what is left is "
           "undecided")
      .with(positive());
  add_choice(verb, "--memory", request.memory_limit,
             "a whole number above 0, alone or with K, M or G", memory_size,
             "Limit of resident memory, such as 6GB or 512MB (MB: 2^20 bytes)");
  verb.add_flag("--fail-on-collision", request.fail_on_collision,
                "Exit code 5 when they agree on a collision");
  verb.add("--json", request.json_file, "Write the report here (assay-check/1)");
}

}  // namespace

Action add_check(CLI::App& app) {
  return make_verb(app, "check", "Detector against oracle on the steps of one mesh", add_options,
                   run_check);
}

}  // namespace assay::reports
