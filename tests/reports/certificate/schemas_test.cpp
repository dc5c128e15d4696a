// The JSON Schemas of what the program reads and writes. The file tests/reports/program.h holds to
// them what tests let the program write with --json. Here are the others, and what all share.
#include "properties/campaign/plan.h"
#include "tests/reports/program.h"

namespace assay::tests {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> json_files(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& file : fs::directory_iterator(ASSAY_SOURCE_DIR + ("/" + folder))) {
    if (file.path().extension() == ".json") files.push_back(file.path());
  }
  std::sort(files.begin(), files.end());
  EXPECT_FALSE(files.empty()) << folder;
  return files;
}

SchemaJson parsed(const fs::path& file) { return SchemaJson::parse(read_text(file.string())); }

// The lines that a schema has for a value.
std::vector<std::string> wrong_in(const std::string& name, const SchemaJson& value) {
  const auto schema = schema_named(name);
  std::vector<std::string> wrong;
  check_schema(schema, schema, value, "", wrong);
  return wrong;
}

// All values of the key, wherever it stands.
void values_of(const SchemaJson& json, const std::string& key, std::vector<SchemaJson>& values) {
  if (json.is_object() && json.contains(key)) values.push_back(json[key]);
  for (const auto& part : json) {
    if (part.is_structured()) values_of(part, key, values);
  }
}

TEST(Schemas, EachNamesItsFormatAndNothingThatIsNotThere) {
  for (const auto& file : json_files("reports/schemas")) {
    SCOPED_TRACE(file);
    const auto schema = parsed(file);
    const auto name = file.stem().stem().string();
    const std::string id = schema["$id"];
    EXPECT_EQ(id.rfind("urn:assay:" + name + ":", 0), 0u) << id;
    const auto number = id.substr(id.rfind(':') + 1);
    EXPECT_NE(read_text(file.string()).find("{\"const\": \"assay-" + name + "/" + number + "\"}"),
              std::string::npos);
    std::vector<SchemaJson> references;
    values_of(schema, "$ref", references);
    for (const std::string reference : references) {
      const auto hash = reference.find('#');
      const auto other = hash == 0 ? schema : schema_named("certificate");
      EXPECT_TRUE(hash == 0 || other["$id"] == reference.substr(0, hash)) << reference;
      EXPECT_TRUE(other.contains(SchemaJson::json_pointer(reference.substr(hash + 1))))
          << reference;
    }
  }
}

TEST(Schemas, TheShippedCasesAreOfTheirs) {
  for (const auto& file : json_files("corpus/curated")) {
    SCOPED_TRACE(file);
    expect_schema("case", parsed(file));
  }
  expect_schema("known", parsed(ASSAY_SOURCE_DIR "/corpus/known.json"));
  expect_schema("known", SchemaJson::parse(R"({"schema": "assay-known/1", "waivers": [
      {"signature": "a", "reason": "b", "link": "c", "expires": "2026-12-31"}]})"));
}

TEST(Schemas, CampaignsAreOfTheirs) {
  for (const auto& file : json_files("properties/campaigns"))
    expect_schema("campaign", parsed(file));
  for (const auto& plan : properties::named_plans())
    expect_schema("campaign", SchemaJson::parse(properties::plan_text(plan)));
}

TEST(Schemas, RefuseWhatIsNotOfThem) {
  auto c = parsed(curated("A4_endpoints_only"));
  EXPECT_TRUE(wrong_in("case", c).empty());
  auto other = c;
  other["schema"] = "assay-case/2";
  EXPECT_FALSE(wrong_in("case", other).empty());
  other = c;
  other["frames"][0][0].push_back(1.0);
  EXPECT_FALSE(wrong_in("case", other).empty());
  other = c;
  other.erase("triangles");
  EXPECT_FALSE(wrong_in("case", other).empty());

  const Scratch scratch;
  const auto file = scratch / "check.json";
  ASSERT_EQ(run_assay("check " + curated("A4_endpoints_only") + " --json " + file).exit_code, 0);
  auto report = parsed(file);
  EXPECT_TRUE(wrong_in("check", report).empty());
  report["steps"][0]["box_tests"] = -1;
  EXPECT_FALSE(wrong_in("check", report).empty());
  report = parsed(file);
  report["steps"][0]["more"] = 1;
  EXPECT_FALSE(wrong_in("check", report).empty());
  report = parsed(file);
  report.erase("outcome");
  EXPECT_FALSE(wrong_in("check", report).empty());
}

}  // namespace
}  // namespace assay::tests
