// Logs that another program than the recorder wrote: their records are whole, but can have any
// content.

#include <nlohmann/json.hpp>

#include "corpus/formats/step_log.h"
#include "tests/corpus/scratch.h"

namespace assay::corpus {
namespace {

class ForeignLogs : public Scratch {
 protected:
  using Json = nlohmann::json;

  template <class Number>
  static Json numbers(std::uint8_t tag, const std::vector<Number>& list) {
    std::vector<std::uint8_t> bytes(list.size() * sizeof(Number));
    std::memcpy(bytes.data(), list.data(), bytes.size());
    return Json::binary(bytes, tag);
  }
  static Json doubles(const std::vector<double>& list) { return numbers(86, list); }
  static Json integers(const std::vector<std::int32_t>& list) { return numbers(78, list); }

  static std::string record(const Json& body) { return record(Json::to_cbor(body)); }
  static std::string record(const std::vector<std::uint8_t>& bytes) {
    std::string text(mark_of_log);
    const auto put = [&](std::uint64_t value, int count) {
      for (int k = count - 1; k >= 0; --k) text += static_cast<char>(value >> (8 * k));
    };
    text += "\xD8\x18\x5B";
    put(bytes.size(), 8);
    text.append(bytes.begin(), bytes.end());
    text += '\x1A';
    put(crc32_z(0, bytes.data(), bytes.size()), 4);
    return text;
  }

  static Json begin() {
    return {{"type", "begin"},
            {"log", 1},
            {"record", 0},
            {"name", "foreign"},
            {"version", "1"},
            {"claims", 1},
            {"vertices", 3},
            {"triangles", integers({0, 1, 2})},
            {"positions", doubles({0, 0, 0, 1, 0, 0, 0, 1, 0})}};
  }
  static Json step(int number) {
    const Json places = doubles({0, 0, 0, 1, 0, 0, 0, 1, 0});
    return {{"type", "step"}, {"record", number + 1}, {"step", number},
            {"x0", places},   {"x1", places},         {"answer", 0}};
  }
  Expected<StepLog> open(const std::vector<Json>& bodies) const {
    std::string text;
    for (const auto& body : bodies) text += record(body);
    return StepLog::open(write("foreign.log", text));
  }
};

TEST_F(ForeignLogs, AreReadIfTheyKeepTheForm) {
  auto log = value_of(open({begin(), step(0), {{"type", "end"}, {"record", 2}, {"steps", 1}}}));
  EXPECT_EQ(log.count(), 1u);
  EXPECT_TRUE(log.is_ended());
  EXPECT_FALSE(log.damage());
  EXPECT_EQ(log.step(0).value().answer->answer, ASSAY_FREE);
}

TEST_F(ForeignLogs, AreRefusedIfTheirBeginIsNone) {
  const std::vector<std::pair<const char*, Json>> wrong = {
      {"log", 2},
      {"claims", "free-sound"},
      {"claims", std::int64_t{1} << 32},
      {"margin", "wide"},
      {"rings", 0.5},
      {"vertices", -1},
      {"vertices", 4},
      {"vertices", 6148914691236517206},
      {"triangles", integers({0, 1, 3})},
      {"triangles", integers({0, 1})},
      {"triangles", doubles({0, 1, 2})},
      {"positions", doubles({0, 0, 0, 1, 0, 0, 0, 1, std::nan("")})},
      {"counted", 5},
      {"counted", {{"level", 7}}},
      {"counted", {{"apart", integers({0})}}},
      {"counted", {{"rings", -3}}}};
  for (const auto& [key, value] : wrong) {
    auto changed = begin();
    changed[key] = value;
    EXPECT_FALSE(open({changed, step(0)})) << key << " " << value;
  }
}

// What is said of the step itself makes it unknown; what is said of its answer is a wrong answer.
TEST_F(ForeignLogs, WrongKindsInAStepAreNotTakenForAbsent) {
  const auto read = [&](const char* key, const Json& value) {
    auto changed = step(0);
    changed[key] = value;
    auto log = open({begin(), changed});
    return log.value().step(0).value();
  };
  for (const auto& [key, value] :
       std::vector<std::pair<const char*, Json>>{{"x1", doubles({0, 0, 0})},
                                                 {"x1", integers({0, 0, 0, 0, 0, 0, 0, 0, 0})},
                                                 {"x0", 5},
                                                 {"dx", doubles({0, 0, 0, 0, 0, 0, 0, 0, 0})}})
    EXPECT_NE(read(key, value).why_unknown, "") << key;
  for (const auto& [key, value] :
       std::vector<std::pair<const char*, Json>>{{"answer", "free"},
                                                 {"answer", 0.5},
                                                 {"answer", std::int64_t{1} << 33},
                                                 {"pairs", doubles({0, 1})},
                                                 {"pair_times", integers({0, 1})}}) {
    const auto record = read(key, value);
    EXPECT_EQ(record.why_unknown, "") << key;
    EXPECT_EQ(record.answer->answer, -1) << key;
  }
  EXPECT_TRUE(std::isnan(read("answer", 1).answer->first_lo)) << "no time is not 0";
  EXPECT_FALSE(read("positions", doubles({0, 0, 0})).limit->positions->allFinite());
}

// The caller stopped before the end, and there the next step starts.
TEST_F(ForeignLogs, AStepStartsWhereTheCallerStopped) {
  auto first = step(0), second = step(1);
  first["committed"] = doubles({5, 0, 0, 6, 0, 0, 5, 1, 0});
  second.erase("x0");
  auto log = open({begin(), first, second}).value();
  EXPECT_EQ(log.step(1).value().x_t0(0, 0), 5);
  EXPECT_EQ(log.step(1).value().x_t1(0, 0), 0);
}

// The search for further records reads a piece at a time, and their mark may lie across two.
TEST_F(ForeignLogs, ALengthThatIsWrongIsNoCut) {
  constexpr std::size_t piece = std::size_t{1} << 20;
  auto longer = record(step(0));
  longer[9] = 1;
  for (std::size_t more = 0; more < 12; ++more) {
    const auto damage = [&](const std::string& rear) {
      const auto text = record(begin()) + longer + std::string(piece - longer.size() - more, 'x');
      return StepLog::open(write("far.log", text + rear)).value().damage();
    };
    EXPECT_FALSE(damage(record(step(0)))->is_cut) << more;
    EXPECT_TRUE(damage("")->is_cut) << more;
  }
}

TEST_F(ForeignLogs, MapsThatAreNoneEndThem) {
  const auto good = Json::to_cbor(step(0));
  auto twice = good, endless = good, cut = good;
  ++twice[0];
  twice.insert(twice.end(), {0x64, 's', 't', 'e', 'p', 0});
  endless[0] = 0xBF;
  endless.push_back(0xFF);
  cut.pop_back();
  // A map of 300 members, as nlohmann writes it; its last key renamed to one that is there.
  auto many = step(0);
  for (int i = 0; i < 300; ++i) many["later" + std::to_string(1000 + i)] = i;
  ASSERT_EQ(StepLog::open(write("many.log", record(begin()) + record(Json::to_cbor(many))))
                .value()
                .count(),
            1u);
  auto same = Json::to_cbor(many);
  const std::string last = "later1299", other = "later1298";
  std::copy(other.begin(), other.end(),
            std::search(same.begin(), same.end(), last.begin(), last.end()));
  const auto with = [&](std::vector<std::uint8_t> value) {
    auto body = good;
    ++body[0];
    body.insert(body.end(), {0x61, 'x'});
    body.insert(body.end(), value.begin(), value.end());
    return body;
  };
  // -2^64, which no integer holds; a map that names a key twice; a tag before a text.
  std::vector<std::vector<std::uint8_t>> bodies = {
      twice,
      endless,
      cut,
      {},
      same,
      with({0x3B, 255, 255, 255, 255, 255, 255, 255, 255}),
      with({0xA2, 0x61, 'a', 0, 0x61, 'a', 1}),
      with({0xC0, 0x61, 'a'})};
  EXPECT_EQ(StepLog::open(write("x.log", record(begin()) + record(with({0xA1, 0x61, 'a', 0}))))
                .value()
                .count(),
            1u);
  for (const std::uint8_t holder : {0x81, 0x9F, 0xC6, 0xBF, 0x5F, 0x7F})
    bodies.emplace_back(1'000'000, holder);
  for (const auto& body : bodies) {
    const auto log = StepLog::open(write("map.log", record(begin()) + record(body)));
    EXPECT_EQ(log.value().count(), 0u);
    EXPECT_EQ(log.value().damage()->what, "a record of an unknown kind");
  }
}

TEST_F(ForeignLogs, RecordsInAnotherOrderEndThem) {
  const auto damage = [&](const std::vector<Json>& bodies) {
    const auto log = open(bodies);
    const auto found = log.value().damage();
    EXPECT_TRUE(!found || log.value().count() + 2 == bodies.size());
    return found ? found->what : "";
  };
  const auto changed = [](int number, const char* key, int value) {
    auto body = step(number);
    body[key] = value;
    return body;
  };
  EXPECT_EQ(damage({begin(), step(0), step(1)}), "");
  EXPECT_EQ(damage({begin(), step(0), changed(1, "record", 5)}), "record 5 instead of record 2");
  EXPECT_EQ(damage({begin(), step(0), step(0)}), "record 1 instead of record 2");
  EXPECT_EQ(damage({begin(), step(0), changed(1, "step", 0)}), "a step number out of order");
  EXPECT_EQ(damage({begin(), step(0), changed(1, "step", -1)}),
            "a record without the number of its step");
  EXPECT_TRUE(says(damage({begin(), step(0), begin()}), "another log begins"));
  EXPECT_EQ(damage({begin(), step(0), Json::array({1, 2})}), "a record of an unknown kind");
}

}  // namespace
}  // namespace assay::corpus
