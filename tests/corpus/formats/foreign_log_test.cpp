// Logs of another writer than the recorder: records that are whole, whatever they hold.
#include <zlib.h>

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

  static std::string record(const Json& body) {
    const auto bytes = Json::to_cbor(body);
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
  auto log = open({begin(), step(0), {{"type", "end"}, {"record", 2}, {"steps", 1}}});
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_EQ(log.value().count(), 1u);
  EXPECT_TRUE(log.value().is_ended());
  EXPECT_TRUE(log.value().damages().empty());
  EXPECT_EQ(log.value().step(0).value().answer->answer, ASSAY_FREE);
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
    const auto told = read(key, value);
    EXPECT_EQ(told.why_unknown, "") << key;
    EXPECT_EQ(told.answer->answer, -1) << key;
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

// The search for the next record reads a piece at a time, and its mark may lie across two.
TEST_F(ForeignLogs, ARecordBehindMuchDamageIsFound) {
  constexpr std::size_t piece = std::size_t{1} << 20;
  for (std::size_t more = 0; more < 9; ++more) {
    const auto text = record(begin()) + std::string(piece - 2 + more, 'x') + record(step(0));
    const auto log = StepLog::open(write("far.log", text));
    EXPECT_EQ(log.value().count(), 1u) << more;
    EXPECT_EQ(log.value().damages().size(), 1u);
  }
}

// A hundred thousand heads, each with a length that fits: their bodies are not all summed.
TEST_F(ForeignLogs, ManyWrongLengthsEndTheSearch) {
  constexpr std::size_t heads = 100'000, head_bytes = 17;
  std::string text = record(begin());
  const auto end = text.size() + heads * head_bytes;
  for (std::size_t i = 0; i < heads; ++i) {
    const std::uint64_t length = end - text.size() - head_bytes;
    text += std::string(mark_of_log) + "\xD8\x18\x5B";
    for (int k = 7; k >= 0; --k) text += static_cast<char>(length >> (8 * k));
  }
  text +=
      "\x1A"
      "0000";
  const auto log = StepLog::open(write("heads.log", text + record(step(0))));
  ASSERT_EQ(log.value().damages().size(), 1u);
  EXPECT_TRUE(says(log.value().damages()[0].what, "it is not searched"));
}

TEST_F(ForeignLogs, RecordsInAnotherOrderAreNamed) {
  const auto damages = [&](const std::vector<Json>& bodies) {
    const auto log = open(bodies);
    return log.value().damages().size();
  };
  auto late = step(1);
  late["record"] = 5;
  EXPECT_EQ(damages({begin(), step(0), step(1)}), 0u);
  EXPECT_EQ(damages({begin(), step(0), late}), 1u) << "records are missing";
  EXPECT_EQ(damages({begin(), step(0), step(0)}), 1u);
  auto again = step(1);
  again["record"] = 1;
  EXPECT_EQ(damages({begin(), step(0), again}), 1u) << "a record that was there";
  again = step(0);
  again["record"] = 2;
  EXPECT_EQ(damages({begin(), step(0), again}), 1u) << "a step that was there";
  auto other = begin();
  other["record"] = 2;
  EXPECT_TRUE(
      says(open({begin(), step(0), other}).value().damages()[0].what, "another log begins"));
  EXPECT_EQ(damages({begin(), step(0), Json::array({1, 2})}), 1u);
}

}  // namespace
}  // namespace assay::corpus
