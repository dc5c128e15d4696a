// The records that detector/plugin/assay_record.h writes into a log, read back record by record.
#include <unistd.h>
#include <zlib.h>

#include <nlohmann/json.hpp>

#include "detector/plugin/assay_record.h"
#include "tests/test.h"

namespace assay::tests {
namespace {

using nlohmann::json;

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::uint64_t big_endian(std::string_view bytes) {
  std::uint64_t value = 0;
  for (const char c : bytes) value = value << 8 | static_cast<unsigned char>(c);
  return value;
}

// The bodies of all records. Each frame has just the bytes that it has to have.
std::vector<json> records_of(const std::string& path) {
  const std::string all = bytes_of(path);
  std::vector<json> out;
  for (std::size_t at = 0; at < all.size();) {
    if (all.substr(at, 9) !=
        "\x83\x44"
        "ASR1\xD8\x18\x5B") {
      ADD_FAILURE() << "no record at " << at << " of " << path;
      break;
    }
    const auto size = big_endian(std::string_view(all).substr(at + 9, 8));
    const std::string body = all.substr(at + 17, size), trailer = all.substr(at + 17 + size, 5);
    const auto sum =
        crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
    EXPECT_EQ(trailer.substr(0, 1), "\x1A");
    EXPECT_EQ(big_endian(trailer.substr(1)), sum) << "record at " << at;
    out.push_back(json::from_cbor(body, true, true, json::cbor_tag_handler_t::store));
    at += 17 + size + 5;
  }
  return out;
}

// The numbers of a typed array, whose tag has to be this one.
template <class T>
std::vector<T> numbers(const json& array, unsigned tag) {
  if (!array.is_binary()) {
    ADD_FAILURE() << "no array: " << array;
    return {};
  }
  const auto& bytes = array.get_binary();
  EXPECT_EQ(bytes.subtype(), tag);
  std::vector<T> out(bytes.size() / sizeof(T));
  if (!out.empty()) std::memcpy(out.data(), bytes.data(), bytes.size());
  return out;
}
std::vector<std::int32_t> int32s(const json& array) { return numbers<std::int32_t>(array, 78); }
std::vector<float> floats(const json& array) { return numbers<float>(array, 85); }
std::vector<double> doubles(const json& array) { return numbers<double>(array, 86); }

// A mesh of two triangles, and a file in a folder of the test's own.
class Recording : public testing::Test {
 protected:
  Recording() {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    description.name = "mine";
    description.version = "1.5";
  }
  ~Recording() override {
    if (recorder.is_begun) assay_record_end(&recorder);
    std::filesystem::remove_all(folder);
  }

  std::int32_t begin(const assay_counted_pairs* counted = nullptr) {
    return assay_record_begin(&recorder, &settings, &description, triangles.data(), 2,
                              {rest.data(), 0}, 4, counted);
  }
  std::string error() const { return assay_record_error(&recorder); }
  // A step to where all coordinates are this number.
  std::vector<double> all(double value) const { return std::vector<double>(12, value); }
  std::int32_t step_to(double value) { return write({}, {all(value).data(), 0}); }
  std::int32_t write(assay_record_array x0, assay_record_array x1) {
    return assay_record_step(&recorder, step(x0, x1));
  }
  const assay_record_step_data* step(assay_record_array x0, assay_record_array x1,
                                     assay_record_array committed = {}) {
    data = {};
    data.x0 = x0;
    data.x1 = x1;
    data.committed = committed;
    return &data;
  }
  // The first step says where it starts.
  void first_step() { ASSERT_EQ(write({rest.data(), 0}, {all(0).data(), 0}), ASSAY_OK); }
  std::vector<json> end() {
    EXPECT_EQ(assay_record_end(&recorder), ASSAY_OK) << error();
    return records_of(path);
  }

  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() /
      ("assay_record_" +
       std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + "_" +
       std::to_string(getpid()));
  const std::string path = folder / "steps.log";
  const std::vector<std::int32_t> triangles = {0, 1, 2, 2, 1, 3};
  const std::vector<double> rest = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.1};
  assay_record_settings settings = {path.c_str(), 1, 0};
  assay_description description = {};
  assay_recorder recorder = {};
  assay_record_step_data data = {};
};

using Record = Recording;

TEST_F(Record, BeginHoldsTheMeshAndTheContract) {
  description.claims = ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_WHOLE;
  description.adjacency = 2, description.coordinates = 1, description.margin = 0.25;
  description.start = 2, description.start_distance = 1e-3;
  description.least_nonzero = 1e-9, description.largest = 1e9;
  description.features = 1, description.time_tolerance = 1e-4, description.reports = 1;
  description.separation = 0.5, description.counts = 1, description.rings = -3;
  description.rest_distance = 0.125, description.limit_gives = 2;
  description.progress = 0.75, description.motion = 1;
  description.capacity_triangles = 7, description.capacity_candidates = std::uint64_t{1} << 40;
  ASSERT_EQ(begin(), ASSAY_OK) << error();
  auto records = end();
  ASSERT_EQ(records.size(), 2u);
  auto& first = records[0];
  EXPECT_EQ(int32s(first["triangles"]), triangles);
  EXPECT_EQ(doubles(first["positions"]), rest);
  first.erase("triangles"), first.erase("positions");
  const auto expected = json::parse(R"({"type": "begin", "log": 1, "record": 0, "name": "mine",
      "version": "1.5", "claims": 4097, "adjacency": 2, "coordinates": 1, "margin": 0.25,
      "start": 2, "start_distance": 1e-3, "least_nonzero": 1e-9, "largest": 1e9, "features": 1,
      "time_tolerance": 1e-4, "reports": 1, "separation": 0.5, "counts": 1, "rings": -3,
      "rest_distance": 0.125, "limit_gives": 2, "progress": 0.75, "motion": 1,
      "capacity_triangles": 7, "capacity_contacts": 0, "capacity_candidates": 1099511627776,
      "vertices": 4})");
  EXPECT_EQ(first, expected);
  EXPECT_TRUE(first["margin"].is_number_float());
  EXPECT_EQ(records[1], (json{{"type", "end"}, {"record", 1}, {"steps", 0}}));
}

TEST_F(Record, BeginSaysWhichPairsCount) {
  const std::int32_t body[] = {0, 0, 0, 0}, apart[] = {0, 0}, pairs[] = {0, 1}, faces[] = {3, 0},
                     edges[] = {0, 1, 2, 3};
  assay_counted_pairs counted = {};
  ASSERT_EQ(begin(&counted), ASSAY_OK);
  EXPECT_EQ(end()[0]["counted"], (json{{"level", 0}, {"rings", 0}, {"rest_distance", 0.0}}));
  counted = {1, body, 1, apart, 2, 0.5, rest.data(), 1, pairs, 1, faces, 1, edges};
  settings.overwrite = 1;
  ASSERT_EQ(begin(&counted), ASSAY_OK);
  auto record = end()[0]["counted"];
  EXPECT_EQ(int32s(record["body"]), std::vector<std::int32_t>(body, body + 4));
  EXPECT_EQ(int32s(record["apart"]), std::vector<std::int32_t>(apart, apart + 2));
  EXPECT_EQ(doubles(record["rest"]), rest);
  EXPECT_EQ(int32s(record["triangle_pairs"]), std::vector<std::int32_t>(pairs, pairs + 2));
  EXPECT_EQ(int32s(record["vertex_faces"]), std::vector<std::int32_t>(faces, faces + 2));
  EXPECT_EQ(int32s(record["edge_pairs"]), std::vector<std::int32_t>(edges, edges + 4));
  EXPECT_EQ(record.size(), 9u);
}

TEST_F(Record, StepHoldsWhatItWasGiven) {
  ASSERT_EQ(begin(), ASSAY_OK);
  const auto x1 = all(1), there = all(0.5);
  const std::int32_t pairs[] = {0, 1};
  const double times[] = {0.25, 0.5};
  const assay_result result = {ASSAY_COLLISION, 0.25, 0.5, 1, pairs, times, "gr\xC3\xBC\xDF"};
  const assay_limit limit = {0.75, there.data()};
  step({rest.data(), 0}, {x1.data(), 0}, {there.data(), 0});
  data.result = &result, data.limit = &limit;
  ASSERT_EQ(assay_record_step(&recorder, &data), ASSAY_OK) << error();
  const auto records = end();
  ASSERT_EQ(records.size(), 3u);
  auto body = records[1];
  EXPECT_EQ(doubles(body["x0"]), rest);
  EXPECT_EQ(doubles(body["x1"]), x1);
  EXPECT_EQ(doubles(body["committed"]), there);
  EXPECT_EQ(int32s(body["pairs"]), (std::vector<std::int32_t>{0, 1}));
  EXPECT_EQ(doubles(body["pair_times"]), (std::vector<double>{0.25, 0.5}));
  EXPECT_EQ(doubles(body["positions"]), there);
  for (const auto* key : {"x0", "x1", "committed", "pairs", "pair_times", "positions"})
    body.erase(key);
  // A lone byte of Latin-1 is no UTF-8.
  EXPECT_EQ(body, json::parse(R"({"type": "step", "record": 1, "step": 0, "answer": 1,
      "first_lo": 0.25, "first_hi": 0.5, "message": "gr\u00FC?", "share": 0.75})"));
}

TEST_F(Record, WhatWasNotSaidIsAbsent) {
  ASSERT_EQ(begin(), ASSAY_OK);
  const auto dx = all(0.5);
  data.x0 = {rest.data(), 0}, data.dx = {dx.data(), 0};
  const assay_limit limit = {-1, nullptr};
  assay_result result = {};
  result.first_hi = 1;  // of a free step it says nothing
  data.limit = &limit;
  ASSERT_EQ(assay_record_step(&recorder, &data), ASSAY_OK);
  data.result = &result;
  ASSERT_EQ(assay_record_step(&recorder, &data), ASSAY_OK);
  auto records = end();
  EXPECT_EQ(doubles(records[1]["dx"]), dx);
  records[1].erase("x0"), records[1].erase("dx");
  EXPECT_EQ(records[1], (json{{"type", "step"}, {"record", 1}, {"step", 0}}));
  records[2].erase("x0"), records[2].erase("dx");
  EXPECT_EQ(records[2], (json{{"type", "step"}, {"record", 2}, {"step", 1}, {"answer", 0}}));
}

TEST_F(Record, FloatsStayFloatsAndNoNumberIsMended) {
  ASSERT_EQ(begin(), ASSAY_OK);
  std::vector<float> x1(12, 0.1f);
  x1[3] = std::numeric_limits<float>::quiet_NaN();
  ASSERT_EQ(assay_record_step(&recorder, step({rest.data(), 0}, {x1.data(), 1})), ASSAY_OK);
  const auto numbers = floats(end()[1]["x1"]);
  ASSERT_EQ(numbers.size(), 12u);
  EXPECT_EQ(std::memcmp(numbers.data(), x1.data(), 48), 0);
}

TEST_F(Record, NotesStandBeforeTheirStep) {
  ASSERT_EQ(begin(), ASSAY_OK);
  first_step();
  ASSERT_EQ(assay_record_note(&recorder, "a restart"), ASSAY_OK);
  const std::string longer(1000, 'x');
  ASSERT_EQ(assay_record_note(&recorder, longer.c_str()), ASSAY_OK);
  const auto records = end();
  EXPECT_EQ(records[2],
            (json{{"type", "note"}, {"record", 2}, {"step", 1}, {"text", "a restart"}}));
  EXPECT_EQ(records[3]["text"], longer);
  EXPECT_EQ(records[4], (json{{"type", "end"}, {"record", 4}, {"steps", 1}}));
}

TEST_F(Record, TextIsAlwaysUtf8) {
  ASSERT_EQ(begin(), ASSAY_OK);
  const std::vector<std::pair<std::string, std::string>> texts = {
      {"\xE2\x82\xAC \xF0\x9F\x98\x80", "\xE2\x82\xAC \xF0\x9F\x98\x80"},
      {"\xC0\x80", "??"},            // longer than it has to be
      {"\xE0\x80\x80", "???"},       // likewise
      {"\xED\xA0\x80", "???"},       // half of a pair of UTF-16
      {"\xF4\x90\x80\x80", "????"},  // behind the last character
      {"\xF5\x80\x80\x80", "????"},  // no first byte
      {"\xE2\x82", "??"},            // cut
      {"a\xE2\x82z", "a??z"}};
  for (const auto& [text, expected] : texts)
    ASSERT_EQ(assay_record_note(&recorder, text.c_str()), ASSAY_OK);
  const auto records = end();
  for (std::size_t i = 0; i < texts.size(); ++i)
    EXPECT_EQ(records[1 + i]["text"], texts[i].second) << i;
}

// Of all lengths near those at which the sum goes another way.
TEST_F(Record, SumsAreThoseOfZlib) {
  ASSERT_EQ(begin(), ASSAY_OK);
  std::mt19937 random(1);
  std::string bytes(300000, 0);
  for (char& c : bytes) c = static_cast<char>(random());
  const auto* p = reinterpret_cast<const unsigned char*>(bytes.data());
  const auto expect_sum = [&](std::size_t from, std::size_t n) {
    recorder.crc = static_cast<std::uint32_t>(random());
    const auto expected = crc32(recorder.crc ^ 0xFFFFFFFFu, p + from, static_cast<uInt>(n));
    assay_record_sum_(&recorder, p + from, n);
    EXPECT_EQ(recorder.crc ^ 0xFFFFFFFFu, expected) << n << " bytes from " << from;
  };
  for (std::size_t n = 0; n < 100; ++n) expect_sum(n % 7, n);
  for (std::size_t base : {2400u, 4800u, 16384u, 18784u, 32768u, 131072u, 290000u})
    for (std::size_t n = base - 20; n < base + 20; ++n) expect_sum(n % 9, n);
}

// Which steps a recorder writes, where they start, to which files they go, and what it refuses.

class RecordFiles : public Recording {
 protected:
  // The numbers of the steps in a file, which is a log by itself: the first one says where it
  // starts, and that is where the step before it ended.
  std::vector<int> steps_in(const std::string& file) {
    const auto records = records_of(file);
    std::vector<int> out;
    for (std::size_t i = 0; i < records.size(); ++i) {
      EXPECT_EQ(records[i]["record"], i);
      EXPECT_EQ(records[i]["type"] == "begin", i == 0);
      if (records[i]["type"] != "step") continue;
      const int number = records[i]["step"];
      const bool follows = !out.empty() && out.back() + 1 == number;
      EXPECT_EQ(records[i].contains("x0"), !follows) << number;
      EXPECT_TRUE(follows || doubles(records[i]["x0"]) == (number ? all(number - 1) : rest));
      EXPECT_EQ(doubles(records[i]["x1"]), all(number));
      out.push_back(number);
    }
    return out;
  }
  void record(int count) {
    if (recorder.next_step == 0) first_step(), --count;
    for (; count > 0; --count)
      ASSERT_EQ(step_to(static_cast<double>(recorder.next_step)), ASSAY_OK) << error();
  }
};

using Numbers = std::vector<int>;

TEST_F(RecordFiles, EveryThirdStepSaysWhereItStarts) {
  settings.every = 3;
  ASSERT_EQ(begin(), ASSAY_OK);
  record(8);
  EXPECT_EQ(end().back()["steps"], 8);
  EXPECT_EQ(steps_in(path), (Numbers{0, 3, 6}));
}

TEST_F(RecordFiles, AStepStartsWhereTheLastOneWasCommitted) {
  settings.every = 2;
  ASSERT_EQ(begin(), ASSAY_OK);
  const std::vector<float> there(12, 0.25f);
  const auto x1 = all(7), dx = all(1);
  record(1);
  ASSERT_EQ(assay_record_step(&recorder, step({}, {x1.data(), 0}, {there.data(), 1})), ASSAY_OK);
  ASSERT_EQ(step_to(8), ASSAY_OK);
  data = {};
  data.dx = {dx.data(), 0}, data.committed = {x1.data(), 0};
  ASSERT_EQ(assay_record_step(&recorder, &data), ASSAY_OK);
  ASSERT_EQ(step_to(9), ASSAY_OK);
  const auto records = end();
  ASSERT_EQ(records.size(), 5u);
  EXPECT_EQ(floats(records[2]["x0"]), there);
  EXPECT_EQ(doubles(records[3]["x0"]), x1);
}

TEST_F(RecordFiles, AStepNeedsAKnownStart) {
  ASSERT_EQ(begin(), ASSAY_OK);
  EXPECT_EQ(step_to(1), ASSAY_RECORD_NO_START) << "the first one";
  const auto dx = all(1);
  data = {};
  data.x0 = {rest.data(), 0}, data.dx = {dx.data(), 0};
  ASSERT_EQ(assay_record_step(&recorder, &data), ASSAY_OK);
  EXPECT_EQ(step_to(1), ASSAY_RECORD_NO_START);
  EXPECT_TRUE(says(error(), "x0 is missing"));
  const auto records = end();
  EXPECT_EQ(records.back()["steps"], 1) << "what was refused does not count";
  EXPECT_EQ(records.size(), 3u);
}

TEST_F(RecordFiles, RefusesWrongSteps) {
  ASSERT_EQ(begin(), ASSAY_OK);
  const auto x = all(1);
  EXPECT_EQ(assay_record_step(&recorder, nullptr), ASSAY_RECORD_WRONG_ARGUMENT);
  EXPECT_EQ(assay_record_step(&recorder, step({x.data(), 0}, {})), ASSAY_RECORD_WRONG_ARGUMENT);
  step({x.data(), 0}, {x.data(), 0});
  data.dx = data.x1;
  EXPECT_EQ(assay_record_step(&recorder, &data), ASSAY_RECORD_WRONG_ARGUMENT);
  data.dx = {};
  assay_result result = {};
  data.result = &result;
  result.answer = 5;
  EXPECT_EQ(assay_record_step(&recorder, &data), ASSAY_RECORD_WRONG_ARGUMENT);
  result.answer = ASSAY_COLLISION, result.pair_count = 1;
  EXPECT_EQ(assay_record_step(&recorder, &data), ASSAY_RECORD_WRONG_ARGUMENT);
  EXPECT_TRUE(says(error(), "pairs"));
  EXPECT_EQ(assay_record_note(&recorder, nullptr), ASSAY_RECORD_WRONG_ARGUMENT);
  EXPECT_EQ(end().size(), 2u);
  EXPECT_EQ(assay_record_step(&recorder, step({x.data(), 0}, {x.data(), 0})),
            ASSAY_RECORD_NOT_BEGUN);
  EXPECT_EQ(assay_record_note(&recorder, "late"), ASSAY_RECORD_NOT_BEGUN);
  EXPECT_EQ(assay_record_end(&recorder), ASSAY_RECORD_NOT_BEGUN);
}

// Its judge would find nothing to judge, after a night perhaps.
TEST_F(RecordFiles, RefusesAnswersThatCanBeNone) {
  ASSERT_EQ(begin(), ASSAY_OK);
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const auto x = all(1);
  const auto code = [&](const assay_result& result, const assay_limit& limit = {-1, nullptr}) {
    step({rest.data(), 0}, {x.data(), 0});
    data.result = &result, data.limit = &limit;
    return assay_record_step(&recorder, &data);
  };
  const auto at = [](double lo, double hi) {
    return assay_result{ASSAY_COLLISION, lo, hi, 0, nullptr, nullptr, nullptr};
  };
  for (const auto& [lo, hi] : std::vector<std::pair<double, double>>{
           {-1, -1}, {2.5, 2.5}, {0, 2}, {-1, 0}, {0.5, 0.25}, {none, none}, {0, none}}) {
    EXPECT_EQ(code(at(lo, hi)), ASSAY_RECORD_NO_ANSWER) << lo << ' ' << hi;
    EXPECT_TRUE(says(error(), "first time"));
  }
  for (const auto& pair : std::vector<std::array<std::int32_t, 2>>{
           {0, 0}, {-1, 0}, {0, 2}, {7, 1}, {0, std::numeric_limits<std::int32_t>::min()}}) {
    for (const auto answer : {ASSAY_COLLISION, ASSAY_UNDECIDED}) {
      EXPECT_EQ(code({answer, 0, 0, 1, pair.data(), nullptr, nullptr}), ASSAY_RECORD_NO_ANSWER)
          << pair[0] << ' ' << pair[1];
      EXPECT_TRUE(says(error(), "does not name two triangles"));
    }
  }
  const std::int32_t pair[] = {1, 0};
  const double late[] = {0, 1.5};
  EXPECT_EQ(code({ASSAY_COLLISION, 0, 0, 1, pair, late, nullptr}), ASSAY_RECORD_NO_ANSWER);
  EXPECT_EQ(code({ASSAY_FREE, 0, 0, 1, pair, nullptr, nullptr}), ASSAY_RECORD_NO_ANSWER);
  auto nowhere = all(1);
  nowhere[7] = none;
  for (const auto& limit : std::vector<assay_limit>{
           {1.5, nullptr}, {-0.5, nullptr}, {none, nullptr}, {0.5, nowhere.data()}})
    EXPECT_EQ(code(at(0, 1), limit), ASSAY_RECORD_NO_ANSWER) << limit.share;
  EXPECT_EQ(code({ASSAY_COLLISION, 1, 1, 1, pair, nullptr, nullptr}), ASSAY_OK) << error();
  EXPECT_EQ(code({ASSAY_ERROR, none, none, 0, nullptr, nullptr, "lost"}), ASSAY_OK) << error();
  EXPECT_EQ(end().size(), 4u) << "what was refused is not there";
}

TEST_F(RecordFiles, RefusesWrongBeginnings) {
  const assay_record_array positions = {rest.data(), 0};
  const auto code = [&](const assay_record_settings* s, const assay_description* d,
                        const std::int32_t* corners, assay_record_array x, std::uint64_t n,
                        const assay_counted_pairs* counted = nullptr) {
    return assay_record_begin(&recorder, s, d, corners, 2, x, n, counted);
  };
  const auto wrong = ASSAY_RECORD_WRONG_ARGUMENT;
  EXPECT_EQ(code(nullptr, &description, triangles.data(), positions, 4), wrong);
  EXPECT_EQ(code(&settings, nullptr, triangles.data(), positions, 4), wrong);
  EXPECT_EQ(code(&settings, &description, nullptr, positions, 4), wrong);
  EXPECT_EQ(code(&settings, &description, triangles.data(), {}, 4), wrong);
  EXPECT_EQ(code(&settings, &description, triangles.data(), positions, 0), wrong);
  EXPECT_EQ(code(&settings, &description, triangles.data(), positions, 3), wrong);
  EXPECT_TRUE(says(error(), "vertex that does not exist"));
  assay_counted_pairs counted = {};
  counted.edge_pair_count = 1;
  EXPECT_EQ(code(&settings, &description, triangles.data(), positions, 4, &counted), wrong);
  settings.overwrite = 7;
  EXPECT_EQ(begin(), wrong);
  settings.overwrite = 0;
  EXPECT_FALSE(std::filesystem::exists(path)) << "nothing was written";
  const std::string nowhere = path + "/nowhere";
  settings.path = nowhere.c_str();
  EXPECT_EQ(begin(), ASSAY_RECORD_NOT_OPENED);
  EXPECT_TRUE(says(error(), "cannot open"));
  settings.path = "";
  EXPECT_EQ(begin(), wrong);
}

TEST_F(RecordFiles, FilesThatAreThereAreRefused) {
  std::ofstream(path) << "precious";
  EXPECT_EQ(begin(), ASSAY_RECORD_FILE_EXISTS);
  EXPECT_TRUE(says(error(), path));
  EXPECT_EQ(bytes_of(path), "precious");
  settings.overwrite = 1;
  EXPECT_EQ(begin(), ASSAY_OK);
  end();
  std::ofstream(path).close();
  settings.overwrite = 0;
  EXPECT_EQ(begin(), ASSAY_OK) << "an empty one";
}

TEST_F(RecordFiles, AFullDiskIsTold) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  settings.path = "/dev/full", settings.overwrite = 1;
  EXPECT_EQ(begin(), ASSAY_RECORD_NOT_WRITTEN);
  EXPECT_TRUE(says(error(), "cannot write to /dev/full: "));
}

// The disk is full during one step, and has room again. Nobody would read what came behind.
TEST_F(RecordFiles, AWriteThatFailedEndsTheLog) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  ASSERT_EQ(begin(), ASSAY_OK);
  record(1);
  std::FILE* const log = recorder.file;
  recorder.file = std::fopen("/dev/full", "wb");
  std::setvbuf(recorder.file, nullptr, _IONBF, 0);
  EXPECT_EQ(step_to(1), ASSAY_RECORD_NOT_WRITTEN);
  std::fclose(recorder.file);
  recorder.file = log;
  EXPECT_EQ(step_to(2), ASSAY_RECORD_NOT_WRITTEN);
  EXPECT_EQ(assay_record_note(&recorder, "full"), ASSAY_RECORD_NOT_WRITTEN);
  EXPECT_TRUE(says(error(), "cannot write to " + path + ": No space left"));
  EXPECT_EQ(assay_record_end(&recorder), ASSAY_RECORD_NOT_WRITTEN);
  EXPECT_EQ(records_of(path).size(), 2u);
}

}  // namespace
}  // namespace assay::tests
