// `assay list`: laws, planted faults, campaigns, and the failures of a run.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "properties/campaign/plan.h"
#include "properties/faults/fault.h"
#include "properties/laws/law.h"
#include "reports/commands.h"
#include "reports/complaint.h"
#include "reports/failure_text.h"

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
    fmt::print("{:10} {:>9} {:>9.0f}  {}\n", plan.name, cases, plan.seconds, plan.about);
  }
  return exit_holds;
}

int list_failures(const std::string& folder) {
  std::string missing;
  const auto stores = stored_shards(folder, missing);
  if (!missing.empty()) return refuse(missing);
  properties::Counts met;
  std::vector<properties::StoredFailure> failures;
  try {
    for (const auto& file : stores) {
      std::string problem;
      const auto store = properties::Store::read(file, problem);
      if (!store) return refuse(problem);
      properties::add(met, store->signatures());
      for (auto& failure : store->failures()) failures.push_back(std::move(failure));
    }
  } catch (const properties::StoreProblem& damaged) {
    return refuse(damaged.what());
  }
  for (const auto& [signature, count] : met) {
    fmt::print("{:>8} times  {}\n", count, signature);
    for (const auto& failure : failures) {
      if (failure.signature != signature) continue;
      fmt::print("    {} ({}): {}\n", failure.id, failure.configuration, failure.what);
    }
  }
  if (met.empty()) fmt::print("no failures\n");
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
