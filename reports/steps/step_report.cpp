#include "reports/steps/step_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "properties/fields.h"

namespace assay::detector {

ASSAY_FIELDS(MarkingCounts, changed, marked, cleared)
ASSAY_FIELDS(ContactRungCounts, axis, filter, fixed, unbounded, open)
ASSAY_FIELDS(ViewCounts, lanes, filter, exact, open)
ASSAY_FIELDS(ReleaseCounts, in_doubt, released, pairs, elementary_tests, winding_numbers)
ASSAY_FIELDS(StepTimes, view_test, start, ghosts, broad_phase, narrow_phase, closure, total)
template <class Archive>
void fields(Archive& archive, GhostCounts& counts) {
  archive("pairs", counts.pairs, "elementary_tests", counts.elementary_tests, "near_triangles",
          counts.near_triangles);
}

}  // namespace assay::detector

namespace assay::reports {

using detector::Answer;
using properties::Outcome;
using Json = nlohmann::ordered_json;

std::string time_text(const detector::TimeEnclosure& time) {
  if (time.lo == time.hi) return fmt::format("{}", time.lo);
  const std::string lo = fmt::format("{:.9g}", time.lo), hi = fmt::format("{:.9g}", time.hi);
  return lo == hi ? lo : fmt::format("[{}, {}]", lo, hi);
}

namespace {

// Returns whether detector and oracle differ. If the outcome is `holds`, they differ in ways that
// break no claim.
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

std::string diff_text(const properties::StepDiff& diff, const ShownWork& work) {
  std::string out = fmt::format("  diff: {} missing, {} spurious, {} late, {} early{}{}{}\n",
                                diff.missing.size(), diff.spurious.size(), diff.late.size(),
                                diff.early.size(), diff.wrong_answer() ? ", wrong answer" : "",
                                diff.wrong_first_time() ? ", wrong first time" : "",
                                diff.partial ? " (partial)" : "");
  if (!diff.breaches.empty()) {
    out += "  broken:";
    for (const auto claim : diff.breaches) out += fmt::format(" {}", properties::name_of(claim));
    out += "\n";
  }
  const auto list = [&](const char* heading, const auto& items, bool has_features = true) {
    constexpr std::size_t most_listed = 10;
    for (std::size_t i = 0; i < items.size() && i < most_listed; ++i) {
      const auto& one = items[i];
      out += fmt::format("  {}: triangles {} and {}{} at t = ", heading, one.pair.a, one.pair.b,
                         work.bodies.text(one.pair));
      if constexpr (requires { one.oracle; })
        out += fmt::format("{}, exact {}\n", time_text(one.detector), time_text(one.oracle));
      else
        out +=
            time_text(one.time) +
            (has_features ? fmt::format(" ({})\n", properties::name_of(one.feature.kind)) : "\n");
    }
    if (items.size() > most_listed)
      out += fmt::format("  ... {} more pairs\n", items.size() - most_listed);
  };
  list("missing", diff.missing);
  list("spurious", diff.spurious, work.has_stages);
  list("no candidate", diff.missing_candidates);
  list("late", diff.late);
  list("early", diff.early);
  return out;
}

// Tells the exact first time beside the detector's: for the built-in detector if it differs, for a
// plug-in if there is one.
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

// Returns "limit: 0.71 of the step, contact ahead at t = 0.75; contact at t = 0.9 of the way
// there".
std::string limit_text(const properties::LimitDiff& limit) {
  std::string out = fmt::format("  limit: {:.9g} of the {}", limit.way,
                                limit.share < 0 ? "way of the step, stated as positions" : "step");
  out += limit.ahead ? fmt::format(", contact ahead at t = {}", time_text(*limit.ahead))
                     : ", which has no contact";
  if (limit.hit)
    out += fmt::format("; contact at t = {} of the way there", time_text(limit.hit->time));
  if (limit.is_excused) out += "; this is less than claimed, perhaps because of rounding";
  if (!limit.stall.empty()) out += "; stalls, " + limit.stall;
  return out + "\n";
}

// Tells the view sets. For a step without views, tells the reason in their place.
std::string sets_text(const detector::StepResult& result) {
  if (result.views != detector::ViewUse::used)
    return fmt::format("no views, {}", name_of(result.views));
  return fmt::format("V+ {}  V- {}  V0 {}  violated {}  dirty {}", result.view_positive,
                     result.view_negative, result.view_zero, result.violated, result.dirty);
}

// Returns only the time for a mesh at rest, which is asked once.
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

using oracle::Contradiction;
using oracle::ContradictionKind;

const char* name_of(ContradictionKind kind) {
  return std::array{"query", "missing-pair", "static-pair", "static-late",
                    "static-apart"}[static_cast<std::size_t>(kind)];
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
  std::vector<std::int32_t> vertices;
  for (const auto v : feature.vertices) {
    if (v >= 0) vertices.push_back(v);
  }
  return vertices;
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

// Returns the triangles of a pair, and their names by bodies where there are bodies.
Json named_pair(const detector::TrianglePair& pair, const properties::BodyNames& bodies) {
  Json json = {{"triangles", {pair.a, pair.b}}};
  if (bodies.empty()) return json;
  for (const auto t : {pair.a, pair.b})
    json["bodies"].push_back({{"body", bodies.of(t).body}, {"triangle", bodies.of(t).triangle}});
  return json;
}

Json pairs_json(const std::vector<detector::PairContact>& pairs,
                const properties::BodyNames& bodies) {
  Json out = Json::array();
  for (const auto& contact : pairs) out.push_back(to_json(contact, bodies));
  return out;
}

Json candidates_json(const properties::StepDiff& diff, const properties::BodyNames& bodies) {
  if (!diff.candidates) return nullptr;
  return {{"given", diff.candidates->given_pairs},
          {"least", diff.candidates->least},
          {"missing", pairs_json(diff.missing_candidates, bodies)}};
}

Json limit_json(const properties::StepDiff& diff) {
  if (!diff.limit) return nullptr;
  const auto& limit = *diff.limit;
  return {{"share", limit.share < 0 ? Json() : Json(limit.share)},
          {"used", limit.way},
          {"ahead", limit.ahead ? to_json(*limit.ahead) : Json()},
          {"contact_on_the_way", limit.hit ? to_json(limit.hit->time) : Json()},
          {"cut", limit.is_cut},
          {"stall", limit.stall.empty() ? Json() : Json(limit.stall)}};
}

Json times_json(const std::vector<properties::WrongTime>& times,
                const properties::BodyNames& bodies) {
  Json out = Json::array();
  for (const auto& t : times) {
    out.push_back(named_pair(t.pair, bodies));
    out.back()["detector"] = to_json(t.detector);
    out.back()["oracle"] = to_json(t.oracle);
  }
  return out;
}

Json first_json(const properties::StepDiff& diff) {
  if (!diff.first) return nullptr;
  const auto& [ours, exact, off] = *diff.first;
  return {{"detector", to_json(ours)},
          {"oracle", to_json(exact)},
          {"late_by", off.late},
          {"early_by", off.early}};
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
                      const JudgedByOracle* oracle, const ShownWork& work) {
  const auto* diff = oracle ? &oracle->diff : nullptr;
  const bool has_answer = !diff || diff->has_answer || result.answer == Answer::error;
  std::string out = work.is_at_rest ? "at rest: " : fmt::format("step {}: ", number);
  out += has_answer ? properties::name_of(result.answer) : "no answer";
  if (result.answer == Answer::collision) {
    if (!work.is_at_rest) out += fmt::format(" at t = {}", time_text(result.first));
    if (work.reports_pairs)
      out += fmt::format(", {} {}", pairs_text(result.pairs.size()), met_text(work.separation));
  }
  if (!diff) {
    out += "; not judged\n";
  } else if (result.answer == Answer::undecided && diff->outcome == Outcome::undecided) {
    out += "\n";
  } else {
    out += fmt::format("; {}\n", verdict_text(*diff));
  }
  if (work.has_stages) out += stages_text(result, work.create_ms, work.is_at_rest);
  if (oracle) {
    out +=
        fmt::format("{} {:.1f}\n  oracle: {}, {} of {} feature candidates{}{}",
                    work.has_stages ? ", oracle" : "  ms:   oracle", oracle->milliseconds,
                    properties::name_of(oracle->truth.answer()),
                    pairs_text(oracle->truth.pairs.size()), oracle->judgement.feature_candidates,
                    oracle->judgement.complete ? "" : " (stopped)", left_out_text(oracle->truth));
  }
  if (work.has_stages || oracle) out += "\n";
  if (!diff) return out;
  if (diff->candidates)
    out += fmt::format("  candidates: {} pairs, at least {} needed, {} lost\n",
                       diff->candidates->given_pairs, diff->candidates->least,
                       diff->missing_candidates.size());
  if (diff->limit) out += limit_text(*diff->limit);
  out += times_text(*diff, work.has_stages);
  const bool is_plain = diff->outcome == Outcome::holds || diff->outcome == Outcome::refused;
  if (!is_plain || differs(*diff)) out += diff_text(*diff, work);
  return out;
}

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
  if (list.size() > most_listed)
    out += fmt::format("  ... {} more contradictions\n", list.size() - most_listed);
  return out;
}

Json second_opinion_json(const oracle::SecondOpinion& opinion, double share, double milliseconds) {
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

Json to_json(const detector::TimeEnclosure& time) { return Json::array({time.lo, time.hi}); }

Json to_json(const detector::PairContact& contact, const properties::BodyNames& bodies) {
  Json json = named_pair(contact.pair, bodies);
  json["time"] = to_json(contact.time);
  json["feature"] = properties::name_of(contact.feature.kind);
  json["vertices"] = vertices_of(contact.feature);
  return json;
}

Json to_json(const properties::StepDiff& diff, const properties::BodyNames& bodies) {
  Json claims = Json::array();
  for (const auto claim : diff.breaches) claims.push_back(properties::name_of(claim));
  return {{"outcome", properties::name_of(diff.outcome)},
          {"broken", std::move(claims)},
          {"partial", diff.partial},
          {"wrong_answer", diff.wrong_answer()},
          {"wrong_first_time", diff.wrong_first_time()},
          {"first", first_json(diff)},
          {"missing", pairs_json(diff.missing, bodies)},
          {"excused", pairs_json(diff.excuses, bodies)},
          {"spurious", pairs_json(diff.spurious, bodies)},
          {"late", times_json(diff.late, bodies)},
          {"early", times_json(diff.early, bodies)},
          {"candidates", candidates_json(diff, bodies)},
          {"limit", limit_json(diff)},
          {"left_out", diff.left_out.size()},
          {"left_out_missed", diff.left_out_missed}};
}

Json step_json(const detector::StepResult& result, const JudgedByOracle* oracle,
               const properties::BodyNames& bodies) {
  const bool collision = result.answer == detector::Answer::collision;
  const auto& counts = result.counts;
  const auto json_of = [](const auto& x) { return properties::json_of_fields<Json>(x); };
  Json step = {{"answer", properties::name_of(result.answer)},
               {"first_time", collision ? to_json(result.first) : Json()},
               {"views", name_of(result.views)},
               {"view_positive", result.view_positive},
               {"view_negative", result.view_negative},
               {"view_zero", result.view_zero},
               {"violated", result.violated},
               {"dirty", result.dirty},
               {"free_components", counts.free_components},
               {"box_tests", counts.search.box_tests},
               {"contour_tests", counts.search.contour_tests},
               {"child_counts", counts.search.child_counts},
               {"skipped", counts.search.skipped},
               {"marking", json_of(counts.marking)},
               {"candidate_pairs", counts.search.candidate_pairs},
               {"elementary_tests", counts.narrow.elementary_tests},
               {"rungs", json_of(counts.narrow.rungs)},
               {"view_rungs", json_of(counts.view)},
               {"closure_rounds", counts.closure_rounds},
               {"winding_numbers", counts.winding_numbers},
               {"ghosts", json_of(counts.ghosts)},
               {"release", json_of(counts.release)},
               {"pairs", pairs_json(result.pairs, bodies)},
               {"times_ms", json_of(result.times)}};
  step["second_opinion"] = nullptr;
  if (!oracle) {
    step["oracle"] = nullptr;
    step["diff"] = nullptr;
    return step;
  }
  const auto& [judgement, truth, diff, milliseconds] = *oracle;
  step["oracle"] = {
      {"answer", properties::name_of(truth.answer())},
      {"complete", truth.complete},
      {"first_time", truth.complete && truth.first ? to_json(truth.first->time) : Json()},
      {"pairs", truth.pairs.size()},
      {"feature_candidates", judgement.feature_candidates},
      {"rungs",
       {{"axis", judgement.rungs.axis},
        {"interval", judgement.rungs.interval},
        {"quadratic", judgement.rungs.quadratic}}},
      {"time_ms", milliseconds}};
  step["diff"] = to_json(diff, bodies);
  return step;
}

}  // namespace assay::reports
