#include "reports/steps/step_json.h"

#include <nlohmann/json.hpp>

#include "detector/step_result.h"

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
  Json step = {{"answer", properties::name_of(result.answer)},
               {"first_time", collision ? to_json(result.first) : Json()},
               {"views", name_of(result.views)},
               {"view_positive", result.view_positive},
               {"view_negative", result.view_negative},
               {"view_zero", result.view_zero},
               {"violated", result.violated},
               {"dirty", result.dirty},
               {"free_components", result.counts.free_components},
               {"box_tests", result.counts.search.box_tests},
               {"contour_tests", result.counts.search.contour_tests},
               {"child_counts", result.counts.search.child_counts},
               {"skipped", result.counts.search.skipped},
               {"marking",
                {{"changed", result.counts.marking.changed},
                 {"marked", result.counts.marking.marked},
                 {"cleared", result.counts.marking.cleared}}},
               {"candidate_pairs", result.counts.search.candidate_pairs},
               {"elementary_tests", result.counts.narrow.elementary_tests},
               {"rungs",
                {{"axis", result.counts.narrow.rungs.axis},
                 {"filter", result.counts.narrow.rungs.filter},
                 {"fixed", result.counts.narrow.rungs.fixed},
                 {"unbounded", result.counts.narrow.rungs.unbounded},
                 {"open", result.counts.narrow.rungs.open}}},
               {"view_rungs",
                {{"lanes", result.counts.view.lanes},
                 {"filter", result.counts.view.filter},
                 {"exact", result.counts.view.exact},
                 {"open", result.counts.view.open}}},
               {"closure_rounds", result.counts.closure_rounds},
               {"winding_numbers", result.counts.winding_numbers},
               {"ghosts",
                {{"pairs", result.counts.ghosts.pairs},
                 {"elementary_tests", result.counts.ghosts.elementary_tests},
                 {"near_triangles", result.counts.ghosts.near_triangles}}},
               {"release",
                {{"in_doubt", result.counts.release.in_doubt},
                 {"released", result.counts.release.released},
                 {"pairs", result.counts.release.pairs},
                 {"elementary_tests", result.counts.release.elementary_tests},
                 {"winding_numbers", result.counts.release.winding_numbers}}},
               {"pairs", pairs_json(result.pairs, bodies)},
               {"times_ms",
                {{"view_test", result.times.view_test},
                 {"start", result.times.start},
                 {"ghosts", result.times.ghosts},
                 {"broad_phase", result.times.broad_phase},
                 {"narrow_phase", result.times.narrow_phase},
                 {"closure", result.times.closure},
                 {"total", result.times.total}}}};
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
