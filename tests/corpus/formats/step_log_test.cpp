// Logs of steps: a log is read as the recorder wrote it. If bytes are damaged, each record before
// the first damage is read, and the damage is named.
#include "corpus/formats/step_log.h"

#include <signal.h>
#include <sys/wait.h>

#include "tests/asked.h"
#include "tests/corpus/scratch.h"
#include "tests/recorded_log.h"

namespace assay::corpus {
namespace {

using detector::Positions;

constexpr int steps_written = 12;

class StepLogs : public Scratch {
 protected:
  const detector::Triangles triangles_ = tests::triangles({{0, 1, 2}, {3, 4, 5}});

  static Positions places(int frame) {
    Positions x(6, 3);
    for (Eigen::Index i = 0; i < x.size(); ++i) x.data()[i] = std::sqrt(2. + frame) * double(i);
    return x;
  }

  static detector::StepResult answer(int step) {
    detector::StepResult result;
    result.answer = step % 3 == 0 ? detector::Answer::collision : detector::Answer::free;
    if (step % 3 == 0) {
      result.first = {0.25, 0.5};
      result.pairs.push_back({});
      result.pairs.back().pair = {0, 1};
      result.pairs.back().time = {0.25, 0.5};
    }
    return result;
  }

  // Steps whose start stands in the log only where the number is even.
  std::filesystem::path write_log(bool ends = true) const {
    const auto path = folder() / "steps.log";
    tests::LogWriter log(path.string(), triangles_, places(0));
    for (int s = 0; s < steps_written; ++s) {
      if (s == 5) log.note("the sheet touches the floor");
      const auto start = places(s);
      log.step(s % 2 == 0 ? &start : nullptr, places(s + 1), answer(s));
    }
    if (ends) log.end();
    return path;
  }

  // Every step that is read is that of its number, and all before the first damage are.
  void check_steps(const std::string& bytes, const std::vector<std::size_t>& ends) const {
    auto read = StepLog::open(write("damaged.log", bytes));
    if (!read) {
      EXPECT_FALSE(read.error().message.empty());
      return;
    }
    auto& log = read.value();
    std::set<std::uint64_t> numbers;
    for (std::size_t i = 0; i < log.count(); ++i) {
      const auto& s = value_of(log.step(i));
      numbers.insert(s.number);
      ASSERT_LT(s.number, std::uint64_t{steps_written});
      EXPECT_EQ(s.why_unknown, "");
      const auto n = static_cast<int>(s.number);
      EXPECT_EQ(s.x_t0, places(n));
      EXPECT_EQ(s.x_t1, places(n + 1));
      EXPECT_EQ(s.answer->pairs.size(), n % 3 == 0 ? 2u : 0u);
    }
    // What was whole is read: steps whose records lie wholly before a cut.
    for (std::size_t s = 0; s < ends.size(); ++s) {
      if (ends[s] <= bytes.size() && bytes.compare(0, ends[s], good_, 0, ends[s]) == 0) {
        EXPECT_TRUE(numbers.contains(s)) << s;
      }
    }
    const bool is_all = numbers.size() == steps_written && log.is_ended();
    EXPECT_TRUE(is_all || log.damage() || !log.is_ended());
  }

  // Where records begin, and where the last one ends.
  std::vector<std::size_t> marks() const {
    std::vector<std::size_t> begins;
    for (auto at = good_.find("ASR1"); at != std::string::npos; at = good_.find("ASR1", at + 1))
      begins.push_back(at - 2);
    begins.push_back(good_.size());
    return begins;
  }

  // Behind the record of each step, which is neither begin, note nor end.
  std::vector<std::size_t> ends_of_steps() const {
    const auto begins = marks();
    std::vector<std::size_t> ends;
    for (std::size_t r = 1; r + 1 < begins.size(); ++r) {
      const auto record = std::string_view(good_).substr(begins[r], begins[r + 1] - begins[r]);
      if (record.find("answer") != std::string_view::npos) ends.push_back(begins[r + 1]);
    }
    return ends;
  }

  std::string good_;
};

TEST_F(StepLogs, AreReadAsTheyWereWritten) {
  auto read = value_of(StepLog::open(write_log()));
  auto& log = read;
  EXPECT_EQ(log.head().name, "recorded");
  EXPECT_EQ(log.head().description.claims, tests::all_claims_description().claims);
  EXPECT_EQ(log.head().triangles, triangles_);
  EXPECT_EQ(log.head().positions, places(0));
  EXPECT_FALSE(log.head().counted);
  EXPECT_EQ(log.count(), std::size_t{steps_written});
  EXPECT_TRUE(log.is_ended());
  EXPECT_FALSE(log.damage());
  EXPECT_EQ(log.notes().begin()->first, 5u);
  EXPECT_EQ(log.notes().begin()->second, "the sheet touches the floor");
  // In any order, though every second one starts where the one before it ended.
  for (const std::size_t i : {11, 3, 4, 5, 0, 1, 10}) {
    const auto step = log.step(i).value();
    EXPECT_EQ(step.why_unknown, "");
    EXPECT_EQ(step.x_t0, places(static_cast<int>(i)));
    EXPECT_EQ(step.x_t1, places(static_cast<int>(i) + 1));
    EXPECT_EQ(step.answer->answer, i % 3 == 0 ? ASSAY_COLLISION : ASSAY_FREE);
  }
}

TEST_F(StepLogs, CutAnywhereTheyLoseWhatWasCut) {
  good_ = bytes_in(write_log());
  const auto ends = ends_of_steps();
  ASSERT_EQ(ends.size(), std::size_t{steps_written});
  for (std::size_t cut = 0; cut <= good_.size(); cut += 13) check_steps(good_.substr(0, cut), ends);
}

// A crash leaves the beginning of a record and nothing else, so whatever else ends a log is damage.
TEST_F(StepLogs, EveryCutIsToldFromDamage) {
  const auto path = write_log();
  good_ = bytes_in(path);
  const auto begins = marks();
  const std::set<std::size_t> whole(begins.begin(), begins.end());
  for (auto cut = good_.size(); cut >= begins[1]; --cut) {
    if (cut == begins[begins.size() - 3]) cut = begins[3];  // the records between are alike
    std::filesystem::resize_file(path, cut);
    const auto log = StepLog::open(path);
    ASSERT_TRUE(log) << cut;
    const auto damage = log.value().damage();
    ASSERT_EQ(damage.has_value(), !whole.contains(cut)) << cut;
    ASSERT_TRUE(!damage || damage->is_cut) << cut;
  }
}

TEST_F(StepLogs, ARearThatBeginsNoRecordIsDamage) {
  good_ = bytes_in(write_log());
  const auto begins = marks();
  const auto last = begins[begins.size() - 2], size = good_.size() - last;
  const auto damaged = [&](const std::string& bytes) {
    const auto damage = StepLog::open(write("rear.log", bytes)).value().damage();
    EXPECT_TRUE(damage && !damage->is_cut);
    return damage.value_or(LogDamage{});
  };
  const auto first = good_.substr(0, begins[1]), most = good_.substr(0, last);
  const std::string head("\x83\x44\x41\x53\x52\x31\xD8\x18\x5B\0\0\0\0\0\0\0", 16);
  for (const auto& rear : {std::string(1, '\0'), std::string(5'000'000, '\0'),
                           std::string("\x83\x44\x41\x53", 4) + "x",
                           head + std::string("\x09"
                                              "0123456789abcdef"),
                           head + std::string("\0\x1A"
                                              "123456",
                                              8)}) {
    for (const auto& before : {first, most, good_}) {
      const auto damage = damaged(before + rear);
      EXPECT_EQ(damage.from, before.size());
      EXPECT_EQ(damage.to, before.size() + rear.size());
    }
  }
  std::mt19937 random(3);
  for (int n = 0; n < 100; ++n) {
    std::string rear(1 + random() % 99, '\0');
    for (auto& byte : rear) byte = static_cast<char>(random());
    if (!rear.starts_with('\x83')) damaged(most + rear);
  }
  // In the last record, any byte of its head, those of a length that is now too large included.
  for (std::size_t at = 0; at < 17; ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      auto bad = good_;
      bad[last + at] = static_cast<char>(bad[last + at] ^ (1 << bit));
      EXPECT_EQ(damaged(bad).from, last) << at << " " << bit;
    }
  }
  auto overwritten = good_;
  overwritten.replace(last, size, std::string(size, '\0'));
  EXPECT_EQ(damaged(overwritten).from, last);
}

// Though its length may reach beyond the end of the file, a record in the middle was not cut.
TEST_F(StepLogs, WithAnyByteChangedTheyEndThere) {
  good_ = bytes_in(write_log());
  const auto ends = ends_of_steps(), begins = marks();
  std::mt19937 random(7);
  const auto form = ends[3];
  for (std::size_t n = 0; n < 1000; ++n) {
    auto bad = good_;
    const auto at = n < 17 ? form + n : random() % bad.size();
    bad[at] = static_cast<char>(bad[at] ^ static_cast<char>(1 + random() % 255));
    SCOPED_TRACE(at);
    check_steps(bad, ends);
    const auto log = StepLog::open(folder() / "damaged.log");
    ASSERT_EQ(log.has_value(), at >= begins[1]);
    if (!log) continue;
    const auto damage = log.value().damage();
    ASSERT_TRUE(damage && !damage->is_cut);
    EXPECT_EQ(damage->from, *std::prev(std::ranges::upper_bound(begins, at)));
    EXPECT_EQ(damage->to, good_.size());
    EXPECT_EQ(log.value().count(),
              std::ranges::count_if(ends, [&](auto end) { return end <= damage->from; }));
  }
}

TEST_F(StepLogs, BytesTakenOutOrPutInEndThem) {
  good_ = bytes_in(write_log());
  const auto ends = ends_of_steps();
  auto missing = good_, more = good_;
  missing.erase(ends[3], ends[5] - ends[3]);  // two whole steps, and the note between them
  more.insert(ends[3],
              "\x83\x44"
              "ASR1 and so on");
  for (const auto& [bytes, what] :
       {std::pair(missing, "record 8 instead of record 5"), std::pair(more, "no record")}) {
    check_steps(bytes, {});
    const auto log = StepLog::open(folder() / "damaged.log");
    EXPECT_EQ(log.value().count(), 4u);
    EXPECT_EQ(log.value().damage()->from, ends[3]);
    EXPECT_EQ(log.value().damage()->what, what);
  }
}

TEST_F(StepLogs, WhatIsKilledWhileItWritesLosesOneRecordAtMost) {
  const auto path = folder() / "killed.log";
  for (int n = 0; n < 200; n += tests::spaced(1)) {
    std::filesystem::remove(path);
    const auto child = fork();
    if (child == 0) {
      tests::LogWriter log(path.string(), triangles_, places(0));
      const auto start = places(0);
      for (int s = 0;; ++s) log.step(s == 0 ? &start : nullptr, places(s + 1), answer(s));
    }
    ASSERT_GT(child, 0);
    // Some steps are there, and then it is killed at any place.
    std::error_code absent;
    constexpr std::uintmax_t some_steps = 4000;
    for (std::uintmax_t size = 0; absent || size < some_steps;
         size = std::filesystem::file_size(path, absent))
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    std::this_thread::sleep_for(std::chrono::microseconds(17 * n));
    kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    const auto log = value_of(StepLog::open(path));
    EXPECT_TRUE(!log.damage() || log.damage()->is_cut);
    EXPECT_FALSE(log.is_ended());
    EXPECT_GE(log.count(), 2u);
  }
}

TEST_F(StepLogs, GrowWhileTheyAreRead) {
  const auto path = folder() / "grows.log";
  tests::LogWriter writer(path.string(), triangles_, places(0));
  auto log = StepLog::open(path).value();
  for (int s = 0; s < 3; ++s) {
    const auto start = places(s);
    writer.step(&start, places(s + 1), answer(s));
    ASSERT_TRUE(log.go_on());
    EXPECT_EQ(log.count(), std::size_t(s) + 1);
    EXPECT_EQ(log.step(std::size_t(s)).value().x_t1, places(s + 1));
  }
  writer.end();
  ASSERT_TRUE(log.go_on());
  EXPECT_TRUE(log.is_ended());
  std::filesystem::rename(path, path.string() + ".moved");
  write("grows.log", bytes_in(path.string() + ".moved"));
  EXPECT_FALSE(log.go_on());
}

TEST_F(StepLogs, DisplacementsAreExactSums) {
  const auto path = folder() / "moved.log";
  tests::LogWriter writer(path.string(), triangles_, places(0));
  std::vector<float> x(18, 1), far(18, 0x1p-60F), near(18, 0x1p-30F);
  const auto step = [&](const std::vector<float>& way) {
    assay_record_step_data data = {};
    data.x0 = {x.data(), 1};
    data.dx = {way.data(), 1};
    writer.step(data);
  };
  step(near);
  step(far);
  writer.end();
  auto log = StepLog::open(path).value();
  EXPECT_EQ(log.step(0).value().x_t1(0, 0), 1 + 0x1p-30);
  EXPECT_TRUE(says(log.step(1).value().why_unknown, "no double"));
}

TEST_F(StepLogs, RefuseWhatIsNone) {
  const auto message_of = [&](std::string_view bytes) {
    const auto log = StepLog::open(write("none.log", bytes));
    return log ? std::string("none") : log.error().message;
  };
  EXPECT_TRUE(says(message_of("v 0 0 0\n"), "it is no log of steps"));
  EXPECT_TRUE(says(message_of(""), "it is no log of steps"));
  good_ = bytes_in(write_log());
  EXPECT_TRUE(says(message_of(good_.substr(0, 100)), "its first record is damaged"));
  EXPECT_FALSE(StepLog::open(folder() / "absent.log"));
  EXPECT_FALSE(StepLog::open(folder()));
}

}  // namespace
}  // namespace assay::corpus
