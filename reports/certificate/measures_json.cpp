#include "properties/campaign/gates/not_judged.h"
#include "properties/campaign/ledger/step_measures.h"
#include "reports/certificate/sections.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

Json rate_json(const properties::Rate& rate) {
  return {{"of", rate.of},
          {"in", rate.in},
          {"share", rate.share()},
          {"interval", {rate.interval.lo, rate.interval.hi}}};
}

Json times_off_json(const properties::TimesOff& off) {
  return {{"steps", off.steps},
          {"median", off.quantile(0.5)},
          {"p99", off.quantile(0.99)},
          {"worst", off.quantile(1)}};
}

}  // namespace

Json not_judged_json(const properties::RunFindings& findings) {
  Json list = Json::array();
  for (const auto& [claim, reason] : properties::not_judged(findings))
    list.push_back({{"claim", claim}, {"reason", reason}});
  return list;
}

Json judged_up_to_json(const properties::RunFindings& findings) {
  Json list = Json::array();
  for (const auto& [claim, triangles] : properties::judged_sizes(findings))
    list.push_back({{"claim", claim}, {"triangles", triangles}});
  return list;
}

Json measures_json(const properties::StepMeasures& m) {
  return {{"steps", m.errors.answered()},
          {"false_alarms", rate_json(false_alarm_rate(m))},
          {"answered_free", rate_json(miss_rate(m))},
          {"spurious_pairs", m.errors.spurious},
          {"spurious_pairs_a_step", spurious_pairs_a_step(m)},
          {"collisions", m.errors.collisions()},
          {"without_time", m.without_time},
          {"late", times_off_json(m.errors.late)},
          {"early", times_off_json(m.errors.early)},
          {"candidates",
           {{"steps", m.candidate_steps},
            {"given", m.candidates},
            {"least", m.least_candidates},
            {"over_least", candidates_over_least(m)}}},
          {"left_out",
           {{"cases_redrawn", m.redrawn},
            {"steps", m.steps_left_out},
            {"would_be_misses", m.left_out_misses}}}};
}

}  // namespace assay::reports
