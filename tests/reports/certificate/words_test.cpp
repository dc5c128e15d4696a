// The words that the schema of certificates lists are those of the enums.
#include <nlohmann/json.hpp>

#include "properties/campaign/gates/gates.h"
#include "properties/claims/claims.h"
#include "tests/test.h"

namespace assay::tests {
namespace {

using Words = std::vector<std::string>;

std::string text_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(ASSAY_SOURCE_DIR "/" + file).rdbuf();
  return text.str();
}

Words claims() {
  Words words;
  for (const auto claim : properties::all_claims()) words.emplace_back(name_of(claim));
  return words;
}

TEST(Words, OfTheSchemaAreThoseOfClaimsAndGates) {
  const auto types =
      nlohmann::json::parse(text_of("reports/schemas/certificate.schema.json")).at("$defs");
  EXPECT_EQ(types.at("claim").at("enum"), nlohmann::json(claims()));
  Words gates;
  for (const auto& rule : properties::gate_rules) gates.emplace_back(rule.name);
  EXPECT_EQ(types.at("gate").at("enum"), nlohmann::json(gates));
}

}  // namespace
}  // namespace assay::tests
