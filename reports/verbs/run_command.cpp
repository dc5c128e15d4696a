// `assay run` runs one shard of a campaign, and tells what it comes to.
#include <fmt/format.h>

#include "corpus/meant_word.h"
#include "properties/campaign/gates/findings.h"
#include "properties/campaign/ledger/binding.h"
#include "properties/campaign/ledger/run_folder.h"
#include "properties/campaign/phases/phases.h"
#include "reports/campaign/campaign_options.h"
#include "reports/campaign/campaign_terminal.h"
#include "reports/campaign/campaign_text.h"
#include "reports/certificate/own_checks.h"
#include "reports/certificate/statement.h"
#include "reports/certificate/summary.h"
#include "reports/terminal/words.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

struct RunRequest {
  CampaignWords words;
  properties::Shard shard;
};

constexpr const char* go_on = "; what is stored stays: run the same again to go on";

// What stands behind the names of a shard's files: a shard of several writes
// junit-shard-I-of-N.xml and so on.
std::string part_of(const properties::Shard& shard) {
  return shard.count == 1 ? "" : fmt::format("-shard-{}-of-{}", shard.index, shard.count);
}

// Writes junit.xml and summary.md.
Expected<void> write_files(const properties::CampaignRequest& request,
                           const properties::RunFindings& findings,
                           const properties::Judgement& judgement) {
  return write_for_ci(make_predicate(findings, judgement, request.plan, ""), findings.folder,
                      part_of(request.shard), findings.begun);
}

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
  // This line is for whoever waits for all shards, because the exit code may also be that of a
  // defect.
  fmt::print("shard {}: {}\n", text_of(request.shard), is_complete ? "complete" : "not complete");
  BOOST_OUTCOME_TRY(write_files(request, findings, judgement));
  return judgement.exit_code;
}

// Runs the cases of the owner, which go with the first shard.
Expected<void> run_own_cases(const properties::CampaignRequest& request, properties::Store& store) {
  if (!request.own_cases || request.shard.index != 1) return outcome::success();
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

// Runs what is left of the shard, and reads the whole of it.
Expected<properties::RunFindings> run_shard(const properties::CampaignRequest& request,
                                            properties::Store& store, const std::string& out) {
  BOOST_OUTCOME_TRY(run_own_cases(request, store));
  BOOST_OUTCOME_TRY(run_on_terminal(request, store, out));
  return properties::read_one_store(properties::store_file(out, request.shard));
}

Expected<int> run_campaign(const RunRequest& command) {
  const auto begin = std::chrono::steady_clock::now();
  const auto& out = command.words.out;
  BOOST_OUTCOME_TRY(request, ask_for_campaign(command.words));
  request.shard = command.shard;
  const auto part = part_of(request.shard);
  BOOST_OUTCOME_TRY(may_keep_run(out, {"junit" + part + ".xml", "summary" + part + ".md"}));
  BOOST_OUTCOME_TRY(store, properties::Store::open(properties::store_file(out, request.shard),
                                                   properties::binding_of(request)));
  const auto findings = run_shard(request, store, out);
  if (!findings) {
    auto problem = findings.error();
    problem.message += go_on;
    return problem;
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  return conclude(request, findings.value(), out, took.count());
}

void add_options(Verb& verb, RunRequest& request) {
  request.words.campaign = "quick";
  verb.add("--campaign NAME|FILE", request.words.campaign,
           "smoke, quick, nightly, release, faults, or a campaign file (.json)")
      .shows_default();
  add_campaign_options(verb, request.words);
  add_choice(verb, "--shard I/N", request.shard, "I/N with 1 <= I <= N", shard_of,
             "I/N: the part of the cases that this run makes (default 1/1)");
  verb.add("--out DIR", request.words.out, "Folder for the store and the failing meshes")
      .required()
      .in(OptionGroup::output);
}

}  // namespace

AddedVerb add_run(CLI::App& app) {
  return make_verb(app, "run",
                   "A campaign of random cases: detector against oracle, laws, planted faults",
                   add_options, run_campaign);
}

}  // namespace assay::reports
