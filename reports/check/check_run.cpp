#include "reports/check/check_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "corpus/formats/sequences.h"
#include "detector/mesh/mesh_checks.h"
#include "detector/step_result.h"
#include "oracle/mesh/step.h"
#include "oracle/referee/second_opinion.h"
#include "properties/judging/case_options.h"
#include "properties/judging/exam.h"
#include "properties/judging/verdict.h"
#include "properties/numbering.h"
#include "reports/steps/step_report.h"
#include "reports/terminal/work.h"

namespace assay::reports {

using detector::Answer;
using properties::Outcome;

namespace {

// A week: nobody waits longer for one mesh.
constexpr double longest_check_seconds = 7 * 24 * 3600.0;

class CheckRun {
 public:
  CheckRun(const CheckQuestion& question, corpus::StepSource& steps, detector::Topology mesh,
           StepAnswers& answers, bool is_at_rest, Limits& limits, const CheckListener& listener)
      : question_(question),
        steps_(steps),
        text_(steps.text()),
        mesh_(std::move(mesh)),
        answers_(answers),
        limits_(limits),
        listener_(listener),
        is_at_rest_(is_at_rest),
        bodies_(steps.counted(), steps.triangles()),
        tested_(tested_pairs(answers.under_test().contract, steps.first_frame())) {
    outcome_.is_judged = !question.no_oracle;
    outcome_.judged_by_claims = answers.judged_by_claims();
    outcome_.has_answers = answers.has_answers();
  }

  Expected<CheckAnswer> run() {
    announce();
    nlohmann::ordered_json steps = nlohmann::ordered_json::array();
    if (begin()) {
      for (std::size_t s = 0;; ++s) {
        BOOST_OUTCOME_TRY(is_there, has_step(s));
        if (!is_there) break;
        BOOST_OUTCOME_TRY(step, read_step(s));
        for (const auto& line : steps_.notes()) tell_note(s, line);
        auto json = leave_out(s);
        if (!json) json = run_step(s, step);
        if (question_.wants_report && !json->is_null()) steps.push_back(std::move(*json));
        if (refusal_) return Problem{*refusal_};
        if (outcome_.unsound) break;
      }
      if (has_facts() && !outcome_.undecided) check_facts();
    }
    outcome_.limit_reached = limits_.limit_text();
    outcome_.losses = steps_.lost();
    const bool lacks_steps =
        answers_.is_recorded() && outcome_.is_judged && outcome_.judged_steps == 0;
    outcome_.undecided |= !outcome_.losses.empty() || lacks_steps;
    constexpr std::size_t most_told = 20;
    for (std::size_t i = 0; i < std::min(outcome_.losses.size(), most_told); ++i)
      say(fmt::format("lost: {}\n", outcome_.losses[i]));
    if (outcome_.losses.size() > most_told) {
      const auto more = fmt::format("{} more parts", outcome_.losses.size() - most_told);
      outcome_.losses.resize(most_told);
      outcome_.losses.push_back(more);
      say(fmt::format("lost: {}\n", more));
    }
    for (const auto& line : steps_.last_remarks()) say(line + "\n");
    if (answers_.is_plugin() && !question_.no_oracle) {
      outcome_.judge_claims(answers_.under_test(), answers_.steps_left_out());
      for (auto& claim : answers_.beyond_reach()) outcome_.not_judged.push_back(std::move(claim));
    }
    if (outcome_.defect || outcome_.undecided) say(printed_text(answers_.run().output));
    if (!question_.shows_all_steps)
      say(fmt::format("{} of {} steps judged\n", outcome_.judged_steps, step_count()));
    write_ply();
    say(outcome_.summary());
    CheckAnswer answer{std::move(outcome_), nullptr};
    if (question_.wants_report) {
      answer.report = check_report(text_.files.empty() ? question_.files : text_.files, mesh_,
                                   answers_, answer.outcome, std::move(steps));
      answer.report["bodies"] = bodies_json();
      answer.report["at_rest"] = is_at_rest_;
      answer.report["inside"] = nlohmann::ordered_json::array();
      for (const auto& [inner, outer] : nested_.value_or(std::vector<NestedBodies>()))
        answer.report["inside"].push_back(
            {{bodies_.empty() ? "component" : "body", inner}, {"of", outer}});
    }
    return answer;
  }

 private:
  void say(const std::string& text) const { listener_.say(text); }

  std::size_t step_count() const { return steps_.count(); }

  void announce() const {
    const auto unclosed =
        std::ranges::count(mesh_.components, false, &detector::Component::is_cycle);
    const auto& title = text_.title;
    say(fmt::format("{}{}{} triangles, {} vertices{}, {} component{}", title,
                    title.empty() ? "" : ": ", mesh_.triangles.size(), steps_.first_frame().rows(),
                    loose_vertices_text(), mesh_.components.size(),
                    mesh_.components.size() == 1 ? "" : "s"));
    if (unclosed) {
      say(fmt::format(" ({} unclosed{})", unclosed,
                      answers_.is_plugin() || is_at_rest_ ? "" : ": closed with ghosts"));
    }
    say(fmt::format(
        "; {}{}{}{}\n", steps_text(step_count(), is_at_rest_, title), answers_.title(),
        question_.no_oracle ? "; no oracle: not judged" : "",
        question_.time_limit ? fmt::format("; at most {} s", *question_.time_limit) : ""));
    for (const auto& remark : text_.remarks) say(remark + "\n");
    for (const auto& file : {question_.announced_file, question_.ply_file})
      if (!file.empty()) say(fmt::format("writes {}\n", file));
  }

  // Returns a line on vertices that belong to no triangle, if there are any.
  std::string loose_vertices_text() const {
    std::vector<std::uint8_t> is_used(static_cast<std::size_t>(steps_.first_frame().rows()), 0);
    const auto& triangles = steps_.triangles();
    for (Eigen::Index i = 0; i < triangles.size(); ++i)
      is_used[properties::at(triangles.data()[i])] = 1;
    const auto loose = std::count(is_used.begin(), is_used.end(), 0);
    return loose == 0 ? "" : fmt::format(" ({} in no triangle)", loose);
  }

  // Lets the detector begin. Returns whether there are steps to go through.
  bool begin() {
    const auto verdict = answers_.begin();
    if (verdict.disturbances > 0)
      say(fmt::format("the detector's process was killed from outside and restarted {} times\n",
                      verdict.disturbances));
    if (answers_.is_plugin() && !answers_.is_recorded())
      say(fmt::format("the detector took {:.3g} s of processor time for {} step{}\n",
                      answers_.run().processor_seconds, step_count(),
                      step_count() == 1 ? "" : "s"));
    if (verdict.outcome == Outcome::holds) return true;
    outcome_.ending = verdict.explanation;
    for (const auto claim : verdict.breaches) {
      outcome_.ending +=
          fmt::format("{}{}", outcome_.ending.empty() ? "broken: " : "; broken: ", name_of(claim));
    }
    say(fmt::format("the detector's run: {}\n", outcome_.ending));
    outcome_.defect = verdict.outcome == Outcome::defect;
    outcome_.is_judged &= verdict.outcome != Outcome::refused;
    outcome_.undecided = !outcome_.defect && verdict.outcome != Outcome::refused;
    // If only the claim `deterministic` is broken, there are steps to show.
    return verdict.breaches == std::vector<properties::Claim>{properties::Claim::deterministic};
  }

  ShownWork shown_work(std::size_t s) const {
    // The time of preprocessing is shown once, with the first step.
    const auto& contract = answers_.under_test().contract;
    return {!answers_.is_plugin(),
            contract.reports_pairs(),
            s == 0 ? answers_.create_ms() : std::nullopt,
            bodies_,
            contract.separation,
            is_at_rest_};
  }

  // Returns the size of each body; null if there are none.
  nlohmann::ordered_json bodies_json() const {
    const auto* counted_pairs = steps_.counted();
    if (!counted_pairs || counted_pairs->body.empty()) return nullptr;
    const auto& body = counted_pairs->body;
    struct Size {
      std::size_t triangles = 0, vertices = 0;
    };
    std::vector<Size> sizes(properties::at(*std::max_element(body.begin(), body.end())) + 1);
    for (const auto b : body) ++sizes[properties::at(b)].vertices;
    for (Eigen::Index t = 0; t < steps_.triangles().rows(); ++t)
      ++sizes[properties::at(body[properties::at(steps_.triangles()(t, 0))])].triangles;
    nlohmann::ordered_json bodies = nlohmann::ordered_json::array();
    for (const auto& size : sizes)
      bodies.push_back({{"triangles", size.triangles}, {"vertices", size.vertices}});
    return bodies;
  }

  // Reads a step. Reading does not count against the limits.
  corpus::Expected<corpus::SourceStep> read_step(std::size_t s) {
    const Limits::Pause pause(limits_);
    return steps_.step(s);
  }

  corpus::Expected<bool> has_step(std::size_t s) {
    const Limits::Pause pause(limits_);
    return steps_.has(s);
  }

  // Tells a note. A log may have a million of them.
  void tell_note(std::size_t s, const std::string& note) {
    constexpr std::size_t most_told = 100;
    if (++notes_told_ <= most_told)
      say(fmt::format("noted before step {}: {}\n", steps_.number_of(s) + 1, note));
    if (notes_told_ == most_told) say("further notes are not shown\n");
  }

  // Returns the report's entry for a step that is not judged, or null if it has none. Nothing if
  // the step is to be judged.
  std::optional<nlohmann::ordered_json> leave_out(std::size_t s) {
    const auto why = answers_.left_out();
    if (!why) return std::nullopt;
    if (why->empty()) return nlohmann::ordered_json();
    const auto number = steps_.number_of(s);
    // Many steps are left out for the same reason, in words that differ at most in their numbers.
    const bool is_new = reasons_.insert(why->substr(0, why->find(':'))).second;
    if (is_new || question_.shows_all_steps)
      say(fmt::format("step {}: left out: {}{}\n", number + 1, *why,
                      question_.shows_all_steps ? "" : "; more left-out steps are only counted"));
    return nlohmann::ordered_json{{"step", number + 1}, {"left_out", *why}};
  }

  nlohmann::ordered_json run_step(std::size_t s, const corpus::SourceStep& step) {
    const auto shown_number = static_cast<std::size_t>(steps_.number_of(s)) + 1;
    Progress progress(fmt::format("step {}/{}", s + 1, step_count()));
    const detector::StopFunction stop = [&] {
      progress.tick();
      return limits_.exceeded() || (listener_.stop && listener_.stop());
    };
    progress.phase("detector");
    answers_.ask(s, step, stop);
    detector::StepResult& result = answers_.result(s);
    std::string told_error;
    if (result.answer == Answer::error) {
      const auto error = answers_.error_of(s);
      // The built-in detector reports errors only for its input.
      if (!answers_.is_plugin()) {
        refusal_ = fmt::format("step {}: {}", shown_number, error);
        return {};
      }
      const bool is_refused = is_over_capacity(answers_.run(), answers_.place_of(s));
      if (outcome_.ending.empty() && !is_refused) outcome_.ending = error;
      told_error = error;
    }
    if (result.answer == Answer::collision && !outcome_.collision_step) {
      outcome_.collision_step = shown_number - 1;
      outcome_.collision_time = result.first;
    }
    outcome_.undecided |= answers_.has_answers() && result.answer == Answer::undecided;
    if (question_.no_oracle) {
      progress.finish();
      say(step_text(shown_number, result, nullptr, shown_work(s)) + error_line(told_error));
      auto json = json_of(result, nullptr);
      // A plug-in may name features that do not exist.
      if (!answers_.is_plugin()) note_contacts(step, result.pairs, result.answer, true, json);
      return json;
    }

    progress.phase("oracle");
    JudgedByOracle oracle;
    const detector::SteppedMesh motion{step.x_t0, step.x_t1};
    const oracle::JudgeOptions options = {question_.jobs, stop, {}, steps_.counted(), &tested_};
    auto timed_diff = answer_in(limits_, [&] {
      return properties::judge_under(answers_.under_test().contract, motion, steps_.triangles(),
                                     options);
    });
    oracle.judgement = std::move(timed_diff.answer);
    oracle.milliseconds = timed_diff.milliseconds;
    oracle.truth = truth_of(oracle.judgement, answers_.under_test().contract, steps_.triangles());
    const auto& detector = answers_.under_test();
    oracle.diff = judge_step(answers_.run(), answers_.place_of(s),
                             {motion, steps_.triangles(), options, oracle.judgement,
                              detector.claims, detector.contract});
    const auto& diff = oracle.diff;
    progress.finish();
    if (diff.unanswered_contact && !outcome_.unanswered_step) {
      outcome_.unanswered_step = shown_number - 1;
      outcome_.unanswered_time = oracle.truth.first->time;
      outcome_.unanswered_error = told_error;
    }
    outcome_.defect |= diff.outcome == Outcome::defect;
    outcome_.undecided |= diff.outcome == Outcome::undecided || diff.outcome == Outcome::error;
    if (answers_.is_plugin()) outcome_.count(diff, result);
    ++outcome_.judged_steps;
    for (const auto claim : diff.breaches)
      outcome_.first_broken.emplace(claim, steps_.number_of(s));
    if (diff.answered_free && !outcome_.first_missed) outcome_.first_missed = steps_.number_of(s);
    const bool is_shown = question_.shows_all_steps || diff.outcome != Outcome::holds;
    if (is_shown)
      say(step_text(shown_number, result, &oracle, shown_work(s)) + error_line(told_error));
    auto json = json_of(result, &oracle);
    if (answers_.under_test().contract.separation == 0)
      note_contacts(step, oracle.truth.pairs,
                    oracle.truth.complete ? oracle.truth.answer() : Answer::undecided, is_shown,
                    json);
    if (diff.outcome == Outcome::defect) {
      print_defect(step, diff);
      if (listener_.on_failure)
        say(listener_.on_failure(
            {shown_number - 1, steps_, step, result, diff, answers_.under_test()}));
    }
    if (question_.second_opinion) {
      progress.phase("second opinion");
      json["second_opinion"] = ask_second_opinion(step, oracle.judgement, stop, progress);
    }
    return json;
  }

  // Names, reports and marks the contacts of this step that are asked for.
  void note_contacts(const corpus::SourceStep& step,
                     const std::vector<detector::PairContact>& pairs, Answer answer, bool is_shown,
                     nlohmann::ordered_json& json) {
    const detector::SteppedMesh motion{step.x_t0, step.x_t1};
    const detector::TrianglesView triangles(steps_.triangles());
    const bool asks_first = question_.built_in.pairs == detector::Pairs::first && !pairs.empty();
    auto first = asks_first ? pairs : std::vector<detector::PairContact>();
    if (asks_first) {
      const auto end = std::ranges::min(pairs, {}, &detector::PairContact::time).time.hi;
      std::erase_if(first, [&](const auto& contact) { return contact.time.lo > end; });
    }
    const StepContacts contacts{motion, triangles, asks_first ? first : pairs, bodies_,
                                is_at_rest_};
    constexpr std::size_t most_named = 10;
    if (is_shown && named_pairs_ < most_named && !pairs.empty()) {
      say(contacts.text(most_named - named_pairs_));
      named_pairs_ += contacts.pairs.size();
    }
    if (!json.is_null()) json["contacts"] = contacts.json();
    if (is_at_rest_ && (answer != Answer::undecided || !pairs.empty()))
      outcome_.rest = rest_text(pairs, bodies_);
    if (!question_.ply_file.empty()) mark(step, contacts);
    const bool is_judged_whole =
        !question_.no_oracle && (!steps_.counted() || steps_.counted()->count_all());
    if (!nested_ && answer != Answer::undecided && is_judged_whole) tell_nested(step, pairs);
  }

  // Returns by vertex its component, in place of its body, for a mesh without bodies.
  std::vector<std::int32_t> component_by_vertex() const {
    std::vector<std::int32_t> component(static_cast<std::size_t>(steps_.first_frame().rows()), 0);
    for (std::size_t c = 0; c < mesh_.components.size(); ++c) {
      for (const auto v : mesh_.components[c].vertices)
        component[properties::at(v)] = static_cast<std::int32_t>(c);
    }
    return component;
  }

  // Tells which bodies, or components of a mesh at rest, are inside of others in the first judged
  // step, because only surfaces can meet.
  void tell_nested(const corpus::SourceStep& step,
                   const std::vector<detector::PairContact>& pairs) {
    if (bodies_.empty() && !is_at_rest_) return;
    // The box of each component is compared with each other box.
    constexpr std::size_t most_components = 1000;
    if (bodies_.empty() && mesh_.components.size() > most_components)
      return say("  nested components are not looked for: there are over 1,000 components\n");
    nested_ = nested_bodies(
        step.x_t0, mesh_, bodies_.empty() ? component_by_vertex() : steps_.counted()->body, pairs);
    if (bodies_.empty()) nested_ = innermost(*nested_);
    // A component has no name known to its owner.
    const auto name = [&](std::int32_t part) {
      return bodies_.empty() ? fmt::format("the component of triangle {}",
                                           mesh_.components[properties::at(part)].triangles.front())
                             : fmt::format("body {}", part);
    };
    constexpr std::size_t most_told = 10;
    for (std::size_t i = 0; i < std::min(nested_->size(), most_told); ++i)
      say(fmt::format("  {} lies inside {}{}; their surfaces do not meet\n",
                      name((*nested_)[i].inner), name((*nested_)[i].outer),
                      is_at_rest_ ? "" : " during this step"));
    if (nested_->size() > most_told)
      say(fmt::format("  ... {} more surfaces lie inside others\n", nested_->size() - most_told));
  }

  // Keeps the mesh at the first contact of all, or else at its end.
  void mark(const corpus::SourceStep& step, const StepContacts& contacts) {
    if (std::any_of(is_marked_.begin(), is_marked_.end(), [](auto of) { return of != 0; })) return;
    is_marked_.assign(static_cast<std::size_t>(steps_.triangles().rows()), 0);
    double t = 1;
    const auto marks = contacts.marks();
    for (std::size_t i = 0; i < marks.size(); ++i) {
      const auto& [pair, time, feature] = contacts.pairs[i];
      for (const auto triangle : {pair.a, pair.b}) {
        auto& is_marked = is_marked_[properties::at(triangle)];
        is_marked = is_marked == StepContacts::crossing_mark ? is_marked : marks[i];
      }
      t = std::min(t, time.lo);
    }
    shown_mesh_ = t == 1 ? step.x_t1 : (1 - t) * step.x_t0 + t * step.x_t1;
  }

  void write_ply() {
    if (question_.ply_file.empty()) return;
    if (is_marked_.empty()) {
      shown_mesh_ = steps_.first_frame();
      is_marked_.assign(static_cast<std::size_t>(steps_.triangles().rows()), 0);
    }
    const auto status =
        corpus::write_mesh(question_.ply_file, shown_mesh_, steps_.triangles(), &is_marked_);
    if (!status) outcome_.unwritten = status.error().message;
  }

  static std::string error_line(const std::string& error) {
    return error.empty() ? "" : fmt::format("  {}\n", error);
  }

  // Returns null if nobody asked for the report, because JSON takes more memory than the results.
  // If a step ended at the limit of memory, the pairs that it found until then are left out for the
  // same reason.
  nlohmann::ordered_json json_of(detector::StepResult& result, const JudgedByOracle* oracle) const {
    if (!question_.wants_report) return nullptr;
    if (result.answer == Answer::undecided && limits_.is_out_of_memory()) result.pairs = {};
    return step_json(result, oracle, bodies_);
  }

  nlohmann::ordered_json ask_second_opinion(const corpus::SourceStep& step,
                                            const oracle::StepJudgement& judgement,
                                            const detector::StopFunction& stop,
                                            Progress& progress) {
    const double share = *question_.second_opinion;
    const auto [opinion, milliseconds] = answer_in(limits_, [&] {
      const detector::SteppedMesh motion = {step.x_t0, step.x_t1};
      const oracle::SecondOpinionOptions options = {share, question_.jobs, stop};
      const auto* counted_pairs = steps_.counted();
      const bool asks_contacts = answers_.under_test().contract.separation == 0;
      if (asks_contacts && (!counted_pairs || counted_pairs->count_all()))
        return oracle::second_opinion(motion, steps_.triangles(), judgement, options);
      // The other methods know neither relation nor separation, so the oracle is asked for all
      // contacts.
      const auto all = oracle::judge_step(motion, steps_.triangles(), {question_.jobs, stop});
      return oracle::second_opinion(motion, steps_.triangles(), all, options);
    });
    progress.finish();
    say(second_opinion_text(opinion, milliseconds));
    outcome_.undecided |= !opinion.complete;
    outcome_.unsound = !opinion.contradictions.empty();
    if (outcome_.unsound && !question_.again.empty())
      say(fmt::format("  again: {}\n", question_.again));
    return second_opinion_json(opinion, share, milliseconds);
  }

  void print_defect(const corpus::SourceStep& step, const properties::StepDiff& diff) const {
    // The stages of a plug-in are unknown.
    if (diff.missing.empty() || answers_.is_plugin()) return;
    const auto& missing_pair = diff.missing.front();
    const std::string stage =
        properties::stage_that_lost(steps_.triangles(), step.x_t0, step.x_t1, missing_pair.pair,
                                    answers_.under_test().configurations.front().options);
    say(fmt::format("  the pair of triangles {} and {}{} was lost at: {}\n", missing_pair.pair.a,
                    missing_pair.pair.b, bodies_.text(missing_pair.pair), stage));
  }

  // Returns whether the facts of the case are checked. They are facts for the built-in detector; a
  // plug-in is judged by the oracle alone.
  bool has_facts() const {
    return !answers_.is_recorded() && steps_.case_file() && !question_.no_oracle &&
           question_.detector.library.empty();
  }

  // Checks the facts of the case. They are true, so an answer that differs is a defect.
  void check_facts() {
    const auto check = properties::check_case(*steps_.case_file(), question_.built_in.culling,
                                              question_.jobs, question_.built_in.arithmetic);
    for (const auto& line : check.broken_facts) say(fmt::format("expected facts: {}\n", line));
    outcome_.facts_differ = !check.broken_facts.empty();
    outcome_.defect |= outcome_.facts_differ;
  }

  const CheckQuestion& question_;
  corpus::StepSource& steps_;
  const corpus::InputText text_;
  detector::Topology mesh_;
  StepAnswers& answers_;
  Limits& limits_;
  const CheckListener& listener_;
  const bool is_at_rest_;
  const properties::BodyNames bodies_;
  std::optional<std::vector<NestedBodies>> nested_;  // nothing until a step is judged
  std::size_t named_pairs_ = 0;                      // pairs in contact, as far as they were named
  // For --ply: the mesh at its first contact, and by triangle whether it is in contact.
  detector::Positions shown_mesh_;
  std::vector<std::uint8_t> is_marked_;
  std::optional<std::string> refusal_;
  const detector::CountedPairs tested_;  // under the contract
  std::size_t notes_told_ = 0;
  std::set<std::string> reasons_;  // why steps were left out, as far as these were told
  CheckOutcome outcome_;
};

}  // namespace

corpus::Expected<CheckInput> read_check_input(const std::vector<std::string>& files) {
  BOOST_OUTCOME_TRY(steps, corpus::read_steps({files.begin(), files.end()}));
  if (const auto* c = steps->case_file()) {
    if (const auto options = properties::read_options(*c); !options)
      return corpus::problem_in(files[0], options.error().message);
  }
  return CheckInput{files[0], std::move(steps)};
}

corpus::Expected<CheckInput> read_bodies(const BodyWords& bodies, corpus::BodyFiles rest) {
  for (const auto& frames : bodies) rest.frames.emplace_back(frames.begin(), frames.end());
  BOOST_OUTCOME_TRY(steps, corpus::steps_of_bodies(rest));
  return CheckInput{bodies[0][0], std::move(steps)};
}

Expected<CheckAnswer> check_mesh(const CheckQuestion& question, CheckInput& input,
                                 const std::filesystem::path& worker,
                                 const CheckListener& listener) {
  const auto vertices = input.steps->first_frame().rows();
  if (const auto bad = detector::check_triangles(input.steps->triangles(), vertices))
    return corpus::problem_of_triangles(*input.steps, input.file, *bad);
  if (question.distance) return check_separation(question, input, listener);
  const bool is_plugin = !input.recorded && !question.detector.library.empty();
  if (is_plugin) {
    BOOST_OUTCOME_TRY(whole, input.steps->read_whole());
    input.steps = std::move(whole);
  }
  Limits limits(question.time_limit, question.memory_limit);
  const auto begin = [&]() -> Expected<std::unique_ptr<StepAnswers>> {
    if (input.recorded) return std::move(input.recorded);
    if (!question.answers.empty())
      return answers_of_table(question.answers, input, question.adjacency);
    if (!is_plugin) {
      BuiltInChoice choice = question.built_in;
      choice.threads = static_cast<std::uint32_t>(question.threads);
      return answers_of_built_in(choice, input, limits);
    }
    DetectorWords words = question.detector;
    words.threads = std::max<std::uint64_t>(question.threads, 1);
    BOOST_OUTCOME_TRY(plugin, choose_detector(words,
                                              {question.time_limit.value_or(longest_check_seconds),
                                               question.memory_limit.value_or(0)},
                                              worker));
    return answers_of_plugin(std::move(plugin), input);
  };
  BOOST_OUTCOME_TRY(answers, begin());
  auto mesh = detector::make_topology(input.steps->triangles(), vertices);
  return CheckRun(question, *input.steps, std::move(mesh), *answers, input.is_at_rest, limits,
                  listener)
      .run();
}

}  // namespace assay::reports
