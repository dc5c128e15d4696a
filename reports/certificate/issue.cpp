#include "reports/certificate/issue.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "corpus/digest.h"
#include "corpus/files.h"
#include "properties/campaign/ledger/run_folder.h"
#include "reports/campaign/campaign_options.h"
#include "reports/campaign/campaign_text.h"
#include "reports/campaign/failure_text.h"
#include "reports/certificate/statement.h"
#include "reports/certificate/summary.h"
#include "reports/terminal/text_file.h"
#include "reports/terminal/words.h"

namespace assay::reports {

Expected<int> issue_certificate(const properties::RunFindings& findings,
                                const std::string& campaign_text, const std::string& took) {
  BOOST_OUTCOME_TRY(statement, make_statement(findings));
  const auto& predicate = statement["predicate"];
  if (predicate["digests"]["campaign"] != corpus::sha256_of(campaign_text))
    return Problem{fmt::format("{}: was changed while this run was at work",
                               properties::campaign_file(findings.folder).string())};
  const auto certificate = properties::certificate_file(findings.folder).string();
  BOOST_OUTCOME_TRY(write_text_file(certificate, statement_text(statement)));
  BOOST_OUTCOME_TRY(write_for_ci(predicate, findings.folder));
  const auto judgement = judge(findings);
  fmt::print(
      "{}\n{}\nverdict: {}{}; {}\nit speaks of {}\n{}next: {}\n", findings_text(findings),
      gates_text(judgement), judgement.verdict, took, certificate, judged_text(predicate),
      findings.is_whole() ? "" : "verify DIR... --out DIR judges it together with other shares\n",
      line_to_paste("verify " + shell_word(certificate), PastedIn::this_folder));
  return judgement.exit_code;
}

namespace {

// By the copy of each store in `out`, the store.
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
        return Problem{fmt::format("{}: this run and those before cannot be judged together: {}",
                                   file.string(), difference)};
      const auto [copy, is_new] =
          copies.emplace(properties::copied_store_file(out, run.seed), file);
      if (!is_new)
        return Problem{
            fmt::format("{} and {}: both are of seed {}, and its trials would count twice",
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

Expected<int> judge_together(const std::vector<std::string>& folders, const std::string& out) {
  BOOST_OUTCOME_TRY(copies, copies_of(folders, out));
  BOOST_OUTCOME_TRY(campaign, corpus::read_bytes(properties::campaign_file(folders.front())));
  BOOST_OUTCOME_TRY(
      may_keep_run(out, {"campaign.json", "certificate.json", "junit.xml", "summary.md"}));
  std::set<std::filesystem::path> expected, added;
  for (const auto& [copy, store] : copies) {
    std::error_code ignored;
    expected.insert(copy);
    if (!std::filesystem::exists(copy, ignored)) added.insert(copy);
  }
  BOOST_OUTCOME_TRY(properties::expect_no_other_store(out, expected));
  auto findings = copied(copies, out);
  if (!findings) {
    std::error_code ignored;
    for (const auto& copy : added) std::filesystem::remove(copy, ignored);
    return findings.error();
  }
  BOOST_OUTCOME_TRY(write_text_file(properties::campaign_file(out).string(), campaign));
  const auto& found = findings.value();
  // A failure of the corpus is the same in all runs, and so is the name of its file. The first has
  // the smallest mesh.
  std::vector<properties::StoredFailure> failures;
  std::set<std::pair<std::string, std::string>> names;
  for (const auto& failure : found.failures) {
    if (names.emplace(failure.id, failure.configuration).second) failures.push_back(failure);
  }
  std::string text;
  BOOST_OUTCOME_TRY(write_failures({failures, found.times_met}, out, detector_of(found), text));
  fmt::print("\n{} runs of campaign {}\n{}", copies.size(), found.run.plan.name, text);
  return issue_certificate(found, campaign, "");
}

}  // namespace assay::reports
