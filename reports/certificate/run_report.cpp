#include "reports/certificate/run_report.h"

#include <fmt/format.h>

#include "reports/certificate/gates.h"
#include "reports/certificate/junit.h"
#include "reports/certificate/statement.h"
#include "reports/certificate/summary.h"
#include "reports/failure_text.h"
#include "reports/json_output.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

// What a run is not asked for, and of a shard its own part of the plan.
void ask_for_the_run_alone(Json& predicate, const properties::CampaignRequest& request) {
  predicate["corpus"] = Json::array();
  auto& campaign = predicate["campaign"];
  campaign["missing_shards"] = Json::array();
  campaign["planted_faults"] = predicate["power"]["planted"];
  campaign["plan"]["policy"]["self_test_queries"] = 0;
  campaign["plan"]["policy"]["speed_limits"] = Json::object();
  const auto& shard = request.shard;
  if (shard.count == 1) return;
  for (auto& stratum : predicate["strata"]) {
    const auto cases = stratum["planned"].get<std::uint64_t>();
    stratum["planned"] = (cases + shard.count - shard.index) / shard.count;
    // Wanted of all shards together: of one any bound will do.
    auto& wanted = stratum["wanted_bound"];
    if (!wanted.is_null()) wanted = 1.0;
  }
  if (!predicate["laws"].is_null()) predicate["laws"]["wanted_premises"] = 0;
}

}  // namespace

std::optional<std::string> write_run_report(const properties::CampaignRequest& request,
                                            const std::string& out) {
  std::string problem;
  auto findings = read_one_store(store_file(out, request.shard), problem);
  if (!findings) return problem;
  const Json paths = {{"out", out},
                      {"detector", request.plugin ? request.plugin->string() : std::string()}};
  findings->evidence["subject"].push_back({"subject", "paths", "", 1, paths.dump()});
  Json predicate = make_predicate(*findings, request.plan, "");
  ask_for_the_run_alone(predicate, request);
  predicate["gates"] = gates_of(predicate);
  predicate.update(verdict_of(predicate["gates"]));
  // No certificate was issued.
  if (predicate["verdict"] == "certified") predicate["verdict"] = "holds";
  const auto part = request.shard.count == 1
                        ? std::string()
                        : fmt::format("-shard-{}-of-{}", request.shard.index, request.shard.count);
  const std::filesystem::path folder(out);
  if (auto wrong =
          write_text_file((folder / ("junit" + part + ".xml")).string(), junit_text(predicate)))
    return wrong;
  return write_text_file((folder / ("summary" + part + ".md")).string(), summary_text(predicate));
}

}  // namespace assay::reports
