#include "reports/certificate/gates.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "reports/certificate/corpus_check.h"
#include "reports/exit_code.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;
using Lines = std::vector<std::string>;

std::uint64_t count(const Json& number) { return number.get<std::uint64_t>(); }
std::string text(const Json& word) { return word.get<std::string>(); }

// Laws are starved only where all that was planned took place.
bool has_all_trials(const Json& p) {
  for (const auto& stratum : p["strata"]) {
    if (stratum["trials"] != stratum["planned"]) return false;
  }
  return true;
}

void check_laws(const Json& p, Lines& lines) {
  if (p["laws"].is_null() || !has_all_trials(p)) return;
  const auto wanted = count(p["laws"]["wanted_premises"]);
  if (wanted == 0) return;
  for (const auto& law : p["laws"]["laws"]) {
    const auto premises = count(law["premises"]), close = count(law["close"]);
    if (premises < wanted) {
      lines.push_back(fmt::format("the premise of {} held {} times, {} are wanted",
                                  text(law["law"]), premises, wanted));
    } else if (4 * close < premises) {
      lines.push_back(fmt::format("{} was close in {} of {} cases, a quarter is wanted",
                                  text(law["law"]), close, premises));
    }
  }
}

void check_power(const Json& p, Lines& lines) {
  const auto& power = p["power"];
  for (const auto& canary : power["canaries"]) {
    if (canary["found_after"].is_null())
      lines.push_back(fmt::format("shard {} did not find its canary", text(canary["shard"])));
  }
  Lines not_found;
  for (const auto& fault : power["faults"]) {
    const bool found = fault["found"].get<bool>();
    if (fault["status"] == "planted" && !found && !fault["time_over"].get<bool>())
      not_found.push_back(fmt::format("planted fault {} was not found", text(fault["fault"])));
    if (fault["status"] == "equivalent" && found)
      lines.push_back(fmt::format("{}, registered as equivalent, was found", text(fault["fault"])));
  }
  const double wanted = p["campaign"]["plan"]["policy"]["power"].get<double>();
  const auto planted = static_cast<double>(count(power["planted"]));
  if (planted - static_cast<double>(not_found.size()) < wanted * planted)
    lines.insert(lines.end(), not_found.begin(), not_found.end());
}

// Every defect of a trial was stored as a failure.
void check_tallies(const Json& p, Lines& lines) {
  std::uint64_t defects = 0, met = 0;
  for (const auto& stratum : p["strata"]) {
    for (const auto& bound : stratum["bounds"]) defects += count(bound["defects"]);
  }
  for (const auto& failure : p["failures"]) {
    if (!text(failure["signature"]).starts_with("law ")) met += count(failure["met"]);
  }
  if (defects != met)
    lines.push_back(fmt::format("{} defects in the trials, {} failures are stored", defects, met));
}

Lines harness(const Json& p) {
  Lines lines;
  for (const auto& problem : p["harness_problems"]) lines.push_back(text(problem));
  check_power(p, lines);
  check_laws(p, lines);
  check_tallies(p, lines);
  if (!p["self_test"].is_null() && count(p["self_test"]["contradictions"]) > 0)
    lines.push_back(fmt::format("the self-test met {} contradictions",
                                count(p["self_test"]["contradictions"])));
  return lines;
}

Lines complete(const Json& p) {
  Lines lines;
  const auto& plan = p["campaign"]["plan"];
  for (const auto& shard : p["campaign"]["missing_shards"])
    lines.push_back(fmt::format("shard {} is absent", text(shard)));
  for (const auto& stratum : p["strata"]) {
    if (stratum["trials"] != stratum["planned"])
      lines.push_back(fmt::format("{}: {} of {} trials", text(stratum["family"]),
                                  count(stratum["trials"]), count(stratum["planned"])));
  }
  if (p["power"]["canaries"].empty()) lines.push_back("no canary was met");
  if (count(plan["fault_cases"]) > 0) {
    const auto& planted = p["campaign"]["planted_faults"];
    if (planted.is_null()) {
      lines.push_back("how many faults are planted was not stored");
    } else if (p["power"]["planted"] != planted) {
      lines.push_back(fmt::format("{} of {} planted faults were tried",
                                  count(p["power"]["planted"]), count(planted)));
    }
    for (const auto& fault : p["power"]["faults"]) {
      if (fault["status"] == "planted" && !fault["found"].get<bool>() &&
          fault["time_over"].get<bool>())
        lines.push_back(fmt::format("the time was over before {} was found", text(fault["fault"])));
    }
  }
  if (p["corpus"].is_null()) lines.push_back("the corpus was not run");
  const bool wants_self_test = count(plan["policy"]["self_test_queries"]) > 0;
  if (wants_self_test && (p["self_test"].is_null() || !p["self_test"]["complete"].get<bool>()))
    lines.push_back("the self-test was not run to its end");
  return lines;
}

Lines corpus(const Json& p) {
  Lines lines;
  for (const auto& row : p["corpus"]) {
    for (const auto& failed : row["failed"]) {
      if (!failed["waived"].get<bool>())
        lines.push_back(fmt::format("{} ({}): {}", text(failed["case"]), text(row["configuration"]),
                                    text(failed["what"])));
    }
  }
  for (const auto& waiver : p["waivers"]) {
    if (waiver["expired"].get<bool>())
      lines.push_back(fmt::format("the waiver of \"{}\" expired on {}", text(waiver["signature"]),
                                  text(waiver["expires"])));
  }
  return lines;
}

Lines claims(const Json& p) {
  Lines lines;
  for (const auto& failure : p["failures"]) {
    // What the corpus alone shows is that gate's.
    if (!failure["waived"].get<bool>() && !text(failure["case"]).starts_with(corpus_id))
      lines.push_back(fmt::format("{} ({}), met {} times; {}", text(failure["signature"]),
                                  text(failure["configuration"]), count(failure["met"]),
                                  text(failure["replay"])));
  }
  for (const auto& world : p["power"]["worlds"]) {
    if (!world["counterexample"].is_null())
      lines.push_back(fmt::format("{}: {}", text(world["world"]), text(world["counterexample"])));
  }
  return lines;
}

Lines bounds(const Json& p) {
  Lines lines;
  for (const auto& stratum : p["strata"]) {
    for (const auto& bound : stratum["bounds"]) {
      const std::string where =
          fmt::format("{}, {}", text(stratum["family"]), text(bound["configuration"]));
      const auto open = count(bound["undecided"]) + count(bound["errors"]);
      if (stratum["wanted_bound"].is_null()) {
        if (open > 0) lines.push_back(fmt::format("{}: {} without a verdict", where, open));
      } else if (bound["bound"].get<double>() > stratum["wanted_bound"].get<double>()) {
        lines.push_back(fmt::format("{}: bound {:.2e}, {:.0e} is wanted", where,
                                    bound["bound"].get<double>(),
                                    stratum["wanted_bound"].get<double>()));
      }
    }
  }
  return lines;
}

// The figures themselves stand among the times: these lines are the same from run to run.
Lines speed(const Json& p) {
  Lines lines;
  if (!p["detector"]["built_in"].get<bool>()) return lines;
  for (const auto& [what, limit] : p["campaign"]["plan"]["policy"]["speed_limits"].items()) {
    bool measured = false;
    for (const auto& row : p["times"]["speed"]) {
      if (row["what"] != what) continue;
      measured = true;
      if (row["median"].get<double>() > limit.get<double>())
        lines.push_back(fmt::format("{} is above its limit of {}", what, limit.get<double>()));
    }
    if (!measured) lines.push_back(fmt::format("{} was not measured", what));
  }
  return lines;
}

struct Rule {
  const char* gate;
  Lines (*reasons)(const Json&);
  const char* verdict;
  int exit_code;
};

constexpr Rule rules[] = {
    {"harness", harness, "unsound-harness", exit_unsound},
    {"complete", complete, "incomplete", exit_undecided},
    {"corpus", corpus, "defect", exit_defect},
    {"claims", claims, "defect", exit_defect},
    {"bounds", bounds, "undecided", exit_undecided},
    {"speed", speed, "undecided", exit_undecided},
};

}  // namespace

Json gates_of(const Json& predicate) {
  Json list = Json::array();
  for (const auto& rule : rules) {
    const Lines reasons = rule.reasons(predicate);
    list.push_back({{"gate", rule.gate},
                    {"holds", reasons.empty()},
                    {"verdict", rule.verdict},
                    {"exit_code", rule.exit_code},
                    {"reasons", reasons}});
  }
  return list;
}

Json verdict_of(const Json& gates) {
  for (const auto& gate : gates) {
    if (!gate["holds"].get<bool>())
      return {{"verdict", gate["verdict"]},
              {"exit_code", gate["exit_code"]},
              {"failed_gate", gate["gate"]}};
  }
  return {{"verdict", "certified"}, {"exit_code", int{exit_holds}}, {"failed_gate", nullptr}};
}

}  // namespace assay::reports
