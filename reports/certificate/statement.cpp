#include "reports/certificate/statement.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "corpus/digest.h"
#include "corpus/files.h"
#include "corpus/json_fields.h"
#include "reports/campaign/campaign_terminal.h"
#include "reports/campaign/campaign_text.h"
#include "reports/terminal/words.h"

namespace assay::reports {

namespace {

using Json = nlohmann::ordered_json;
using properties::RunFindings;

// Returns whether the stores are bound to the plan. The times of the plan do not count.
bool is_plan_of(const RunFindings& findings, const properties::CampaignPlan& plan) {
  auto json = plan;
  json.seconds = json.shrink_share = json.tetrahedron_seconds = 0;
  return plan_text(json) == plan_text(findings.run.plan);
}

// Returns the subject: the library of a plug-in, or the program that holds and runs the built-in
// detector.
Json subject_json(const RunFindings& findings) {
  const auto& run = findings.run;
  Json digest;
  const auto& sha256 = run.detector.built_in ? run.digests.worker : run.digests.plugin;
  digest["sha256"] = sha256 ? Json(*sha256) : Json();
  // The commit is stated for the built-in detector only, because only the owner of a plug-in knows
  // that of the plug-in. Changed files have no commit.
  constexpr std::size_t digits = 40;
  const auto& versions = findings.evidence.versions;
  if (run.detector.built_in && versions && versions->commit && versions->commit->size() == digits)
    digest["gitCommit"] = *versions->commit;
  return Json::array({{{"name", run.detector.name}, {"digest", std::move(digest)}}});
}

void replace_all(std::string& text, const std::string& what, const std::string& by) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
}

// Maps the copy of each store in `out` to the store.
using Copies = std::map<std::filesystem::path, std::filesystem::path>;

// Refuses, before anything is written, runs that cannot be judged together.
Expected<Copies> copies_of(const std::vector<std::string>& folders, const std::string& out) {
  Copies copies;
  std::string binding;
  for (const auto& folder : folders) {
    BOOST_OUTCOME_TRY(stores, properties::stored_runs(folder));
    for (const auto& file : stores) {
      BOOST_OUTCOME_TRY(store, properties::Store::read(file));
      BOOST_OUTCOME_TRY(run, properties::read_binding(store.binding(), file));
      if (binding.empty()) binding = store.binding();
      const auto difference =
          properties::difference_of(binding, store.binding(), properties::Runs::judged_together);
      if (!difference.empty())
        return Problem{fmt::format("{}: this run does not go together with the runs before: {}",
                                   file.string(), difference)};
      const auto [copy, is_new] =
          copies.emplace(properties::copied_store_file(out, run.seed), file);
      if (!is_new)
        return Problem{
            fmt::format("{} and {}: both runs have seed {}, whose trials would count twice",
                        copy->second.string(), file.string(), run.seed)};
    }
  }
  return copies;
}

Expected<properties::RunFindings> copied(const Copies& copies, const std::filesystem::path& out) {
  for (const auto& [copy, store] : copies) {
    BOOST_OUTCOME_TRY(properties::copy_store(store, copy));
  }
  return properties::read_findings(out);
}

}  // namespace

properties::Expected<Json> make_statement(const std::filesystem::path& folder) {
  BOOST_OUTCOME_TRY(findings, properties::read_findings(folder));
  return make_statement(findings);
}

properties::Expected<Json> make_statement(const RunFindings& findings) {
  using properties::Problem;
  const auto file = properties::campaign_file(findings.folder);
  const auto digest = corpus::sha256_of_file(file);
  if (!digest) return Problem{digest.error().message};
  const auto plan = properties::read_plan(file);
  if (!plan) return Problem{plan.error().message};
  if (!is_plan_of(findings, plan.value())) {
    return Problem{"campaign.json is not the campaign of the stores"};
  }
  return Json{
      {"_type", statement_type},
      {"subject", subject_json(findings)},
      {"predicateType", predicate_type},
      {"predicate", make_predicate(findings, judge(findings), plan.value(), digest.value())}};
}

std::string statement_text(const Json& statement) { return corpus::json_text(statement, 1) + "\n"; }

RunPaths::RunPaths(const properties::RunFindings& findings) {
  const auto& issue = findings.evidence.issued;
  const auto folder = issue ? issue->out : findings.folder.string();
  const std::filesystem::path whole = absolute_path(std::filesystem::path(folder) / "");
  if (!folder.empty() && whole != whole.root_path()) folder_ = whole.string();
  for (const auto& path : {findings.library, issue ? issue->detector : "",
                           issue ? issue->own_cases : "", issue ? issue->data : ""}) {
    if (std::filesystem::path(path).is_absolute()) others_.insert({path, absolute_path(path)});
  }
}

std::string RunPaths::relative(const std::string& path) const {
  const std::filesystem::path whole = absolute_path(path);
  if (whole.is_relative() || folder_.empty()) return path;
  const auto from = std::filesystem::path(folder_).parent_path();
  const auto common = std::mismatch(whole.begin(), whole.end(), from.begin(), from.end()).first;
  constexpr std::ptrdiff_t root_alone = 1;
  return std::distance(whole.begin(), common) > root_alone ? whole.lexically_relative(from).string()
                                                           : whole.filename().string();
}

void RunPaths::tell_in(nlohmann::ordered_json& json) const {
  if (json.is_structured()) {
    for (auto& part : json) tell_in(part);
  } else if (json.is_string()) {
    tell_in(json.get_ref<std::string&>());
  }
}

void RunPaths::tell_in(std::string& text) const {
  for (const auto& path : others_) {
    replace_all(text, shell_word(path), shell_word(relative(path)));
    replace_all(text, path, relative(path));
  }
  if (!folder_.empty()) replace_all(text, folder_, "");
}

Expected<int> issue_certificate(const properties::RunFindings& findings,
                                const std::string& campaign_text, const std::string& took) {
  BOOST_OUTCOME_TRY(statement, make_statement(findings));
  const auto& predicate = statement["predicate"];
  if (predicate["digests"]["campaign"] != corpus::sha256_of(campaign_text))
    return Problem{fmt::format("{}: this file was changed during the run",
                               properties::campaign_file(findings.folder).string())};
  const auto certificate = properties::certificate_file(findings.folder).string();
  BOOST_OUTCOME_TRY(write_text_file(certificate, statement_text(statement)));
  BOOST_OUTCOME_TRY(write_for_ci(predicate, findings.folder));
  const auto judgement = judge(findings);
  fmt::print(
      "{}\n{}\nverdict: {}{}; {}\nthe verdict speaks of {}\n{}next: {}\n",
      findings_text(findings, predicate), gates_text(judgement), judgement.verdict, took,
      certificate, judged_text(predicate),
      findings.is_whole() ? "" : "`assay verify DIR... --out DIR` judges it with other shares\n",
      line_to_paste("verify " + shell_word(certificate), PastePlace::this_folder));
  return judgement.exit_code;
}

Expected<int> judge_together(const std::vector<std::string>& folders, const std::string& out) {
  BOOST_OUTCOME_TRY(copies, copies_of(folders, out));
  BOOST_OUTCOME_TRY(campaign, corpus::read_bytes(properties::campaign_file(folders.front())));
  BOOST_OUTCOME_TRY(
      may_keep_run(out, {"campaign.json", "certificate.json", "junit.xml", "summary.md"}));
  std::set<std::filesystem::path> outputs, additions;
  for (const auto& [copy, store] : copies) {
    std::error_code ignored;
    outputs.insert(copy);
    if (!std::filesystem::exists(copy, ignored)) additions.insert(copy);
  }
  BOOST_OUTCOME_TRY(properties::expect_no_other_store(out, outputs));
  auto findings = copied(copies, out);
  if (!findings) {
    std::error_code ignored;
    for (const auto& copy : additions) std::filesystem::remove(copy, ignored);
    return findings.error();
  }
  BOOST_OUTCOME_TRY(write_text_file(properties::campaign_file(out).string(), campaign));
  const auto& all = findings.value();
  // A failure of the corpus is the same in all runs, and so is the name of its file. The first has
  // the smallest mesh.
  std::vector<properties::FailureRecord> failures;
  std::set<std::pair<std::string, std::string>> names;
  for (const auto& failure : all.failures) {
    if (names.emplace(failure.id(), failure.shown_configuration()).second)
      failures.push_back(failure);
  }
  std::string text;
  BOOST_OUTCOME_TRY(write_failures({failures, all.times_met}, out, detector_of(all), text));
  fmt::print("\n{} runs of campaign {}\n{}", copies.size(), all.run.plan.name, text);
  return issue_certificate(all, campaign, "");
}

}  // namespace assay::reports
