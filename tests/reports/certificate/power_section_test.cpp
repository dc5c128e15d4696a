// What a certificate says of planted faults, from the evidence of several shards.
#include <gtest/gtest.h>

#include "reports/certificate/sections.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

properties::Evidence fault(const std::string& name, const char* status, bool curated,
                           const Json& needed) {
  const Json facts = {{"law", "L3"},         {"status", status}, {"curated", curated},
                      {"needed", needed},    {"cases", 100},     {"time_over", false},
                      {"known_vertices", 6}, {"shrunk", nullptr}};
  return {"fault", name, "1/2", 4, facts.dump()};
}

TEST(Power, AFaultIsFoundByItsCuratedCaseOrByARandomOne) {
  Findings findings;
  findings.evidence["fault"] = {
      fault("by-curated", "planted", true, {nullptr, nullptr, nullptr}),
      fault("by-random", "planted", false, {7, nullptr, nullptr}),
      fault("hidden", "planted", false, {nullptr, nullptr, nullptr}),
      fault("equivalent", "equivalent", false, {nullptr, nullptr, nullptr})};
  const auto power = power_json(findings);
  EXPECT_EQ(power["planted"], 3);
  EXPECT_EQ(power["found"], 2);
  const std::vector<bool> found = {true, true, false, false};
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_EQ(power["faults"][i]["found"].get<bool>(), found[i]) << power["faults"][i];
}

TEST(Power, TheMedianCountsWhatWasNotFoundAsLast) {
  Findings findings;
  findings.evidence["fault"] = {fault("three", "planted", false, {30, 10, 20}),
                                fault("two-of-three", "planted", false, {nullptr, 10, 20}),
                                fault("one-of-three", "planted", false, {nullptr, 10, nullptr})};
  const auto faults = power_json(findings)["faults"];
  EXPECT_EQ(faults[0]["median_cases"], 20);
  EXPECT_EQ(faults[1]["median_cases"], 20);
  EXPECT_TRUE(faults[2]["median_cases"].is_null());
}

}  // namespace
}  // namespace assay::reports
