// Plans of campaigns, from files and by name, and which plans are refused.
#include "properties/campaign/plan.h"

#include "corpus/json_fields.h"
#include "properties/generators/families.h"
#include "properties/queries/query_families.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

using nlohmann::ordered_json, tests::Scratch;

const char* const whole_plan = R"({"schema": "assay-campaign/1", "name": "tiny-1.a",
  "strata": [{"family": "closed-generic", "cases": 12, "bound": 0.5},
             {"family": "broken", "cases": 5}],
  "seconds": 30, "case_seconds": 2.5, "case_bytes": 5000000000, "laws_every": 3, "law_premises": 4,
  "fault_cases": 7, "fault_seeds": 2, "tetrahedron_seconds": 1.5, "shrink_share": 0.25,
  "search": 900,
  "policy": {"power": 0.5, "self_test_queries": 9, "repeated_triangles": 80,
             "speed_limits": {"exact-over-double": 1.5}}})";

class Plans : public testing::Test {
 protected:
  corpus::Expected<CampaignPlan> read(const std::string& text) const {
    return find_plan(scratch.write("plan.json", text));
  }
  // The plan with one field changed (null: taken away) is refused, in one line that names the file
  // and says why.
  void expect_wrong(const char* pointer, const ordered_json& value, const std::string& why) const {
    auto json = ordered_json::parse(whole_plan);
    json[ordered_json::json_pointer(pointer)] = value;
    SCOPED_TRACE(pointer + value.dump());
    expect_refused(json.dump(), why);
  }
  void expect_refused(const std::string& text, const std::string& why) const {
    const auto plan = read(text);
    ASSERT_FALSE(plan);
    const auto& message = plan.error().message;
    EXPECT_TRUE(says(message, "plan.json"));
    EXPECT_TRUE(says(message, why));
    EXPECT_FALSE(says(message, "\n"));
  }
  Scratch scratch;
};

TEST_F(Plans, SurviveTheirText) {
  auto plans = named_plans();
  plans.push_back(read(whole_plan).value());
  std::set<std::string> texts;
  for (const auto& plan : plans) {
    const std::string text = plan_text(plan);
    const auto again = read(nlohmann::json::parse(text).dump());  // a store sorts the keys
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(plan_text(again.value()), text);
    EXPECT_EQ(again.value().strata.size(), plan.strata.size());
    texts.insert(text);
  }
  EXPECT_EQ(texts.size(), plans.size());
}

TEST_F(Plans, EveryFieldIsReadAndPartOfTheText) {
  const auto plan = read(whole_plan);
  ASSERT_TRUE(plan) << plan.error().message;
  const auto known = ordered_json::parse(plan_text(plan.value()));
  auto stated = ordered_json::parse(whole_plan);
  stated["strata"][1]["bound"] = 0;  // as it is where none is stated
  for (const auto& [key, value] : stated.items())
    EXPECT_EQ(known.value(key, ordered_json()), value);
}

TEST_F(Plans, AWrongFieldIsOneClearLine) {
  expect_wrong("/schema", "assay-campaign/2", "assay-campaign/1 expected");
  expect_wrong("/name", "", "name");
  expect_wrong("/name", "a:b", "name");
  expect_wrong("/name", "../up", "name");
  expect_wrong("/name", "two words", "name");
  expect_wrong("/name", 7, "name: a text expected");
  expect_wrong("/strata", 7, "strata: an array expected");
  expect_wrong("/strata/0", 7, "strata[0]");
  expect_wrong("/strata/0/family", "closed", "strata[0].family: no family of this name");
  expect_wrong("/strata/1/family", "closed-generic", "strata[1].family: this family occurs twice");
  expect_wrong("/strata/0/cases", -1, "strata[0].cases");
  expect_wrong("/strata/0/cases", 1.5, "strata[0].cases: a whole number expected");
  expect_wrong("/strata/0/cases", 1'000'000'001, "strata[0].cases");
  expect_wrong("/strata/0/bound", 1, "strata[0].bound: 0 <= bound < 1");
  expect_wrong("/strata/0/bound", -.1, "strata[0].bound");
  expect_wrong("/strata/0/bounds", .1, "strata[0]: no field 'bounds'");
  expect_wrong("/seconds", 0, "seconds above 0");
  expect_wrong("/seconds", -1, "seconds: a number of at least 0");
  expect_wrong("/seconds", true, "seconds: a number expected");
  expect_wrong("/seconds", "ten", "seconds: a number expected");
  expect_wrong("/second", 10, "no field 'second'");
  expect_wrong("/case_seconds", 0, "case_seconds above 0");
  expect_wrong("/case_bytes", -1, "case_bytes: a whole number of bytes");
  expect_wrong("/case_bytes", 1.5, "case_bytes");
  expect_wrong("/case_bytes", std::uint64_t{1} << 61, "case_bytes");
  expect_wrong("/case_bytes", "4GB", "case_bytes");
  expect_wrong("/shrink_share", 1.5, "shrink_share");
  expect_wrong("/laws_every", -1, "laws_every");
  expect_wrong("/law_premises", "many", "law_premises");
  expect_wrong("/fault_seeds", 0, "fault_cases and fault_seeds");
  expect_wrong("/fault_cases", 0, "fault_cases and fault_seeds");
  expect_wrong("/search", -1, "search");
  expect_wrong("/tetrahedron_seconds", -1, "tetrahedron_seconds");
  expect_wrong("/policy", 1, "policy: an object expected");
  expect_wrong("/policy/power", 0, "policy.power: 0 < power <= 1");
  expect_wrong("/policy/power", 1.01, "policy.power");
  expect_wrong("/policy/powers", 1, "policy: no field 'powers'");
  expect_wrong("/policy/self_test_queries", -1, "policy.self_test_queries");
  expect_wrong("/policy/repeated_triangles", 1e7, "policy.repeated_triangles");
  expect_wrong("/policy/speed_limits", 2, "policy.speed_limits: an object expected");
  expect_wrong("/policy/speed_limits/slow", 2, "policy.speed_limits: no figure 'slow'");
  expect_wrong("/policy/speed_limits/exact-over-double", 0, "speed_limits.exact-over-double");
  expect_refused("{\"schema\": ", "plan.json");
  expect_refused("[]", "an object expected");
  expect_refused("", "empty");
  for (const std::string key : {"schema", "name", "strata", "seconds"}) {
    auto json = ordered_json::parse(whole_plan);
    json.erase(key);
    expect_refused(json.dump(), key == "seconds" ? "seconds above 0" : key + " is missing");
  }
  expect_refused(
      R"({"schema": "assay-campaign/1", "name": "a", "strata": [{"family": "broken", "cases": 0}],
          "seconds": 1})",
      "nothing to do");
}

// A certificate names its campaign. So a file may bear the name of a built-in campaign only if it
// is that campaign, apart from the time that it may take.
TEST_F(Plans, TheNameOfABuiltInOneBelongsToItsPlanAlone) {
  for (const auto& named : named_plans()) {
    auto json = ordered_json::parse(plan_text(named));
    json["seconds"] = 1;
    const auto shorter = read(json.dump());
    ASSERT_TRUE(shorter) << shorter.error().message;
    EXPECT_EQ(shorter.value().name, named.name);
    auto smaller = json;
    smaller["strata"] = {{{"family", "broken"}, {"cases", 1}}};
    auto other = json;
    other["fault_seeds"] = 12345;
    for (const auto& another : {smaller, other})
      expect_refused(another.dump(), "differs from the built-in campaign of the same name");
  }
}

// Without this a run under other limits, or of a plug-in with a query, has no certificate.
TEST_F(Plans, AKeptOneMayDifferFromTheNamedOneByWhatOptionsChange) {
  for (const auto& named : named_plans()) {
    auto limited = named;
    limited.case_seconds = 20;
    limited.case_bytes = 1 << 30;
    limited.seconds = 1;
    const auto of_plugin = without_questions(limited);
    for (auto kept : {named, limited, of_plugin, without_relations(of_plugin),
                      with_queries(of_plugin), query_plan(of_plugin)}) {
      EXPECT_TRUE(read_plan(scratch.write("kept.json", plan_text(kept)))) << named.name;
      ++kept.fault_seeds;
      EXPECT_FALSE(read_plan(scratch.write("kept.json", plan_text(kept)))) << named.name;
    }
  }
}

TEST_F(Plans, NamedOnesListKnownFamiliesOnce) {
  std::set<std::string> names;
  for (const auto& plan : named_plans()) {
    names.insert(plan.name);
    std::set<std::string> families_of_plan;
    for (const auto& [family, cases, bound] : plan.strata) {
      EXPECT_TRUE(find_family(family)) << family;
      EXPECT_TRUE(families_of_plan.insert(family).second) << family;
    }
    EXPECT_LE(plan.strata.size(), 24u);
    EXPECT_LE(with_queries(without_questions(plan)).strata.size(), 24u);
    EXPECT_EQ(plan.seconds == 0, plan.name == "smoke" || plan.name == "quick")
        << "they run to their end";
    EXPECT_FALSE(plan.about.empty());
    EXPECT_EQ(find_plan(plan.name).value().seconds, plan.seconds);
  }
  EXPECT_EQ(names, (std::set<std::string>{"smoke", "quick", "nightly", "release"}));
  EXPECT_TRUE(says(find_plan("no-such-campaign").error().message, "no-such-campaign"));
}

// Large cases are dear, so each plan has few of them, of the sizes that it has the time for. They
// want no bound, and their number shows each of the ten shapes equally often.
TEST_F(Plans, NamedOnesJudgeLargeMeshesUpToTheirTime) {
  const std::map<std::string, std::uint64_t> largest = {
      {"smoke", 0}, {"quick", 10'000}, {"nightly", 100'000}, {"release", 1'000'000}};
  for (const auto& plan : named_plans()) {
    std::uint64_t most = 0;
    for (const auto& stratum : plan.strata) {
      if (!is_size_family(stratum.family)) continue;
      most = std::max(most, find_family(stratum.family)->triangles);
      EXPECT_EQ(stratum.wanted_bound, 0) << plan.name;
      EXPECT_EQ(stratum.cases % 10, 0u) << plan.name;
    }
    EXPECT_EQ(most, largest.at(plan.name)) << plan.name;
  }
}

}  // namespace
}  // namespace assay::properties
