#include "reports/steps/step_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "detector/step_result.h"
#include "properties/judging/agreement.h"

namespace assay::reports {

using detector::Answer;
using properties::Outcome;

std::string time_text(const detector::TimeEnclosure& time) {
  if (time.lo == time.hi) return fmt::format("{}", time.lo);
  const std::string lo = fmt::format("{:.9g}", time.lo), hi = fmt::format("{:.9g}", time.hi);
  return lo == hi ? lo : fmt::format("[{}, {}]", lo, hi);
}

namespace {

// Whether detector and oracle differ. If the outcome is `holds`, they differ in ways that break no
// claim.
bool differs(const properties::StepDiff& diff) {
  return diff.wrong_answer() || diff.wrong_first_time() || !diff.missing.empty() ||
         !diff.spurious.empty() || !diff.missing_candidates.empty() || !diff.late.empty() ||
         !diff.early.empty();
}

std::string verdict_text(const properties::StepDiff& diff) {
  if (diff.outcome == Outcome::holds) return differs(diff) ? "no claim is broken" : "agree";
  if (diff.outcome == Outcome::refused) return "beyond its capacity";
  return diff.outcome == Outcome::undecided ? "undecided" : "DIFFER";
}

std::string diff_text(const properties::StepDiff& diff, const ShownWork& shown) {
  std::string out = fmt::format("  diff: {} missing, {} spurious, {} late, {} early{}{}{}\n",
                                diff.missing.size(), diff.spurious.size(), diff.late.size(),
                                diff.early.size(), diff.wrong_answer() ? ", wrong answer" : "",
                                diff.wrong_first_time() ? ", wrong first time" : "",
                                diff.partial ? " (partial)" : "");
  if (!diff.broken.empty()) {
    out += "  broken:";
    for (const auto claim : diff.broken) out += fmt::format(" {}", properties::name_of(claim));
    out += "\n";
  }
  constexpr std::size_t most_listed = 10;
  const auto list = [&](const char* heading, const std::vector<detector::PairContact>& pairs,
                        bool has_features) {
    for (std::size_t i = 0; i < pairs.size() && i < most_listed; ++i) {
      const auto& [pair, time, feature] = pairs[i];
      out += fmt::format("  {}: triangles {} and {}{} at t = {}", heading, pair.a, pair.b,
                         shown.bodies.text(pair), time_text(time));
      out += has_features ? fmt::format(" ({})\n", properties::name_of(feature.kind)) : "\n";
    }
    if (pairs.size() > most_listed)
      out += fmt::format("  ... {} more\n", pairs.size() - most_listed);
  };
  list("missing", diff.missing, true);
  list("spurious", diff.spurious, shown.has_stages);
  list("no candidate", diff.missing_candidates, true);
  const auto list_times = [&](const char* heading,
                              const std::vector<properties::WrongTime>& wrong) {
    for (std::size_t i = 0; i < wrong.size() && i < most_listed; ++i) {
      const auto& [pair, ours, exact] = wrong[i];
      out += fmt::format("  {}: triangles {} and {}{} at t = {}, exact {}\n", heading, pair.a,
                         pair.b, shown.bodies.text(pair), time_text(ours), time_text(exact));
    }
    if (wrong.size() > most_listed)
      out += fmt::format("  ... {} more\n", wrong.size() - most_listed);
  };
  list_times("late", diff.late);
  list_times("early", diff.early);
  return out;
}

// Tells the exact first time beside the detector's: of the built-in detector where it differs, of a
// plug-in wherever there is one.
std::string times_text(const properties::StepDiff& diff, bool is_built_in) {
  if (!diff.first_contact || diff.partial) return "";
  if (!diff.first)
    return is_built_in
               ? ""
               : fmt::format("  exact first time {}\n", time_text(diff.first_contact->time));
  if (is_built_in && !diff.wrong_first_time()) return "";
  const auto& [ours, exact, off] = *diff.first;
  return fmt::format("  first time {}, exact {}{}\n", time_text(ours), time_text(exact),
                     off.late > 0              ? fmt::format(": late by {:.3g}", off.late)
                     : off.early > 0           ? fmt::format(": early by {:.3g}", off.early)
                     : diff.wrong_first_time() ? ": off by less than an ulp"
                                               : "");
}

// "  limit: 0.71 of the step, contact ahead at t = 0.75; contact on the way at t = 0.9".
std::string limit_text(const properties::LimitDiff& limit) {
  std::string out = fmt::format("  limit: {:.9g} of the {}", limit.used,
                                limit.share < 0 ? "way, as positions" : "step");
  out += limit.ahead ? fmt::format(", contact ahead at t = {}", time_text(*limit.ahead))
                     : ", which has no contact";
  if (limit.hit)
    out += fmt::format("; contact on the way at t = {} of it", time_text(limit.hit->time));
  if (limit.is_excused) out += "; less than claimed, as rounding may be why";
  if (!limit.stall.empty()) out += "; stalls, " + limit.stall;
  return out + "\n";
}

// Tells the view sets. A step without views has none, so the reason why takes their place.
std::string sets_text(const detector::StepResult& result) {
  if (result.views != detector::ViewUse::used)
    return fmt::format("no views, {}", name_of(result.views));
  return fmt::format("V+ {}  V- {}  V0 {}  violated {}  dirty {}", result.view_positive,
                     result.view_negative, result.view_zero, result.violated, result.dirty);
}

// Of a mesh at rest, which is asked once, only how long it took.
std::string stages_text(const detector::StepResult& result, std::optional<double> create_ms,
                        bool is_at_rest) {
  if (is_at_rest)
    return fmt::format("  ms:   {}detector {:.1f}",
                       create_ms ? fmt::format("create {:.1f}, ", *create_ms) : "",
                       result.times.total);
  return fmt::format(
      "  sets: {}\n"
      "  work: {} box tests, {} candidate pairs, {} elementary tests, {} closure rounds\n"
      "  ms:   {}view test {:.1f}, start {:.1f}, broad phase {:.1f}, narrow phase {:.1f}, closure "
      "{:.1f}, detector {:.1f}",
      sets_text(result), result.counts.search.box_tests, result.counts.search.candidate_pairs,
      result.counts.narrow.elementary_tests, result.counts.closure_rounds,
      create_ms ? fmt::format("create {:.1f}, ", *create_ms) : "", result.times.view_test,
      result.times.start, result.times.broad_phase, result.times.narrow_phase, result.times.closure,
      result.times.total);
}

}  // namespace

std::string pairs_text(std::size_t count) {
  return fmt::format("{} pair{}", count, count == 1 ? "" : "s");
}

std::string steps_text(std::size_t count, bool is_at_rest, const std::string& title) {
  if (is_at_rest) return title.empty() ? "at rest; " : "";
  return fmt::format("{} step{}; ", count, count == 1 ? "" : "s");
}

std::string met_text(double separation) {
  return separation > 0 ? fmt::format("within {}", separation) : "in contact";
}

std::string left_out_text(const properties::StepTruth& truth) {
  if (truth.left_out.empty()) return "";
  const auto first = std::min_element(truth.left_out.begin(), truth.left_out.end(),
                                      [](const auto& a, const auto& b) { return a.time < b.time; });
  return fmt::format("; {} left out by the contract, the first at t = {}",
                     pairs_text(truth.left_out.size()), time_text(first->time));
}

std::string step_text(std::size_t number, const detector::StepResult& result,
                      const JudgedByOracle* oracle, const ShownWork& shown) {
  const auto* diff = oracle ? &oracle->diff : nullptr;
  const bool has_answer = !diff || diff->has_answer || result.answer == Answer::error;
  std::string out = shown.is_at_rest ? "at rest: " : fmt::format("step {}: ", number);
  out += has_answer ? properties::name_of(result.answer) : "no answer";
  if (result.answer == Answer::collision) {
    if (!shown.is_at_rest) out += fmt::format(" at t = {}", time_text(result.first));
    if (shown.reports_pairs)
      out += fmt::format(", {} {}", pairs_text(result.pairs.size()), met_text(shown.separation));
  }
  if (!diff) {
    out += "; not judged\n";
  } else if (result.answer == Answer::undecided && diff->outcome == Outcome::undecided) {
    out += "\n";
  } else {
    out += fmt::format("; {}\n", verdict_text(*diff));
  }
  if (shown.has_stages) out += stages_text(result, shown.create_ms, shown.is_at_rest);
  if (oracle) {
    out +=
        fmt::format("{} {:.1f}\n  oracle: {}, {} pairs of {} feature candidates{}{}",
                    shown.has_stages ? ", oracle" : "  ms:   oracle", oracle->milliseconds,
                    properties::name_of(oracle->truth.answer()), oracle->truth.pairs.size(),
                    oracle->judgement.feature_candidates,
                    oracle->judgement.complete ? "" : " (stopped)", left_out_text(oracle->truth));
  }
  if (shown.has_stages || oracle) out += "\n";
  if (!diff) return out;
  if (diff->candidates)
    out += fmt::format("  candidates: {} pairs, at least {} needed, {} lost\n",
                       diff->candidates->given, diff->candidates->least,
                       diff->missing_candidates.size());
  if (diff->limit) out += limit_text(*diff->limit);
  out += times_text(*diff, shown.has_stages);
  const bool is_plain = diff->outcome == Outcome::holds || diff->outcome == Outcome::refused;
  if (!is_plain || differs(*diff)) out += diff_text(*diff, shown);
  return out;
}

namespace {

using oracle::Contradiction;
using oracle::ContradictionKind;

const char* name_of(ContradictionKind kind) {
  return properties::word_of(
      {"query", "missing-pair", "static-pair", "static-late", "static-apart"}, kind);
}

bool is_static(const Contradiction& c) {
  return c.kind != ContradictionKind::query && c.kind != ContradictionKind::missing_pair;
}

std::string exact_time_text(const oracle::StaticTime& time) {
  if (const auto* t = std::get_if<double>(&time)) return fmt::format("{}", *t);
  const auto& fraction = std::get<oracle::RationalTime>(time);
  return fmt::format("{}/{}", fraction.numerator, fraction.denominator);
}

std::vector<std::int32_t> vertices_of(const detector::Feature& feature) {
  std::vector<std::int32_t> used;
  for (const auto v : feature.vertices) {
    if (v >= 0) used.push_back(v);
  }
  return used;
}

std::string contradiction_text(const Contradiction& c) {
  const auto verdict = [](bool contact) { return contact ? "contact" : "no contact"; };
  std::string out = fmt::format("  CONTRADICTION ({}):", name_of(c.kind));
  if (c.pair.a >= 0) out += fmt::format(" triangles {} and {}", c.pair.a, c.pair.b);
  if (is_static(c)) {
    out += fmt::format(" at t = {}; oracle: {}, at rest: {}\n", exact_time_text(c.time),
                       verdict(c.judged), verdict(c.second));
  } else {
    out += fmt::format(" {} of vertices", properties::name_of(c.feature.kind));
    for (const auto v : vertices_of(c.feature)) out += fmt::format(" {}", v);
    out += fmt::format("; oracle: {}, referee: {}\n", verdict(c.judged), verdict(c.second));
  }
  return out;
}

}  // namespace

std::string second_opinion_text(const oracle::SecondOpinion& opinion, double milliseconds) {
  std::string out = fmt::format(
      "  second opinion: {} queries ({} contact, {} no contact, {} open), {} static checks, {} "
      "contradictions{}, {:.1f} ms\n",
      opinion.queries, opinion.contact, opinion.no_contact, opinion.open, opinion.static_checks,
      opinion.contradictions.size(), opinion.complete ? "" : " (stopped)", milliseconds);
  constexpr std::size_t most_listed = 10;
  const auto& list = opinion.contradictions;
  for (std::size_t i = 0; i < std::min(list.size(), most_listed); ++i) {
    out += contradiction_text(list[i]);
  }
  if (list.size() > most_listed) out += fmt::format("  ... {} more\n", list.size() - most_listed);
  return out;
}

nlohmann::ordered_json second_opinion_json(const oracle::SecondOpinion& opinion, double share,
                                           double milliseconds) {
  using Json = nlohmann::ordered_json;
  Json contradictions = Json::array();
  for (const Contradiction& c : opinion.contradictions) {
    const bool has_pair = c.pair.a >= 0;
    contradictions.push_back(
        {{"kind", name_of(c.kind)},
         {"triangles", has_pair ? Json::array({c.pair.a, c.pair.b}) : Json()},
         {"feature", is_static(c) ? Json() : Json(properties::name_of(c.feature.kind))},
         {"vertices", vertices_of(c.feature)},
         {"time", is_static(c) ? Json(exact_time_text(c.time)) : Json()},
         {"oracle", c.judged},
         {"second", c.second}});
  }
  return {{"share", share},
          {"complete", opinion.complete},
          {"queries", opinion.queries},
          {"contact", opinion.contact},
          {"no_contact", opinion.no_contact},
          {"open", opinion.open},
          {"static_checks", opinion.static_checks},
          {"contradictions", contradictions},
          {"time_ms", milliseconds}};
}

}  // namespace assay::reports
