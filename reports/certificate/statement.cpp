#include "reports/certificate/statement.h"

#include <fmt/format.h>

#include "corpus/digest.h"
#include "reports/certificate/gates.h"
#include "reports/certificate/sections.h"
#include "reports/shell_word.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

// The plan as the stores are bound to it, beside the one in the file: nothing, or one line.
std::optional<std::string> plan_differs(const Findings& findings,
                                        const properties::CampaignPlan& plan) {
  auto bound = plan;
  bound.seconds = bound.shrink_share = bound.tetrahedron_seconds = 0;
  if (Json::parse(plan_text(bound)) == findings.binding["campaign"]) return std::nullopt;
  return "campaign.json is not the campaign of the stores";
}

Json or_null(const Json& object, const char* key) {
  return object.is_null() ? Json(nullptr) : object[key];
}

Json detector_json(const Findings& findings) {
  const auto& detector = findings.binding["detector"];
  return {{"name", detector["name"]},
          {"built_in", detector["built_in"]},
          {"contract", detector["contract"]},
          {"configurations", detector["configurations"]}};
}

// The library of a plug-in; of the built-in detector the program that holds it and runs it.
Json subject_json(const Findings& findings) {
  const auto& binding = findings.binding;
  Json digest;
  const bool built_in = binding["detector"]["built_in"].get<bool>();
  digest["sha256"] = binding["digests"][built_in ? "worker" : "plugin"];
  const Json commit = or_null(findings.facts("subject", "versions"), "commit");
  // Of a plug-in only its owner knows the commit; changed files have none.
  constexpr std::size_t digits = 40;
  if (built_in && commit.is_string() && commit.get<std::string>().size() == digits)
    digest["gitCommit"] = commit;
  return Json::array({{{"name", binding["detector"]["name"]}, {"digest", std::move(digest)}}});
}

Json digests_json(const Findings& findings, const std::string& campaign) {
  const auto& digests = findings.binding["digests"];
  return {{"program", digests["program"]},
          {"worker", digests["worker"]},
          {"plugin", digests["plugin"]},
          {"generator", or_null(findings.facts("digest", "generator"), "sha256")},
          {"corpus", or_null(findings.facts("digest", "corpus"), "sha256")},
          {"waivers", or_null(findings.facts("digest", "waivers"), "sha256")},
          {"campaign", campaign},
          {"rows", findings.rows}};
}

Json replay_json(const Findings& findings) {
  const Json paths = findings.facts("subject", "paths");
  if (paths.is_null()) return Json::array();
  const auto out = paths["out"].get<std::string>();
  const auto folder = std::filesystem::path(out);
  return Json::array(
      {fmt::format("assay certify --campaign {} --seed {}{} --out AGAIN",
                   shell_word(campaign_file(folder).string()),
                   findings.binding["seed"].get<std::uint64_t>(),
                   detector_words(paths["detector"].get<std::string>())),
       fmt::format("assay verify {}", shell_word(certificate_file(folder).string()))});
}

// Which failures of the corpus are waived is known only here.
void mark_waived(Json& corpus, const Json& waivers) {
  for (auto& row : corpus) {
    for (auto& failed : row["failed"]) {
      failed["waived"] = false;
      for (const auto& waiver : waivers) {
        if (waiver["signature"] == failed["signature"] && !waiver["expired"].get<bool>())
          failed["waived"] = true;
      }
    }
  }
}

}  // namespace

std::filesystem::path certificate_file(const std::filesystem::path& out) {
  return out / "certificate.json";
}

std::filesystem::path campaign_file(const std::filesystem::path& out) {
  return out / "campaign.json";
}

Json make_predicate(const Findings& findings, const properties::CampaignPlan& plan,
                    const std::string& campaign_digest) {
  Json problems = Json::array();
  for (const auto& row : findings.of("problem")) problems.push_back(Json::parse(row.facts)["what"]);
  const Json waivers = waivers_json(findings);
  Json corpus = corpus_json(findings);
  mark_waived(corpus, waivers);
  const Json versions = findings.facts("subject", "versions");
  Json predicate = {{"schema", certificate_schema},
                    {"verdict", nullptr},
                    {"exit_code", nullptr},
                    {"failed_gate", nullptr},
                    {"gates", nullptr},
                    {"detector", detector_json(findings)},
                    {"versions", versions},
                    {"campaign",
                     {{"name", plan.name},
                      {"seed", findings.binding["seed"]},
                      {"plan", Json::parse(plan_text(plan))},
                      {"shards", findings.shards},
                      {"missing_shards", findings.missing},
                      {"planted_faults", or_null(findings.facts("subject", "planted"), "faults")}}},
                    {"confidence", confidence_json(findings)},
                    {"strata", strata_json(findings)},
                    {"laws", laws_json(findings)},
                    {"power", power_json(findings)},
                    {"harness_problems", std::move(problems)},
                    {"self_test", self_test_json(findings)},
                    {"corpus", std::move(corpus)},
                    {"failures", failures_json(findings)},
                    {"waivers", waivers},
                    {"replay", replay_json(findings)},
                    {"digests", digests_json(findings, campaign_digest)},
                    {"times", times_json(findings)}};
  predicate["gates"] = gates_of(predicate);
  predicate.update(verdict_of(predicate["gates"]));
  return predicate;
}

std::optional<Json> make_statement(const std::filesystem::path& folder, std::string& problem) {
  const auto digest = corpus::sha256_of_file(campaign_file(folder));
  if (!digest) {
    problem = digest.error().message;
    return std::nullopt;
  }
  const auto plan = properties::find_plan(campaign_file(folder).string());
  if (!plan) {
    problem = plan.error().message;
    return std::nullopt;
  }
  const auto findings = read_findings(folder, problem);
  if (!findings) return std::nullopt;
  if (const auto differs = plan_differs(*findings, plan.value())) {
    problem = *differs;
    return std::nullopt;
  }
  try {
    return Json{{"_type", statement_type},
                {"subject", subject_json(*findings)},
                {"predicateType", predicate_type},
                {"predicate", make_predicate(*findings, plan.value(), digest.value())}};
  } catch (const nlohmann::json::exception& wrong) {
    problem = fmt::format("{}: not what a run stores: {}", folder.string(), wrong.what());
    return std::nullopt;
  }
}

std::string statement_text(const Json& statement) { return statement.dump(1) + "\n"; }

}  // namespace assay::reports
