// `assay list` lists scenes, laws, planted faults and campaigns, and the failures and slow cases
// of a run.
#include <fmt/format.h>

#include <boost/outcome/try.hpp>

#include "corpus/scenes/scenes.h"
#include "properties/campaign/gates/findings.h"
#include "properties/faults/fault.h"
#include "properties/laws/law.h"
#include "reports/campaign/failure_text.h"
#include "reports/check/detector_choice.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/option_words.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

struct ListRequest {
  std::string list = "scenes";  // scenes, laws, faults, campaigns, failures, slow
  std::string folder;           // the folder of a run, for the last two
};

int list_scenes() {
  fmt::print("{:<20} {:>9} {:>7}  {:<6} {:<6} {}\n", "scene", "triangles", "frames", "closed",
             "--mesh", "what it is");
  for (const auto& scene : corpus::scenes()) {
    fmt::print("{:<20} {:>9} {:>7}  {:<6} {:<6} {}\n", scene.name, scene.default_size,
               scene.default_frames, scene.closed ? "yes" : "no", scene.takes_mesh ? "yes" : "no",
               scene.about);
  }
  return exit_holds;
}

int list_laws() {
  for (const auto& law : properties::laws()) {
    fmt::print("{:4} {}\n     {}\n", law.number, law.name, law.statement);
  }
  return exit_holds;
}

int list_faults() {
  fmt::print("{:44} {:11} {:20} {:>9}  {}\n", "fault", "status", "found by", "vertices", "what");
  for (const auto& fault : properties::faults()) {
    fmt::print("{:44} {:11} {:20} {:>9}  {}{}\n", fault.name, properties::name_of(fault.status),
               fault.law,
               fault.smallest_vertices ? fmt::format("{}", fault.smallest_vertices) : "-",
               fault.about, fault.reason.empty() ? "" : fmt::format(" [{}]", fault.reason));
  }
  return exit_holds;
}

int list_campaigns() {
  fmt::print("{:10} {:>9} {:>9}  {}\n", "campaign", "cases", "seconds", "what it is");
  for (const auto& plan : properties::named_plans()) {
    std::uint64_t cases = 0;
    for (const auto& stratum : plan.strata) cases += stratum.cases;
    fmt::print("{:10} {:>9} {:>9}  {}\n", plan.name, cases,
               plan.seconds > 0 ? fmt::format("{:.0f}", plan.seconds) : "no limit", plan.about);
  }
  return exit_holds;
}

Expected<int> list_failures(const std::string& folder) {
  BOOST_OUTCOME_TRY(findings, properties::read_findings(folder));
  std::string told;
  for (const auto& failure : findings.failures) {
    if (failure.signature != told)
      fmt::print("{:>8} times  {}\n", findings.met_count(failure), failure.signature);
    told = failure.signature;
    fmt::print("    {} ({}): {}\n{}", failure.id, failure.configuration, failure.explanation,
               printed_text(failure.printed));
  }
  if (told.empty()) fmt::print("no failures\n");
  return exit_holds;
}

Expected<int> list_slow(const std::string& folder) {
  BOOST_OUTCOME_TRY(findings, properties::read_findings(folder));
  fmt::print("{}", slow_trials_text(findings));
  return exit_holds;
}

Expected<int> run_list(const ListRequest& request) {
  const auto& [list, folder] = request;
  if (list == "slow" || list == "failures") {
    if (folder.empty()) return Problem{fmt::format("list {} needs the folder of a run", list)};
    return list == "slow" ? list_slow(folder) : list_failures(folder);
  }
  if (!folder.empty()) return Problem{fmt::format("list {} takes no folder", list)};
  if (list == "laws") return list_laws();
  if (list == "faults") return list_faults();
  if (list == "campaigns") return list_campaigns();
  return list_scenes();
}

bool is_list(const std::string& word) {
  return word == "scenes" || word == "laws" || word == "faults" || word == "campaigns" ||
         word == "failures" || word == "slow";
}

void add_options(Verb& verb, ListRequest& request) {
  verb.add("what", request.list, "scenes, laws, faults, campaigns, failures, slow")
      .with(one_of("scenes, laws, faults, campaigns, failures, slow", is_list));
  verb.add("folder", request.folder, "Of a run, for failures and slow");
}

}  // namespace

Action add_list(CLI::App& app) {
  return make_verb(app, "list", "List scenes, laws, faults, campaigns, failures, or slow cases",
                   add_options, run_list);
}

}  // namespace assay::reports
