// What the records of a log hold (detector/plugin/assay_record.h).
#include "tests/detector/plugin/record_fixture.h"

namespace assay::detector {
namespace {

using namespace tests;

class Record : public Recording {};

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
  const json expected = {{"type", "begin"},
                         {"log", 1},
                         {"record", 0},
                         {"name", "mine"},
                         {"version", "1.5"},
                         {"claims", 1 + (1 << 12)},
                         {"adjacency", 2},
                         {"coordinates", 1},
                         {"margin", 0.25},
                         {"start", 2},
                         {"start_distance", 1e-3},
                         {"least_nonzero", 1e-9},
                         {"largest", 1e9},
                         {"features", 1},
                         {"time_tolerance", 1e-4},
                         {"reports", 1},
                         {"separation", 0.5},
                         {"counts", 1},
                         {"rings", -3},
                         {"rest_distance", 0.125},
                         {"limit_gives", 2},
                         {"progress", 0.75},
                         {"motion", 1},
                         {"capacity_triangles", 7},
                         {"capacity_contacts", 0},
                         {"capacity_candidates", std::uint64_t{1} << 40},
                         {"vertices", 4}};
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
  auto told = end()[0]["counted"];
  EXPECT_EQ(int32s(told["body"]), std::vector<std::int32_t>(body, body + 4));
  EXPECT_EQ(int32s(told["apart"]), std::vector<std::int32_t>(apart, apart + 2));
  EXPECT_EQ(doubles(told["rest"]), rest);
  EXPECT_EQ(int32s(told["triangle_pairs"]), std::vector<std::int32_t>(pairs, pairs + 2));
  EXPECT_EQ(int32s(told["vertex_faces"]), std::vector<std::int32_t>(faces, faces + 2));
  EXPECT_EQ(int32s(told["edge_pairs"]), std::vector<std::int32_t>(edges, edges + 4));
  EXPECT_EQ(told.size(), 9u);
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
  EXPECT_EQ(body, (json{{"type", "step"},
                        {"record", 1},
                        {"step", 0},
                        {"answer", 1},
                        {"first_lo", 0.25},
                        {"first_hi", 0.5},
                        {"message", "gr\xC3\xBC?"},  // a lone byte of Latin-1 is no UTF-8
                        {"share", 0.75}}));
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
  const auto records = end();
  const auto told = floats(records[1]["x1"]);
  ASSERT_EQ(told.size(), 12u);
  EXPECT_EQ(std::memcmp(told.data(), x1.data(), 48), 0);
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
  for (const auto& [text, told] : texts)
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

}  // namespace
}  // namespace assay::detector
