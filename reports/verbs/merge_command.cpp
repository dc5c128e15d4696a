// `assay merge` makes one store of the stores of several shards of a campaign.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "properties/campaign/gates/findings.h"
#include "properties/campaign/ledger/merge.h"
#include "properties/campaign/ledger/run_folder.h"
#include "reports/campaign/campaign_options.h"
#include "reports/campaign/campaign_text.h"
#include "reports/campaign/failure_text.h"
#include "reports/terminal/text_file.h"
#include "reports/terminal/words.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

struct MergeRequest {
  std::vector<std::string> folders;
  std::string out;
};

properties::Expected<std::vector<std::filesystem::path>> stores_of(
    const std::vector<std::string>& folders) {
  std::vector<std::filesystem::path> stores;
  for (const auto& folder : folders) {
    BOOST_OUTCOME_TRY(found, properties::stored_shards(folder));
    stores.insert(stores.end(), found.begin(), found.end());
  }
  return stores;
}

// What `certify` takes as this campaign: the name of a built-in one, else OUT/campaign.json.
Expected<std::string> campaign_word(const properties::CampaignPlan& plan, const std::string& out) {
  for (const auto& named : properties::named_plans()) {
    if (properties::plan_text(named) == properties::plan_text(plan)) return plan.name;
  }
  const auto file = properties::campaign_file(out).string();
  BOOST_OUTCOME_TRY(write_text_file(file, properties::plan_text(plan) + "\n"));
  return shell_word(file);
}

Expected<int> run_merge(const MergeRequest& request) {
  BOOST_OUTCOME_TRY(stores, stores_of(request.folders));
  BOOST_OUTCOME_TRY(may_keep_run(request.out, {"campaign.json"}));
  const auto out = properties::merged_file(request.out);
  BOOST_OUTCOME_TRY(properties::merge_stores(stores, out));
  BOOST_OUTCOME_TRY(kept, properties::read_failures(out));
  BOOST_OUTCOME_TRY(findings, properties::read_one_store(out));
  const auto& run = findings.run;
  const auto planned = findings.planned(), trials = findings.tally.trials();
  fmt::print("{} stores of campaign {}, seed {}: {} of {} trials; writes {}\n", stores.size(),
             run.plan.name, run.seed, trials, planned, out.string());
  std::string text;
  const auto written = write_failures(kept, request.out, detector_of(findings), text);
  fmt::print("{}", text);
  if (!written) return written.error();
  const auto judgement = judge(findings, properties::asked_of_a_run(findings));
  fmt::print("\n{}\n{}, so far\n", gates_text(judgement), verdict_text(findings, judgement));
  if (trials < planned) {
    fmt::print("{} trials are absent: merge the shards that hold them too\n", planned - trials);
  } else {
    BOOST_OUTCOME_TRY(campaign, campaign_word(run.plan, request.out));
    fmt::print(
        "next: {}\n",
        line_to_paste(fmt::format("certify --campaign {} --seed {}{} --out {}", campaign, run.seed,
                                  detector_words(detector_of(findings)), shell_word(request.out)),
                      PastedIn::this_folder));
  }
  // This says only that the stores are one now. Whether the detector holds is for certify to say.
  return exit_holds;
}

void add_options(Verb& verb, MergeRequest& request) {
  verb.add("DIR", request.folders, "Folders of `assay run`, or of `assay merge`").required();
  verb.add("--out DIR", request.out, "Folder for merged.sqlite and the failing meshes")
      .required()
      .in(OptionGroup::output);
}

}  // namespace

AddedVerb add_merge(CLI::App& app) {
  return make_verb(app, "merge", "The stores of several shards become one", add_options, run_merge);
}

}  // namespace assay::reports
