// The files of a conformance set, and of results, are as the schemas of corpus/vectors say.
#include "tests/reports/json_schema.h"
#include "tests/reports/program.h"

namespace assay::tests {
namespace {

const std::string room = ASSAY_SOURCE_DIR "/corpus/vectors";
const std::string mini = ASSAY_SOURCE_DIR "/tests/corpus/vectors/mini_set";

SchemaJson json_of(const std::string& file) { return SchemaJson::parse(read_text(file)); }

std::vector<std::string> wrong_in(const std::string& schema_file, const SchemaJson& value) {
  const auto schema = json_of(room + "/schema/" + schema_file);
  std::vector<std::string> wrong;
  check_schema(schema, schema, value, "", wrong);
  return wrong;
}

TEST(VectorSchemas, AreThoseOfSetsAndResults) {
  int files = 0;
  for (const auto& folder : {mini, room, room + "/results"}) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() != ".json") continue;
      SCOPED_TRACE(entry.path());
      ++files;
      const auto* schema = folder == room + "/results" ? "results" : "vectors";
      auto value = json_of(entry.path());
      EXPECT_EQ(wrong_in(schema + std::string(".schema.json"), value), std::vector<std::string>());
      value.erase("schema");
      if (folder == mini) {
        EXPECT_NE(wrong_in("vectors.schema.json", value), std::vector<std::string>());
      }
    }
  }
  EXPECT_EQ(files, 6 + 13 + 10);
  auto results = json_of(room + "/results/assay_exact.json");
  results["answers"]["vf-d-0001"]["answer"] = "perhaps";
  EXPECT_FALSE(wrong_in("results.schema.json", results).empty());
}

}  // namespace
}  // namespace assay::tests
