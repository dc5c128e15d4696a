#include "reports/steps/step_json.h"

#include <nlohmann/json.hpp>

#include "detector/step_result.h"
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

using Json = nlohmann::ordered_json;

Json to_json(const detector::TimeEnclosure& time) { return Json::array({time.lo, time.hi}); }

namespace {

// The triangles of a pair, and their names by bodies where there are bodies.
Json named_pair(const detector::TrianglePair& pair, const properties::BodyNames& bodies) {
  Json json = {{"triangles", {pair.a, pair.b}}};
  if (bodies.empty()) return json;
  for (const auto t : {pair.a, pair.b})
    json["bodies"].push_back({{"body", bodies.of(t).body}, {"triangle", bodies.of(t).triangle}});
  return json;
}

}  // namespace

Json to_json(const detector::PairContact& contact, const properties::BodyNames& bodies) {
  Json vertices = Json::array();
  for (const auto v : contact.feature.vertices) {
    if (v >= 0) vertices.push_back(v);
  }
  Json json = named_pair(contact.pair, bodies);
  json["time"] = to_json(contact.time);
  json["feature"] = properties::name_of(contact.feature.kind);
  json["vertices"] = std::move(vertices);
  return json;
}

namespace {

Json pairs_json(const std::vector<detector::PairContact>& pairs,
                const properties::BodyNames& bodies) {
  Json out = Json::array();
  for (const auto& contact : pairs) out.push_back(to_json(contact, bodies));
  return out;
}

Json candidates_json(const properties::StepDiff& diff, const properties::BodyNames& bodies) {
  if (!diff.candidates) return nullptr;
  return {{"given", diff.candidates->given},
          {"least", diff.candidates->least},
          {"missing", pairs_json(diff.missing_candidates, bodies)}};
}

Json limit_json(const properties::StepDiff& diff) {
  if (!diff.limit) return nullptr;
  const auto& limit = *diff.limit;
  return {{"share", limit.share < 0 ? Json() : Json(limit.share)},
          {"used", limit.used},
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

Json to_json(const properties::StepDiff& diff, const properties::BodyNames& bodies) {
  Json broken = Json::array();
  for (const auto claim : diff.broken) broken.push_back(properties::name_of(claim));
  return {{"outcome", properties::name_of(diff.outcome)},
          {"broken", std::move(broken)},
          {"partial", diff.partial},
          {"wrong_answer", diff.wrong_answer()},
          {"wrong_first_time", diff.wrong_first_time()},
          {"first", first_json(diff)},
          {"missing", pairs_json(diff.missing, bodies)},
          {"excused", pairs_json(diff.excused, bodies)},
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
