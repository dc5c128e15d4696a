// The JSON Schemas of files that the program reads and writes. tests/reports/program.h checks every
// file that a test writes with --json against its schema; the tests here check the other files, and
// what all schemas share.
#include "properties/campaign/gates/gates.h"
#include "properties/campaign/plan.h"
#include "properties/claims/claims.h"
#include "tests/recorded_log.h"
#include "tests/reports/program.h"
#include "tests/reports/stored_run.h"

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
std::vector<std::string> wrong_by(const SchemaJson& schema, const SchemaJson& value) {
  std::vector<std::string> wrong;
  check_schema(schema, schema, value, "", wrong);
  return wrong;
}
std::vector<std::string> wrong_in(const std::string& name, const SchemaJson& value) {
  return wrong_by(schema_named(name), value);
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
    // Other schemas refer to that of certificates, so its number stands in its fields alone.
    const std::string id = schema["$id"], number_of_certificates = "8";
    const bool is_shared = name == "certificate";
    const auto number = is_shared ? number_of_certificates : id.substr(id.rfind(':') + 1);
    EXPECT_EQ(id, "urn:assay:" + name + (is_shared ? "" : ":" + number));
    EXPECT_EQ(is_shared, schema.dump().find("{\"const\":\"urn:assay:certificate:" + number) !=
                             std::string::npos);
    // A log has its number in its first record.
    const auto stated = name == "log" ? "\"const\": " + number
                                      : "{\"const\": \"assay-" + name + "/" + number + "\"}";
    EXPECT_TRUE(says(read_text(file.string()), stated));
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
}

// Typed arrays (RFC 8746) as lists of numbers.
SchemaJson as_lists(const SchemaJson& json) {
  if (json.is_object()) {
    SchemaJson object = SchemaJson::object();
    for (const auto& [key, value] : json.items()) object[key] = as_lists(value);
    return object;
  }
  if (!json.is_binary()) return json;
  const auto& bytes = json.get_binary();
  const auto list = [&]<class T>(T) {
    std::vector<T> numbers(bytes.size() / sizeof(T));
    std::memcpy(numbers.data(), bytes.data(), bytes.size());
    return SchemaJson(numbers);
  };
  constexpr std::uint64_t sint32 = 78, float32 = 85;
  return bytes.subtype() == sint32    ? list(std::int32_t{})
         : bytes.subtype() == float32 ? list(float{})
                                      : list(double{});
}

// The bodies of a log, each behind the head of its record and before its checksum.
std::vector<SchemaJson> records_of(const std::string& file) {
  const auto bytes = read_text(file);
  constexpr std::size_t head = 17, length_at = 9, checksum = 5;
  std::vector<SchemaJson> records;
  for (std::size_t at = 0; at + head < bytes.size();) {
    std::size_t length = 0;
    for (std::size_t i = length_at; i < head; ++i)
      length = length << 8 | static_cast<std::uint8_t>(bytes[at + i]);
    const auto body = bytes.substr(at + head, length);
    records.push_back(
        as_lists(SchemaJson::from_cbor(body, true, true, SchemaJson::cbor_tag_handler_t::store)));
    at += head + length + checksum;
  }
  return records;
}

// The members of the contract stand in the order of their list, each as a number of its kind, and
// nothing else stands beside what the schema names.
void expect_contract(const SchemaJson& begin) {
  std::vector<std::string> listed, others;
#define ASSAY_MEMBER(kind, name, since)                                                  \
  listed.emplace_back(#name);                                                            \
  EXPECT_EQ(begin.at(#name).is_number_integer(), std::string(#kind) != "real") << #name; \
  EXPECT_GE(begin.at(#name), 0) << #name;
  ASSAY_CONTRACT_MEMBERS(ASSAY_MEMBER)
#undef ASSAY_MEMBER
  const auto named = schema_named("log").at("$defs").at("begin").at("properties");
  for (const auto& [key, value] : begin.items()) {
    if (!named.contains(key)) others.push_back(key);
  }
  EXPECT_EQ(others, listed);
}

TEST(Schemas, RecordsOfLogsAreOfTheirs) {
  const Scratch scratch;
  const auto c = one_above_another(0.5, -0.5);
  detector::StepResult met;
  met.answer = detector::Answer::collision;
  met.first = {0.5, 0.5};
  met.pairs.push_back({});
  met.pairs.back().pair = {0, 1};
  met.pairs.back().time = {0.5, 0.5};
  {
    LogWriter log(scratch / "steps.log", c.triangles, c.frames[0]);
    log.step(&c.frames[0], c.frames[1], met);
    log.note("it touches the floor");
    assay_record_step_data data = {};
    data.dx = LogWriter::array(c.frames[0]);
    data.committed = LogWriter::array(c.frames[1]);
    log.step(data);
    log.end();
  }
  assay_recorder recorder;
  const std::int32_t body[] = {0, 0, 0, 1, 1, 1};
  const float places[18] = {};
  assay_counted_pairs counted = {};
  counted.body = body;
  const auto path = scratch / "counted.log";
  const assay_record_settings settings = {path.c_str(), 1, 1};
  const auto description = all_claims_description();
  ASSERT_EQ(assay_record_begin(&recorder, &settings, &description, c.triangles.data(), 2,
                               {places, 1}, 6, &counted),
            ASSAY_OK);
  ASSERT_EQ(assay_record_end(&recorder), ASSAY_OK);
  std::set<std::string> types;
  for (const std::string file : {"steps.log", "counted.log"}) {
    for (const auto& record : records_of(scratch / file)) {
      expect_schema("log", record);
      types.insert(record["type"].get<std::string>());
      if (record["type"] == "begin") {
        EXPECT_EQ(record["triangles"].size(), 6u);
        EXPECT_EQ(record["positions"].size(), 18u);
        expect_contract(record);
        EXPECT_EQ(record.contains("counted"), file == "counted.log");
      }
    }
  }
  EXPECT_EQ(types, (std::set<std::string>{"begin", "step", "note", "end"}));
  EXPECT_FALSE(wrong_in("log", {{"type", "step"}, {"record", 1}}).empty());
  EXPECT_FALSE(wrong_in("log", {{"type", "end"}, {"record", 1}, {"steps", 2}, {"x", 0}}).empty());
}

TEST(Schemas, CampaignsAreOfTheirs) {
  for (const auto& file : json_files("properties/campaigns"))
    expect_schema("campaign", parsed(file));
  for (const auto& plan : properties::named_plans())
    expect_schema("campaign", SchemaJson::parse(properties::plan_text(plan)));
}

TEST(Schemas, RefuseWhatIsNotOfThem) {
  const Scratch scratch;
  const auto file = scratch / "check.json", c = curated("A4_endpoints_only");
  expect_ended("check " + c + " --json " + file, 0);
  const auto refuses = [&](const std::string& name, const auto& change) {
    auto value = parsed(name == "case" ? c : file);
    EXPECT_TRUE(wrong_in(name, value).empty());
    change(value);
    return !wrong_in(name, value).empty();
  };
  EXPECT_TRUE(refuses("case", [](auto& value) { value["schema"] = "assay-case/2"; }));
  EXPECT_TRUE(refuses("case", [](auto& value) { value["frames"][0][0].push_back(1.0); }));
  EXPECT_TRUE(refuses("case", [](auto& value) { value.erase("triangles"); }));
  EXPECT_TRUE(refuses("check", [](auto& value) { value["steps"][0]["box_tests"] = -1; }));
  EXPECT_TRUE(refuses("check", [](auto& value) { value["steps"][0]["more"] = 1; }));
  EXPECT_TRUE(refuses("check", [](auto& value) { value.erase("outcome"); }));
}

// The words that the schema of certificates lists are those of the enums.
TEST(Words, OfTheSchemaAreThoseOfClaimsAndGates) {
  const auto types = schema_named("certificate").at("$defs");
  std::vector<std::string> gates;
  EXPECT_EQ(types.at("claim").at("enum"), SchemaJson(words_of(properties::claims_from_outside)));
  for (const auto& rule : properties::gate_rules) gates.emplace_back(rule.name);
  EXPECT_EQ(types.at("gate").at("enum"), SchemaJson(gates));
}

// The files of a conformance set, and of results, are as the schemas of corpus/vectors say.
TEST(VectorSchemas, AreThoseOfSetsAndResults) {
  const std::string room = ASSAY_SOURCE_DIR "/corpus/vectors", results = room + "/results";
  const std::string mini = ASSAY_SOURCE_DIR "/tests/corpus/vectors/mini_set";
  const auto of_vectors = parsed(room + "/schema/vectors.schema.json");
  const auto of_results = parsed(room + "/schema/results.schema.json");
  int files = 0;
  for (const auto& folder : {mini, room, results}) {
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.path().extension() != ".json") continue;
      SCOPED_TRACE(entry.path());
      ++files;
      auto value = parsed(entry.path());
      EXPECT_EQ(wrong_by(folder == results ? of_results : of_vectors, value),
                std::vector<std::string>());
      value.erase("schema");
      EXPECT_TRUE(folder != mini || !wrong_by(of_vectors, value).empty());
    }
  }
  EXPECT_EQ(files, 6 + 19 + 23);
  auto changed = parsed(results + "/assay_exact.json");
  changed["answers"]["vf-d-0001"]["answer"] = "perhaps";
  EXPECT_FALSE(wrong_by(of_results, changed).empty());
}

}  // namespace
}  // namespace assay::tests
