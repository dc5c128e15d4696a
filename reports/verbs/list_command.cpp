// `assay list`: laws, planted faults, campaigns, and the failures of a run.
#include <fmt/format.h>

#include "properties/campaign/gates/findings.h"
#include "properties/faults/fault.h"
#include "properties/laws/law.h"
#include "reports/terminal/complaint.h"
#include "reports/verbs/commands.h"

namespace assay::reports {
namespace {

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

int list_failures(const std::string& folder) {
  const auto findings = properties::read_findings(folder);
  if (!findings) return refuse(findings.error().message);
  std::string told;
  for (const auto& failure : findings.value().failures) {
    if (failure.signature != told)
      fmt::print("{:>8} times  {}\n", findings.value().met_count(failure), failure.signature);
    told = failure.signature;
    fmt::print("    {} ({}): {}\n", failure.id, failure.configuration, failure.what);
  }
  if (told.empty()) fmt::print("no failures\n");
  return exit_holds;
}

}  // namespace

int run_list(const ListRequest& request) {
  const auto& [what, folder] = request;
  if (what == "failures") {
    return folder.empty() ? refuse("list failures needs the folder of a run")
                          : list_failures(folder);
  }
  if (!folder.empty()) return refuse(fmt::format("list {} takes no folder", what));
  if (what == "laws") return list_laws();
  if (what == "faults") return list_faults();
  if (what == "campaigns") return list_campaigns();
  return run_list_scenes();
}

}  // namespace assay::reports
