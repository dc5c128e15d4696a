// Which steps a recorder writes, where they start, to which files they go, and what it refuses.
#include "tests/detector/plugin/record_fixture.h"

namespace assay::detector {
namespace {

using namespace tests;

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
      if (!follows) {
        EXPECT_EQ(doubles(records[i]["x0"]), number ? all(number - 1) : rest);
      }
      EXPECT_EQ(doubles(records[i]["x1"]), all(number));
      out.push_back(number);
    }
    return out;
  }
  void record(int count) {
    for (int i = 0; i < count; ++i) {
      if (recorder.next_step == 0) {
        first_step();
      } else {
        ASSERT_EQ(step_to(static_cast<double>(recorder.next_step)), ASSAY_OK) << error();
      }
    }
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
      EXPECT_TRUE(says(error(), "no two triangles"));
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
}  // namespace assay::detector
