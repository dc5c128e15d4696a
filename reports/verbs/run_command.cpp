// `assay run` runs a campaign, or a share of one, and tells what it comes to.
#include <fmt/format.h>

#include "corpus/problem.h"
#include "properties/campaign/gates/findings.h"
#include "properties/campaign/ledger/binding.h"
#include "properties/campaign/ledger/run_folder.h"
#include "properties/campaign/phases/phases.h"
#include "reports/campaign/campaign_terminal.h"
#include "reports/campaign/campaign_text.h"
#include "reports/certificate/own_checks.h"
#include "reports/certificate/statement.h"
#include "reports/certificate/summary.h"
#include "reports/terminal/words.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

constexpr const char* go_on = "; what is stored stays: run the same again to go on";

Expected<int> conclude(const properties::CampaignRequest& request,
                       const properties::RunFindings& findings, const std::string& out,
                       double seconds) {
  const auto judgement = judge(findings, properties::asked_of_a_run(findings));
  fmt::print("{}\n{}\n{}, in {:.0f} s\n", findings_text(findings), gates_text(judgement),
             verdict_text(findings, judgement), seconds);
  const bool is_complete = !findings.has_more_to_do();
  if (!findings.evidence.slow.empty())
    fmt::print("slow cases: {}\n",
               line_to_paste("list slow " + shell_word(out), PastedIn::this_folder));
  if (!is_complete && findings.failures.empty()) {
    fmt::print("next: run the same again to go on, with --time for another limit\n");
  } else if (judgement.exit_code != exit_holds) {
    const auto page = (findings.folder / "report.html").string();
    fmt::print("next: {}\n",
               line_to_paste(fmt::format("report {} --out {}", shell_word(out), shell_word(page)),
                             PastedIn::this_folder));
  }
  BOOST_OUTCOME_TRY(write_for_ci(make_predicate(findings, judgement, request.plan, ""),
                                 findings.folder, findings.begun));
  return judgement.exit_code;
}

// Runs the cases of the owner.
Expected<void> run_own_cases(const properties::CampaignRequest& request, properties::Store& store) {
  if (!request.own_cases) return outcome::success();
  std::vector<properties::CorpusRow> rows;
  std::vector<properties::StoredFailure> failures;
  fmt::print("{}", corpus_heading());
  CorpusTable table;
  check_own_cases(
      request,
      [&](const auto& row) {
        table.add(row);
        rows.push_back(row);
      },
      [&](const auto& failure) { failures.push_back(failure); });
  table.end();
  fmt::print("\n");
  return properties::keep_own_cases(store, rows, failures);
}

// Runs what is left, and reads the whole of it.
Expected<properties::RunFindings> run_rest(const properties::CampaignRequest& request,
                                           properties::Store& store, const std::string& out) {
  BOOST_OUTCOME_TRY(run_own_cases(request, store));
  BOOST_OUTCOME_TRY(run_on_terminal(request, store, out));
  return properties::read_findings(out);
}

Expected<int> run_campaign(const CampaignWords& words) {
  // A share is judged together with others (verify), so it has a certificate.
  if (words.shares > 1) return certify(words);
  const auto begin = std::chrono::steady_clock::now();
  const auto& out = words.out;
  BOOST_OUTCOME_TRY(request, ask_for_campaign(words));
  BOOST_OUTCOME_TRY(may_keep_run(out, {"junit.xml", "summary.md"}));
  BOOST_OUTCOME_TRY(properties::expect_no_other_store(out, {properties::store_file(out)}));
  BOOST_OUTCOME_TRY(
      store, properties::Store::open(properties::store_file(out), properties::binding_of(request)));
  const auto findings = run_rest(request, store, out);
  if (!findings) {
    auto problem = findings.error();
    problem.message += go_on;
    return problem;
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  return conclude(request, findings.value(), out, took.count());
}

// The 8 of "1/8"; nothing for other words.
std::optional<std::uint64_t> shares_of(const std::string& word) {
  constexpr std::uint64_t most = 1'000'000;
  if (!word.starts_with("1/")) return std::nullopt;
  const auto shares = whole_number_of<std::uint64_t>(word.substr(2));
  return shares && *shares >= 1 && *shares <= most ? shares : std::nullopt;
}

void add_run_options(Verb& verb, CampaignWords& words) {
  words.campaign = "quick";
  verb.add("--campaign NAME|FILE", words.campaign,
           "smoke, quick, nightly, release, faults, or a campaign file (.json)")
      .shows_default();
  add_campaign_options(verb, words);
  add_choice(verb, "--share 1/N", words.shares, "1/N, with N from 1 to 1000000", shares_of,
             "1/N: do this share of the campaign under a seed of its own, with the checks and the "
             "certificate of `certify`; `verify DIR... --out DIR` judges the shares together");
  verb.add("--out DIR", words.out, "Folder for the store and the failing meshes")
      .required()
      .in(OptionGroup::output);
}

}  // namespace

AddedVerb add_run(CLI::App& app) {
  return make_verb(app, "run",
                   "A campaign of random cases: detector against oracle, laws, planted faults",
                   add_run_options, run_campaign);
}

}  // namespace assay::reports
