// `assay list` lists scenes, laws, planted faults and campaigns, and the failures and slow cases
// of a run.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "corpus/problem.h"
#include "corpus/scenes/scenes.h"
#include "properties/campaign/gates/findings.h"
#include "properties/faults/fault.h"
#include "properties/laws/law.h"
#include "reports/campaign/campaign_text.h"
#include "reports/certificate/statement.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

struct ListRequest {
  std::string list;    // one of `lists`; empty: which lists there are
  std::string folder;  // of a run, for lists of a run
};

Expected<int> list_scenes(const std::string&) {
  fmt::print("{:<20} {:>9} {:>7}  {:<6} {:<6} {}\n", "scene", "triangles", "frames", "closed",
             "--mesh", "what it is");
  for (const auto& scene : corpus::scenes()) {
    fmt::print("{:<20} {:>9} {:>7}  {:<6} {:<6} {}\n", scene.name, scene.default_size,
               scene.default_frames, scene.closed ? "yes" : "no", scene.takes_mesh ? "yes" : "no",
               scene.about);
  }
  return exit_holds;
}

Expected<int> list_laws(const std::string&) {
  for (const auto& law : properties::laws()) {
    fmt::print("{:4} {}\n     {}\n", law.number, law.name, law.statement);
  }
  return exit_holds;
}

Expected<int> list_faults(const std::string&) {
  fmt::print("{:44} {:11} {:20} {:>9}  {}\n", "fault", "status", "found by", "vertices", "what");
  for (const auto& fault : properties::faults()) {
    fmt::print("{:44} {:11} {:20} {:>9}  {}{}\n", fault.name, properties::name_of(fault.status),
               fault.law,
               fault.smallest_vertices ? fmt::format("{}", fault.smallest_vertices) : "-",
               fault.about, fault.reason.empty() ? "" : fmt::format(" [{}]", fault.reason));
  }
  return exit_holds;
}

Expected<int> list_campaigns(const std::string&) {
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
  const auto predicate = make_predicate(findings, judge(findings), findings.run.plan, "");
  fmt::print("{}", failures_text(findings, predicate));
  return exit_holds;
}

Expected<int> list_slow(const std::string& folder) {
  BOOST_OUTCOME_TRY(findings, properties::read_findings(folder));
  fmt::print("{}", slow_trials_text(findings));
  return exit_holds;
}

struct List {
  const char* name;
  const char* about;
  bool is_of_a_run;  // a list of a run needs its folder
  Expected<int> (*print)(const std::string& folder);
};
constexpr List lists[] = {
    {"scenes", "kinematic scenes, for `assay scene`", false, list_scenes},
    {"laws", "the theorems that are tested, each in a sentence", false, list_laws},
    {"faults", "the planted faults that a campaign has to find", false, list_faults},
    {"campaigns", "campaigns, for `assay run` and `assay certify`", false, list_campaigns},
    {"failures", "the failures of the run in DIR, each with its replay line", true, list_failures},
    {"slow", "the slowest cases of the run in DIR", true, list_slow}};

void print_lists() {
  for (const auto& list : lists)
    fmt::print("{:16}{}\n", std::string(list.name) + (list.is_of_a_run ? " DIR" : ""), list.about);
}

const List* list_named(const std::string& name) {
  const auto* place = std::find_if(std::begin(lists), std::end(lists),
                                   [&](const List& list) { return list.name == name; });
  return place == std::end(lists) ? nullptr : place;
}

Expected<int> run_list(const ListRequest& request) {
  if (request.list.empty()) {
    print_lists();
    return exit_holds;
  }
  const auto& list = *list_named(request.list);
  if (list.is_of_a_run && request.folder.empty())
    return Problem{fmt::format("list {} needs the folder of a run", list.name)};
  if (!list.is_of_a_run && !request.folder.empty())
    return Problem{fmt::format("list {} takes no folder", list.name)};
  return list.print(request.folder);
}

void add_options(CLI::App& verb, ListRequest& request) {
  const auto names = join(corpus::names_among(lists), ", ");
  add(verb, "LIST", request.list, "Name of a list (if missing, all are described): " + names)
      ->check(one_of(names, list_named));
  add(verb, "DIR", request.folder, "Folder of the run; needed for the lists failures and slow");
}

}  // namespace

VerbAction add_list(CLI::App& app) {
  return make_verb(app, "list", "List scenes, laws, faults, campaigns, failures, or slow cases",
                   add_options, run_list);
}

}  // namespace assay::reports
