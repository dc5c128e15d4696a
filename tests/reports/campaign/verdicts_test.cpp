// Folders with all combinations of gate results, three to the sixth power: `run`, `certify`,
// `verify`, the data of the page, JUnit and Markdown state the same verdict, exit code and reasons.
#include "properties/campaign/gates/findings.h"
#include "reports/campaign/campaign_text.h"
#include "reports/certificate/statement.h"
#include "reports/page/run_json.h"
#include "reports/terminal/words.h"
#include "tests/properties/campaign/good_findings.h"
#include "tests/reports/program.h"

namespace assay::tests {
namespace {

using namespace properties;
using Json = nlohmann::ordered_json;
using States = std::array<GateState, gate_rules.size()>;

// A folder whose stores bring each gate into the state given. What is not to be judged was not
// asked for, be it broken or not.
class GeneratedFolder {
 public:
  GeneratedFolder(std::string folder, const States& states) : folder_(std::move(folder)) {
    std::filesystem::create_directories(folder_);
    request_.plan.name = "tiny";
    request_.plan.laws_every = 0;
    request_.plan.fault_cases = 10;
    request_.plan.fault_seeds = 1;
    request_.plan.policy.self_test_queries = 10;
    request_.plan.policy.speed_limits = {{"exact-over-double", 1.3}};
    // A bound that two trials, half a defect aside, meet; and one that they do not.
    request_.plan.strata = {{"broken", 2, fails(states, Gate::bounds) ? 0.001 : 0.9999},
                            {"closed-generic", 1, 0},
                            {"unclosed-generic", 1, 0}};
    request_.detector.name = "d";
    request_.detector.built_in = true;
    request_.detector.configurations = {{"bvh", {detector::Culling::bvh}}};
    store_trials(states);
    store_checks(states);
    write(campaign_file(folder_), plan_text(request_.plan) + "\n");
  }
  RunFindings issue() const {
    auto findings = value_of(read_findings(folder_));
    const auto statement = value_of(reports::make_statement(findings));
    write(certificate_file(folder_), reports::statement_text(statement));
    EXPECT_TRUE(reports::write_for_ci(statement["predicate"], folder_));
    return findings;
  }

 private:
  static bool fails(const States& states, Gate gate) {
    return states[static_cast<std::size_t>(gate)] == GateState::fails;
  }
  static void write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
  }
  Store open() const { return value_of(Store::open(store_file(folder_), binding())); }

  // A trial less is incomplete; a world with a counterexample breaks a claim.
  void store_trials(const States& states) {
    auto store = open();
    const std::uint64_t trials = fails(states, Gate::complete) ? 1 : 2;
    for (const auto& stratum : request_.plan.strata) {
      for (std::uint64_t i = 0; i < std::min(stratum.cases, trials); ++i) {
        TrialRecord record;
        record.family = stratum.family;
        record.index = i;
        record.id = trial_id(request_.plan, request_.seed, record.family, record.index);
        record.outcomes = "H";
        record.counts.measures.contact_trials = 1;
        store.add(record);
      }
    }
    store.set(to_row(Canary{"c", 3}));
    for (const auto& fault : faults()) {
      if (fault.status != FaultStatus::planted) continue;
      store.set(to_row(test::fault_proof(std::string(fault.name), fault.status, true)));
    }
    if (fails(states, Gate::harness)) store.set(to_row(HarnessProblem{"no <worker>", 0}));
    World world{"square-2", 1, 1, 1, 0, true, std::nullopt};
    if (fails(states, Gate::claims)) world.counterexample = "pairs differ";
    store.set(to_row(world));
    EXPECT_TRUE(store.seal());
  }

  void store_checks(const States& states) {
    auto checks = open();
    checks.set(to_row(JudgedSource{.source = Source::self_test, .input = "line", .cases = 10}));
    JudgedSource row{.input = "curated cases", .configuration = "bvh", .cases = 1, .steps = 1};
    if (fails(states, Gate::corpus)) row.failed = {{"A1", "s", "a & b"}};
    checks.set(to_row(row));
    const double median = fails(states, Gate::speed) ? 1.4 : 1.2;
    checks.set(to_row(SpeedFigure{"exact-over-double", median, 1, 2, {}}));
    VerbRequest asked;
    for (const auto& rule : gate_rules) {
      if (states[static_cast<std::size_t>(rule.gate)] != GateState::not_judged)
        asked.gates.emplace_back(rule.name);
    }
    asked.certificate = asked.gates.size() == gate_rules.size();
    checks.set(to_row(asked));
    checks.set(to_row(Issuance{folder_}));
    EXPECT_TRUE(checks.seal());
  }

  // Read once: digests of programs take their time.
  const std::string& binding() const {
    static std::map<double, std::string> known;
    auto& text = known[request_.plan.strata[0].wanted_bound];
    if (text.empty()) text = binding_of(request_);
    return text;
  }

  std::string folder_;
  CampaignRequest request_;
};

// The verdict that the states come to, by the order of the exit codes alone.
std::pair<std::string, int> expected_of(const States& states) {
  const std::array<std::pair<const char*, int>, gate_rules.size()> failures = {
      {{"unsound-harness", 4},
       {"defect", 1},
       {"defect", 1},
       {"incomplete", 3},
       {"undecided", 3},
       {"undecided", 3}}};
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i] == GateState::fails) return failures[i];
  }
  const auto judged = std::count(states.begin(), states.end(), GateState::holds);
  if (judged == 0) return {"not judged", 0};
  return {judged == static_cast<long>(states.size()) ? "certified" : "holds", 0};
}

// The element of a gate in JUnit's suite of gates.
std::string junit_of(const std::string& junit, const std::string& gate) {
  const auto begin = junit.find("classname=\"assay.gates\" name=\"" + gate + "\"");
  EXPECT_NE(begin, std::string::npos);
  return junit.substr(begin, junit.find("<testcase", begin) - begin);
}

void expect_gate(const Json& gate, const GateResult& result, const std::string& where) {
  EXPECT_EQ(gate["gate"], rule_of(result.gate).name) << where;
  EXPECT_EQ(gate["state"], name_of(result.state)) << where;
  EXPECT_EQ(gate["reasons"], Json(result.reasons)) << where;
  EXPECT_EQ(gate.value("remedy", ""), result.remedy) << where;
}

// `run` asks for four of the gates.
void expect_agreement_of_run(const RunFindings& findings, const States& states,
                             const Judgement& judgement) {
  const auto run = judge(findings, asked_of_a_run());
  bool asks_the_same = true;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const bool is_asked = run.gates[i].state != GateState::not_judged;
    asks_the_same &= is_asked == (states[i] != GateState::not_judged);
    if (!is_asked || states[i] == GateState::not_judged) continue;
    EXPECT_EQ(run.gates[i].state, states[i]);
    EXPECT_EQ(run.gates[i].reasons, judgement.gates[i].reasons);
  }
  if (!asks_the_same) return;
  EXPECT_EQ(run.verdict, judgement.verdict);
  EXPECT_EQ(run.exit_code, judgement.exit_code);
  EXPECT_EQ(reports::verdict_text(findings, run), reports::verdict_text(findings, judgement));
}

void expect_agreement(const RunFindings& findings, const std::string& folder,
                      const States& states) {
  const auto [verdict, code] = expected_of(states);
  const auto judgement = judge(findings);
  for (std::size_t i = 0; i < states.size(); ++i)
    EXPECT_EQ(judgement.gates[i].state, states[i]) << gate_rules[i].name;
  EXPECT_EQ(judgement.verdict, verdict);
  EXPECT_EQ(judgement.exit_code, code);
  expect_agreement_of_run(findings, states, judgement);

  // The certificate, as written and as verified.
  const auto verified = reports::verify_certificate(certificate_file(folder));
  EXPECT_TRUE(verified.differences.empty()) << verified.differences[0];
  const auto& predicate = verified.statement["predicate"];
  EXPECT_EQ(predicate["verdict"], verdict);
  EXPECT_EQ(predicate["exit_code"], code);
  // The page.
  const auto page = reports::run_json(findings, judgement);
  EXPECT_EQ(page["verdict"], verdict);
  const auto junit = read_text(folder + "/junit.xml"), summary = read_text(folder + "/summary.md"),
             terminal = reports::gates_text(judgement);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto& result = judgement.gates[i];
    const std::string name(rule_of(result.gate).name);
    expect_gate(predicate["gates"][i], result, "certificate");
    expect_gate(page["findings"]["gates"][i], result, "page");
    const auto test = junit_of(junit, name);
    EXPECT_EQ(contains(test, "<failure"), result.state == GateState::fails) << test;
    EXPECT_EQ(contains(test, "<skipped"), result.state == GateState::not_judged) << test;
    for (const auto& reason : result.reasons) {
      EXPECT_TRUE(contains(test, reports::xml_escaped(reason))) << test;
      EXPECT_TRUE(contains(terminal, "  " + reason + "\n")) << terminal;
    }
    EXPECT_TRUE(contains(test, result.remedy) || result.state != GateState::fails) << test;
    EXPECT_EQ(result.remedy.empty(), result.state != GateState::fails || name != "complete");
    if (!result.remedy.empty()) {
      EXPECT_TRUE(contains(terminal, "  " + result.remedy + "\n")) << terminal;
      EXPECT_TRUE(contains(summary, "; " + result.remedy + " |")) << summary;
    }
    const auto row = "| " + name + " | " +
                     (result.state == GateState::fails ? "**fails**" : name_of(result.state));
    EXPECT_TRUE(contains(summary, row)) << row << "\n" << summary;
  }
  EXPECT_TRUE(contains(summary, "## Assay: " + verdict + "\n")) << summary;
}

TEST(Verdicts, AllTextsAgreeOverAllCombinationsOfGateResults) {
  const Scratch scratch(folder_in_memory());
  int folders = 1;
  for (std::size_t i = 0; i < gate_rules.size(); ++i) folders *= 3;
  for (int number = 0; number < folders; ++number) {
    SCOPED_TRACE(number);
    States states;
    int rest = number;
    for (auto& state : states) {
      state = static_cast<GateState>(rest % 3);
      rest /= 3;
    }
    const std::string folder = scratch / std::to_string(number);
    expect_agreement(GeneratedFolder(folder, states).issue(), folder, states);
    if (HasFailure()) return;
    // By the program itself, for some of them.
    constexpr int every = 61;
    if (number % every == 0) {
      const auto code = expected_of(states).second;
      EXPECT_EQ(run_assay("verify " + folder + "/certificate.json").exit_code, code);
      const auto page = run_assay("report " + folder + " --out " + folder + "/page.html");
      EXPECT_TRUE(contains(page.out, folder + ": " + expected_of(states).first + "; ")) << page.out;
    }
    std::filesystem::remove_all(folder);
  }
}

}  // namespace
}  // namespace assay::tests
