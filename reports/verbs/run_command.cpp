// `assay run`: a campaign in one shard, and what it comes to.
#include <fmt/format.h>

#include "properties/campaign/stored/binding.h"
#include "properties/campaign/stored/run_folder.h"
#include "reports/campaign/campaign_terminal.h"
#include "reports/campaign/campaign_text.h"
#include "reports/certificate/statement.h"
#include "reports/certificate/summary.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/shell_word.h"
#include "reports/verbs/commands.h"

namespace assay::reports {
namespace {

constexpr const char* go_on = "; what is stored stays: run the same again to go on";

// junit.xml and summary.md; of a shard of several junit-shard-I-of-N.xml and so on.
std::optional<std::string> write_files(const properties::CampaignRequest& request,
                                       const properties::RunFindings& findings,
                                       const properties::Judgement& judgement) {
  const auto& shard = request.shard;
  const auto part =
      shard.count == 1 ? std::string() : fmt::format("-shard-{}-of-{}", shard.index, shard.count);
  return write_for_ci(make_predicate(findings, judgement, request.plan, ""), findings.folder, part);
}

int conclude(const RunCommandRequest& command, const properties::CampaignRequest& request,
             const properties::RunFindings& findings, double seconds) {
  const auto judgement = judge(findings, properties::asked_of_a_run());
  fmt::print("{}\n{}\n{}, in {:.0f} s\n", findings_text(findings), gates_text(judgement),
             verdict_text(findings, judgement), seconds);
  const bool is_complete = !findings.has_more_to_do();
  if (!findings.failures.empty()) {
    fmt::print("next: assay list failures {}\n", shell_word(command.out));
  } else if (!is_complete) {
    fmt::print("next: run the same again to go on, with --time for another limit\n");
  } else if (judgement.exit_code != exit_holds) {
    fmt::print("next: assay report {} --out {}\n", shell_word(command.out),
               shell_word((findings.folder / "report.html").string()));
  }
  // The exit code may be of a defect as well: who waits for all shards reads this.
  fmt::print("shard {}: {}\n", text_of(request.shard), is_complete ? "complete" : "not complete");
  if (const auto wrong = write_files(request, findings, judgement)) return refuse(*wrong);
  return judgement.exit_code;
}

}  // namespace

int run_campaign(const RunCommandRequest& command) {
  const auto begin = std::chrono::steady_clock::now();
  properties::CampaignRequest request;
  if (const auto wrong =
          ask_for_campaign({command.campaign, command.seed, command.jobs, command.detector,
                            command.out, command.power, command.time_limit},
                           request)) {
    return refuse(*wrong);
  }
  request.shard = command.shard;
  const auto file = properties::store_file(command.out, request.shard);
  auto store = properties::Store::open(file, properties::binding_of(request));
  if (!store) return refuse(store.error().message);
  if (const auto wrong = run_on_terminal(request, store.value(), command.out))
    return refuse(*wrong + go_on);
  const auto findings = properties::read_one_store(file);
  if (!findings) return refuse(findings.error().message + go_on);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  return conclude(command, request, findings.value(), took.count());
}

}  // namespace assay::reports
