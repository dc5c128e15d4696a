#include <fmt/format.h>

#include <algorithm>
#include <boost/outcome/try.hpp>
#include <nlohmann/json.hpp>

#include "detector/mesh/mesh_checks.h"
#include "detector/mesh/topology.h"
#include "oracle/distance/step_distance.h"
#include "properties/judging/verdict.h"
#include "properties/numbering.h"
#include "reports/check/check_run.h"
#include "reports/steps/step_report.h"
#include "reports/terminal/words.h"
#include "reports/terminal/work.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

// The oracle's results for a step.
struct StepDistance {
  oracle::StepJudgement near;
  oracle::LeastDistance least;
  double milliseconds = 0;

  bool complete() const { return near.complete && least.complete; }
  bool is_near() const { return !near.pairs.empty(); }
  std::size_t near_at_start() const {
    return static_cast<std::size_t>(
        std::count_if(near.pairs.begin(), near.pairs.end(),
                      [](const auto& contact) { return contact.time.hi == 0; }));
  }
  const detector::PairContact& first() const {
    return *std::min_element(near.pairs.begin(), near.pairs.end(),
                             [](const auto& a, const auto& b) { return a.time < b.time; });
  }
};

// The name of a step in texts: its number, or "at rest" for a mesh without times.
struct StepNaming {
  std::size_t number;
  bool is_at_rest;
  const properties::BodyNames& bodies;

  std::string contact(const detector::PairContact& contact) const {
    const auto& [pair, time, feature] = contact;
    if (!is_at_rest) return properties::contact_text(contact, bodies.text(pair));
    return fmt::format("triangles {} and {}{} ({})", pair.a, pair.b, bodies.text(pair),
                       properties::name_of(feature.kind));
  }
};

std::string text_of(const StepNaming& naming, const StepDistance& step) {
  std::string out = naming.is_at_rest ? "at rest: " : fmt::format("step {}: ", naming.number);
  if (!step.complete()) {
    out += "undecided";
    if (step.is_near()) out += fmt::format("; {} pairs near so far", step.near.pairs.size());
    out += "\n";
  } else if (!step.is_near()) {
    out += "apart\n";
  } else {
    out += "near";
    if (!naming.is_at_rest) out += " at t = " + time_text(step.near.first);
    out += ", " + pairs_text(step.near.pairs.size());
    if (const auto count = step.near_at_start(); count && !naming.is_at_rest)
      out += fmt::format(", {} near at the start", count);
    out += fmt::format("\n  first: {}\n", naming.contact(step.first()));
  }
  if (step.least.complete && step.least.where) {
    out += fmt::format("  least distance {}: {}\n", step.least.distance,
                       naming.contact(*step.least.where));
  } else if (step.least.complete) {
    out += "  least distance: none: no pair counts, or all distances exceed the largest double\n";
  }
  return out + fmt::format("  ms:   oracle {:.1f}; {} feature candidates\n", step.milliseconds,
                           step.near.feature_candidates);
}

Json json_of(const StepDistance& step, const properties::BodyNames& bodies) {
  Json pairs = Json::array();
  for (const auto& contact : step.near.pairs) pairs.push_back(to_json(contact, bodies));
  const bool has_place = step.least.complete && step.least.where;
  return {{"answer", !step.complete() ? "undecided"
                     : step.is_near() ? "near"
                                      : "apart"},
          {"first_time", step.near.complete && step.is_near() ? to_json(step.near.first) : Json()},
          {"near_at_start", step.near_at_start()},
          {"pairs", std::move(pairs)},
          // Null if no pair counts, or if the distance is not known.
          {"least_distance", has_place ? Json(step.least.distance) : Json()},
          {"least_at", has_place ? to_json(*step.least.where, bodies) : Json()},
          {"feature_candidates", step.near.feature_candidates},
          {"time_ms", step.milliseconds}};
}

// Asks both questions about a step. If memory fails, the step is undecided.
StepDistance ask(const detector::SteppedMesh& motion, const detector::TrianglesView& triangles,
                 double separation, const oracle::DistanceOptions& options, Limits& limits) {
  auto near = answer_in(limits, [&] {
    return oracle::judge_distance(motion, triangles, {separation, 0}, options);
  });
  auto least =
      answer_in(limits, [&] { return oracle::least_distance(motion, triangles, options); });
  return {std::move(near.answer), std::move(least.answer), near.milliseconds + least.milliseconds};
}

struct SeparationRun {
  const CheckQuestion& question_;
  CheckInput& input_;
  const CheckListener& listener_;
  const AskedDistance& distance_ = *question_.distance;
  corpus::StepSource& steps_ = *input_.steps;
  const detector::Topology mesh_ =
      detector::make_topology(steps_.triangles(), steps_.first_frame().rows());
  const properties::BodyNames bodies_{steps_.counted(), steps_.triangles()};
  Limits limits_{question_.time_limit, question_.memory_limit};
  Json entries_ = Json::array();
  std::size_t near_pairs_ = 0;        // of the first step that is near
  std::optional<double> least_ = {};  // over all steps; empty if one is undecided
  CheckOutcome outcome_ = {};         // its collision is the first step that is near

  Expected<CheckAnswer> run() {
    announce();
    for (std::size_t s = 0; s < steps_.count(); ++s) {
      BOOST_OUTCOME_TRY(run_step(s));
    }
    if (outcome_.undecided) least_.reset();
    listener_.say(summary());
    auto report = question_.wants_report ? make_report() : Json();
    return CheckAnswer{std::move(outcome_), std::move(report)};
  }

 private:
  Json make_report() {
    const auto files = steps_.text().files;
    const auto or_null = [](const std::string& text) { return text.empty() ? Json() : Json(text); };
    return {{"schema", "assay-check/1"},
            {"version", version_text()},
            {"files", files.empty() ? question_.files : files},
            {"triangles", mesh_.triangles.size()},
            {"components", mesh_.components.size()},
            {"separation", distance_.offsets.empty() ? Json(distance_.separation) : Json()},
            {"offsets", distance_.offsets.empty() ? Json() : Json(distance_.offsets)},
            {"outcome", outcome_.undecided        ? "undecided"
                        : outcome_.collision_step ? "near"
                                                  : "apart"},
            {"limit_reached", or_null(limits_.limit_text())},
            {"least_distance", least_ ? Json(*least_) : Json()},
            {"peak_memory_bytes", peak_resident_bytes()},
            {"steps", std::move(entries_)},
            {"at_rest", input_.is_at_rest}};
  }

  std::string distance_text() const {
    return distance_.offsets.empty() ? fmt::format("{}", distance_.separation)
                                     : "the sum of two bodies' offsets";
  }

  std::vector<double> offsets_of_vertices() const {
    if (distance_.offsets.empty()) return {};
    const auto* counted_pairs = steps_.counted();
    std::vector<double> offsets(static_cast<std::size_t>(steps_.first_frame().rows()),
                                distance_.offsets.front());
    for (std::size_t v = 0; counted_pairs && v < counted_pairs->body.size(); ++v)
      offsets[v] = distance_.offsets[properties::at(counted_pairs->body[v])];
    return offsets;
  }

  void announce() const {
    const auto components = mesh_.components.size();
    const auto text = steps_.text();
    listener_.say(fmt::format(
        "{}{}{} triangles, {} vertices, {} component{}; {}the oracle, within {}; pairs of "
        "triangles that share no vertex\n",
        text.title, text.title.empty() ? "" : ": ", mesh_.triangles.size(),
        steps_.first_frame().rows(), components, components == 1 ? "" : "s",
        steps_text(steps_.count(), input_.is_at_rest, text.title), distance_text()));
    for (const auto& remark : text.remarks) listener_.say(remark + "\n");
    if (!question_.announced_file.empty())
      listener_.say(fmt::format("writes {}\n", question_.announced_file));
  }

  Expected<void> run_step(std::size_t s) {
    auto bodies = [&] {
      const Limits::Pause pause(limits_);  // reading does not count against the limits
      return steps_.step(s);
    }();
    if (!bodies) return bodies.error();
    Progress progress(fmt::format("step {}/{}", s + 1, steps_.count()));
    progress.phase("oracle");
    oracle::DistanceOptions options;
    options.jobs = question_.jobs;
    options.counted = steps_.counted();
    options.stop = [&] {
      progress.tick();
      return limits_.exceeded() || (listener_.stop && listener_.stop());
    };
    options.offsets = offsets_of_vertices();
    const auto step = ask({bodies.value().x_t0, bodies.value().x_t1}, steps_.triangles(),
                          distance_.separation, options, limits_);
    progress.finish();
    outcome_.undecided |= !step.complete();
    if (step.near.complete && step.is_near() && !outcome_.collision_step) {
      outcome_.collision_step = s;
      outcome_.collision_time = step.near.first;
      near_pairs_ = step.near.pairs.size();
    }
    if (step.least.complete && step.least.where)
      least_ = std::min(least_.value_or(step.least.distance), step.least.distance);
    listener_.say(text_of({s + 1, input_.is_at_rest, bodies_}, step));
    if (question_.wants_report) entries_.push_back(json_of(step, bodies_));
    return outcome::success();
  }

  std::string summary() const {
    const auto& [near_step, near_time] = std::tie(outcome_.collision_step, outcome_.collision_time);
    std::string text = outcome_.undecided
                           ? "not near so far"
                           : fmt::format("apart: {} within {}",
                                         input_.is_at_rest ? "nothing" : "never", distance_text());
    if (near_step && input_.is_at_rest) {
      text = fmt::format("within {}: {}", distance_text(), pairs_text(near_pairs_));
    } else if (near_step) {
      text = fmt::format("near at t = {} of step {}", time_text(near_time), *near_step + 1);
    }
    if (least_) text += fmt::format("; least distance {}", *least_);
    if (outcome_.undecided)
      text += fmt::format("; undecided: {} reached",
                          limits_.limit_text().empty() ? "a limit" : limits_.limit_text());
    return text + "\n";
  }
};

}  // namespace

Expected<CheckAnswer> check_separation(const CheckQuestion& question, CheckInput& input,
                                       const CheckListener& listener) {
  return SeparationRun{question, input, listener}.run();
}

}  // namespace assay::reports
